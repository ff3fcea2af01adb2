#!/usr/bin/python3
"""The Python package against formulas, and with the variable SNUG against the program."""

import importlib.util
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy as np
except ImportError:  # Debian's Python has the packages
    if os.path.realpath(sys.executable) == os.path.realpath("/usr/bin/python3"):
        raise
    os.execv("/usr/bin/python3", ["/usr/bin/python3", *sys.argv])

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import snug  # noqa: E402

FAKE = HERE / "fake_server.py"
HERTZ = {"Body punch/Box cells": [4, 4, 4], "Body foundation/Box cells": [4, 4, 4]}


def needs(package):
    return unittest.skipIf(importlib.util.find_spec(package) is None, f"no package {package}")


class Formulas(unittest.TestCase):
    def setUp(self):
        self.model = snug.Model("model.prm", program=FAKE)
        self.addCleanup(self.model.close)

    def test_results(self):
        result = self.model.evaluate([.5, .25], gradients=["energy"], contact=True)
        self.assertEqual(result["energy"], 1.5)
        self.assertEqual(result.gradients["energy"].tolist(), [-.75, 3.5])
        self.assertEqual(list(result.contact()["y"]), [1.])
        # The last answer is kept, so that the program counts no request.
        again = self.model.evaluate(np.array([.5, .25]), gradients=["energy"], contact=True)
        self.assertIs(again, result)
        self.assertEqual(result.errors, {})
        self.assertEqual(self.model.evaluate([.5, .25], errors=True).errors, {"energy": .5})
        self.assertEqual(self.model.write([.5, .25])[1], pathlib.Path("output/b/c.vtu"))
        self.assertLess(len(repr(result)) + len(repr(self.model)), 200)
        self.assertIn("<tr><td>energy</td><td>1.5</td><td>3.58</td></tr>", result._repr_html_())

    def test_errors(self):
        with self.assertRaises(snug.RequestError):
            self.model.evaluate([0.])
        with self.assertRaises(ValueError):
            self.model.evaluate([0., 1.1])
        self.assertEqual(self.model.evaluate([0., 1. + 1e-12]).x[1], 1.)
        with self.assertRaises(snug.DesignFailed) as caught:
            self.model.evaluate([.95, 0.])
        self.assertEqual(caught.exception.kind, "tangled")
        with self.assertRaises(snug.InputError) as caught:
            self.model.set({"Body/Stifness": 2})
        self.assertEqual((caught.exception.line, caught.exception.allowed), (3, "Body/Stiffness"))
        with self.assertRaises(snug.InputError):
            snug.Model("model.prm", {"Body/Stifness": 2}, program=FAKE)
        with self.assertRaises(snug.Died) as caught:
            self.model.evaluate([-.25, -1.])
        self.assertEqual(caught.exception.status, 5)
        self.assertIn("a fault\n", caught.exception.log)
        with self.assertRaises(snug.Died):
            self.model.evaluate([0., 0.])

    def test_a_late_answer_ends_the_process(self):
        with snug.Model("model.prm", program=FAKE, timeout=2.) as model:
            with self.assertRaisesRegex(snug.Died, "no answer in 2.0 s"):
                model.evaluate([0., -.875])

    def test_the_process_of_a_forgotten_model_ends(self):
        model = snug.Model("model.prm", program=FAKE)
        process = model.process.process
        del model
        self.assertEqual(process.wait(10.), 0)

    def test_samples_of_processes_are_equal(self):
        self.model.set({"Body/Stiffness": 3.})
        designs = np.vstack([np.random.default_rng(1).uniform(-.7, .7, (20, 2)), [.95, 0.]])
        one, two = (self.model.sample(designs, processes) for processes in (1, 2))
        x, y = designs[:-1].T
        self.assertTrue(np.allclose(one["energy"][:-1],
                                    3. * ((x - 1.) ** 2 + 2. * (y + .5) ** 2 + x * y), 1e-14))
        self.assertTrue(np.isnan(np.asarray(one["energy"])[-1]))
        self.assertEqual([bool(text) for text in one["failure"]], 20 * [False] + [True])
        for name in ("face[0]", "energy", "size", "failure"):
            self.assertEqual(list(one[name][:-1]), list(two[name][:-1]))

    def test_dictionaries_become_models_in_json(self):
        scene = {"Body a": {"Box cells": [3, 2], "Fixed": True}, "Task": "state"}
        with snug.Model.from_dict(scene, program=FAKE) as model:
            self.assertEqual(json.loads(model.file.read_text()),
                             {"Task": "state", "Body a": {"Box cells": [3, 2], "Fixed": True}})

    @needs("scipy")
    def test_scipy(self):
        from scipy.optimize import minimize
        import snug.scipy
        found = minimize(**snug.scipy.problem(self.model, "energy", [("size", 0., .25)]),
                         method="SLSQP", options={"ftol": 1e-12})
        x = self.model.evaluate(found.x * self.model.scale, gradients=True)
        self.assertAlmostEqual(x["size"], .25, 8)
        slopes = x.gradients["energy"] / x.gradients["size"]  # equal by the Lagrange multiplier
        self.assertAlmostEqual(slopes[0], slopes[1], 5)

    @needs("openmdao")
    def test_openmdao(self):
        check_partials(self, self.model, 1e-8)

    @needs("pymoo")
    def test_pymoo(self):
        from snug.pymoo import SnugProblem
        problem = SnugProblem(self.model, ["energy"], {"size": .3})
        out = problem.evaluate(np.array([[.5, .25], [.95, 0.], [.8, -.8]]), return_as_dictionary=True)
        self.assertEqual(out["F"].ravel().tolist(), [1.5, 1e30, 1e30])
        self.assertAlmostEqual(out["G"][0, 0], .0125)
        self.assertEqual(problem.failures, 1)
        self.assertGreater(out["G"][2, 1], 0.)  # the linear limit

    @needs("jax")
    def test_jax(self):
        import jax
        import snug.jax
        jax.config.update("jax_enable_x64", True)
        f = snug.jax.function(self.model, ["energy", "size"])
        slope = jax.jit(jax.grad(lambda x: f(x)[0] * f(x)[1]))(np.array([.5, .25]))
        self.assertTrue(np.allclose(slope, .3125 * np.array([-.75, 3.5]) + 1.5 * np.array([1., .5])))


