#!/usr/bin/python3
"""Bolts against columns under uniform stress, springs in parallel and differences:
bolts.py SNUG MPIEXEC."""

import json
import os
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "contrib/python/tests"))
from test_snug import snug  # noqa: E402, begins again with Debian's Python if need be

from differences import assert_gradients  # noqa: E402

MODULUS, PRELOAD = 1000., 5.
BOLT, CLAMP = .4, 1.  # widths of the columns, whose stiffness is MODULUS times the width


def column(x, y, width, cells, **entries):
    return {"Box corner": [x, y], "Box size": [width, .5], "Box cells": cells,
            "Young's modulus": MODULUS, "Poisson's ratio": 0., **entries}


def joint(**cases):
    """Return a bolt and a clamped column between the ground and a rigid head, without Poisson's
    effect: springs of the stiffnesses MODULUS * BOLT and MODULUS * CLAMP in parallel."""
    scene = {"Dimension": 2, "Model": "plane stress", "Bodies": ["shank", "neck", "clamp"],
             "Obstacles": ["ground"], "Reference points": ["head"], "Bolts": ["m8"],
             "Body shank": column(0., 0., BOLT, [2, 3], Supports="bottom: xy"),
             "Body neck": column(0., .5, BOLT, [3, 2]),
             "Body clamp": column(1., 0., CLAMP, [4, 4], **{"Box size": [CLAMP, 1.]}),
             "Contact": {"Pairs": "neck.bottom: shank.top, clamp.bottom: ground"},
             "Pair neck.bottom: shank.top": {"Law": "tied"},
             "Reference point head": {"Point": [1., 1.], "Faces": ["neck.top", "clamp.top"],
                                      "Supports": ["x", "rz"]},
             "Bolt m8": {"Pair": "neck.bottom: shank.top", "Preload": PRELOAD},
             "Response tension": {"Quantity": "bolt tension", "Bolt": "m8"},
             "Response shortening": {"Quantity": "bolt shortening", "Bolt": "m8"},
             "Response lift": {"Quantity": "displacement", "Reference point": "head",
                               "Component": "y"},
             "Responses": ["tension", "shortening", "lift"]}
    if cases:
        scene["Load cases"] = list(cases)
        scene.update({f"Load case {name}": entries for name, entries in cases.items()})
    return scene


def working(force):
    return {"Load step": True, "Force": f"head: 0 {force!r}"}