def check_partials(test, model, tolerance):
    import openmdao.api as om
    from snug.openmdao import SnugComp
    problem = om.Problem(reports=False)
    problem.model.add_subsystem("snug", SnugComp(model=model), promotes=["*"])
    problem.setup()
    problem.set_val("x", model.start + .05 * model.scale)
    problem.run_model()
    found = problem.check_partials(out_stream=None, method="fd", form="central", step=1e-5)["snug"]
    test.assertEqual(len(found), len(model.responses))
    for (name, _), part in found.items():
        error = np.abs(part["J_fwd"] - part["J_fd"]).max() / np.abs(part["J_fwd"]).max()
        print(f"check_partials of {name}: {error:.1e}")
        test.assertLess(error, tolerance)


def run_program(file, folder, *launcher):
    sets = [part for name, value in HERTZ.items()
            for part in ("--set", f"{name}={snug.model.text_of(value)}")]
    subprocess.run([*launcher, os.environ["SNUG"], file, *sets, "--output", folder],
                   check=True, stdout=subprocess.DEVNULL)


@unittest.skipUnless("SNUG" in os.environ, "the variable SNUG is not set")
class Program(unittest.TestCase):
    @needs("scipy")
    def test_optimum_of_hertz(self):
        """SciPy and the program find the same optimum, of which the run's files tell."""
        from scipy.optimize import minimize
        import snug.scipy
        file = HERE.parents[2] / "prm" / "hertz-3d-9.prm"
        with tempfile.TemporaryDirectory() as folder, snug.Model(file, HERTZ) as model:
            run_program(file, folder)
            volume = model.evaluate()["volume"]
            found = minimize(**snug.scipy.problem(model, "potential energy",
                                                  [("volume", volume, volume)]),
                             method="SLSQP", options={"ftol": 1e-12})
            run = snug.read(folder)
            objective = np.asarray(run.history["objective"])[-1]
            print(f"SciPy {found.fun:.12g} in {found.nfev} evaluations, Snug {objective:.12g}")
            self.assertAlmostEqual(found.fun / objective, 1., delta=1e-8)
            self.assertLessEqual(found.nfev, 30)
            # The contact table of the process is that of the files.
            written, served = run.contact(0), model.evaluate(contact=True).contact()
            self.assertTrue(np.allclose(np.sort(written["pressure"]), np.sort(served["pressure"]),
                                        rtol=1e-5, atol=1e-3))

    @needs("pyvista")
    def test_states_of_ranks(self):
        file = HERE.parents[2] / "prm" / "hertz-3d-9.prm"
        with tempfile.TemporaryDirectory() as folder:
            for ranks in ("1", "2"):
                run_program(file, folder, "mpirun", "-np", ranks)
                state = snug.read(folder).state()
                self.assertEqual(state["punch"].n_cells, 64)
                self.assertEqual(state["punch.top"].n_cells, 16)

    @needs("openmdao")
    def test_partials_of_hertz(self):
        with snug.Model(HERE.parents[2] / "prm" / "hertz-3d-9.prm", HERTZ) as model:
            check_partials(self, model, 1e-6)


if __name__ == "__main__":
    unittest.main()