class Bolts(unittest.TestCase):
    def evaluate(self, scene, **arguments):
        with tempfile.TemporaryDirectory() as folder, snug.Model.from_dict(
                scene, set={"Solver/Relative tolerance": 1e-11, "Output directory": folder},
                **arguments) as model:
            return model.evaluate()

    def assert_ratio(self, found, expected, tolerance=1e-10):
        self.assertAlmostEqual(found / expected, 1., delta=tolerance)

    def test_preload_and_shortening(self):
        length = PRELOAD / MODULUS * (1. / BOLT + 1. / CLAMP)
        tightened = self.evaluate(joint())
        self.assert_ratio(tightened["tension"], PRELOAD)
        self.assert_ratio(tightened["shortening"], length)
        self.assert_ratio(tightened["lift"], -PRELOAD / MODULUS / CLAMP)
        scene = joint()
        scene["Bolt m8"] = {"Pair": "shank.top: neck.bottom", "Shortening": length}
        shortened = self.evaluate(scene)
        for name in ("tension", "shortening", "lift"):
            self.assert_ratio(shortened[name], tightened[name])

    def test_joint_opens(self):
        """A load is shared in the ratio of the stiffnesses until the clamp lifts off."""
        opening = PRELOAD * (1. + BOLT / CLAMP)
        loads = [0., .5 * opening, .999 * opening, 1.001 * opening, 2. * opening, .5 * opening]
        found = self.evaluate(joint(tighten={}, **{
            f"step {i}": working(load) for i, load in enumerate(loads)}))
        for i, load in enumerate(loads):
            self.assert_ratio(found[f"step {i}.tension"],
                              max(load, PRELOAD + load * BOLT / (BOLT + CLAMP)))
            self.assert_ratio(found[f"step {i}.shortening"], found["tighten.shortening"])
        self.assert_ratio(found["step 0.lift"], found["tighten.lift"])

    def test_load_cases_of_their_own(self):
        """Load cases that are no steps start from the loose bolt."""
        found = self.evaluate(joint(first={"Preload": "m8: 2"}, second={"Shortening": "m8: 0.01"},
                                    third={"Force": "head: 0 -1"}), ranks=2)
        self.assert_ratio(found["first.tension"], 2.)
        self.assert_ratio(found["second.tension"], .01 * MODULUS / (1. / BOLT + 1. / CLAMP))
        self.assert_ratio(found["third.tension"], PRELOAD)
        self.assert_ratio(found["third.lift"], -(PRELOAD + 1.) / MODULUS / CLAMP)

    def test_gradients_through_load_steps(self):
        """Derivatives of locked steps contain those of the shortening, with both methods."""
        scene = joint(tighten={}, work=working(3.), more=working(8.))
        scene["Contact"].update({"Friction": "Coulomb", "Friction coefficient": "0.3"})
        scene["Reference point head"]["Supports"] = ["x"]
        scene.update({"Shape": {"Basis": "formula modes", "Bounds": [-.1, .1],
                                "Modes": "0.3*x*y, 0.1*x*y; 0.2*y*x, 0.3*x*y*y"},
                      "Optimization": {"Objective": "potential energy"}})
        for method in ("adjoint", "direct"):
            with tempfile.TemporaryDirectory() as folder, snug.Model.from_dict(
                    scene, set={"Solver/Relative tolerance": 1e-11, "Gradient/Method": method,
                                "Output directory": folder}) as model:
                # the tension of the first load case is constant
                assert_gradients(self, model, [.02, -.03], 1e-4, of_values=True)

    def test_wrong_models(self):
        other = "Pair neck.bottom: shank.top"
        for change, words in (
                ({"Bolt m8": {"Pair": "clamp.bottom: ground", "Preload": 1}}, "Law = tied"),
                ({other: {}}, "Law = tied"),
                ({"Bolt m8": {"Preload": 1}}, "Pair"),
                ({"Bolt m8": {"Pair": "neck.bottom: shank.top"}}, "Preload"),
                ({"Bolt m8": {"Pair": "neck.bottom: shank.top", "Preload": 1, "Shortening": 1}},
                 "Shortening"),
                ({"Bolt m8": {"Pair": "neck.bottom: shank.top", "Preload": "much"}}, "number"),
                ({"Load cases": ["a"], "Load case a": {"Preload": "m9: 1"}}, "no bolt 'm9'"),
                ({"Load cases": ["a"], "Load case a": {"Shortening": "m8: 1", "Preload": "m8: 1"}},
                 "as well"),
                ({"Bolts": ["m8", "head"], "Bolt head": {"Pair": "neck.bottom: shank.top",
                                                         "Preload": 1}}, "bolt 'head'|bolt 'm8'"),
                ({"Response tension": {"Quantity": "bolt tension"}}, "bolt"),
                ({"Response tension": {"Quantity": "bolt tension", "Bolt": "m9"}}, "bolt"),
                ({"Response tension": {"Quantity": "volume", "Bolt": "m8"}}, "left out"),
                ({"Load cases": ["a"], "Load case a": {"Load step": True},
                  "Bolt m8": {"Pair": "neck.bottom: shank.top"}}, "no load step")):
            with self.subTest(words=words), self.assertRaisesRegex(snug.InputError, words), \
                    tempfile.TemporaryDirectory() as folder:
                file = pathlib.Path(folder, "model.json")
                file.write_text(json.dumps({**joint(), **change}), encoding="utf-8")
                snug.Model(file).close()


if __name__ == "__main__":
    os.environ["SNUG"] = sys.argv[1]
    os.environ["PATH"] = os.pathsep.join([str(pathlib.Path(sys.argv[2]).parent), os.environ["PATH"]])
    unittest.main(argv=sys.argv[:1])
