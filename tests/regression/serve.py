#!/usr/bin/env python3
"""Requests to a resident process and its answers: serve.py SNUG SCENE MPIEXEC.

SCENE has a shape, an energy as its objective and a mesh that is tangled by large moves.
"""

import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

SETS = ["Responses=peak", "Response peak/Quantity=peak pressure"]
AT, ELSEWHERE = [0.01, -0.02, 0.03], [-0.03, 0.01, 0.02]


class Server:
    def __init__(self, *sets, ranks=1):
        command = [MPIEXEC, "-np", str(ranks)] if ranks > 1 else []
        command += [PROGRAM, "--serve", SCENE]
        for entry in [*SETS, *sets]:
            command += ["--set", entry]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.DEVNULL, text=True)
        self.ready = json.loads(self.process.stdout.readline())

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            if not self.process.stdin.closed:
                self.process.stdin.close()
            self.process.wait(timeout=20)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        self.process.stdout.close()

    def line(self, text):
        self.process.stdin.write(text + "\n")
        self.process.stdin.flush()
        return json.loads(self.process.stdout.readline())

    def ask(self, do, **keys):
        return self.line(json.dumps({"do": do, **keys}))

    def evaluate(self, x, **keys):
        answer = self.ask("evaluate", x=x, **keys)
        assert "error" not in answer, answer
        return answer


def of_solution(answer):
    return {key: answer[key] for key in ("values", "objective", "constraints", "load_cases")}


class Serve(unittest.TestCase):
    def test_describes_the_model(self):
        with Server() as server:
            self.assertEqual(server.ready["protocol"], "snug-1")
            about = server.ask("describe", id="a")
        self.assertEqual(about["id"], "a")
        self.assertEqual([variable["name"] for variable in about["variables"]],
                         [f"lower.top[{i}]" for i in range(3)])
        self.assertEqual([variable["upper"] for variable in about["variables"]], [0.1] * 3)
        self.assertEqual([response["name"] for response in about["responses"]],
                         ["peak", "potential energy", "volume"])
        self.assertEqual([constraint["side"] for constraint in about["constraints"]], ["equal"])
        self.assertAlmostEqual(about["constraints"][0]["target"], 2., delta=0.1)

    def test_values_are_those_of_a_run(self):
        # The contact is paired at the start design.
        start = "Shape/Initial=" + ", ".join(map(str, AT))
        with tempfile.TemporaryDirectory() as folder, Server(start) as server:
            answer = server.ask("evaluate")
            tolerance = server.ask("describe")["tolerance"]
            command = [PROGRAM, SCENE, "--output", folder]
            for entry in [*SETS, start, f"Solver/Relative tolerance={tolerance}"]:
                command += ["--set", entry]
            subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
            state = json.loads((pathlib.Path(folder) / "summary.json").read_text())["state"]
        self.assertEqual(answer["x"], AT)
        self.assertEqual(answer["values"]["peak"], state["responses"]["peak"])
        self.assertEqual(answer["objective"]["value"], state["energy"])
        self.assertEqual(answer["load_cases"][0]["active_contacts"], state["active_contacts"])

    def test_written_files_and_errors_are_those_of_a_run(self):
        """The entries that are written give the same state, and estimates of its errors."""
        with tempfile.TemporaryDirectory() as folder:
            for ranks in (1, 2):
                out, again = (pathlib.Path(folder, f"{name}-{ranks}") for name in ("out", "again"))
                with Server(f"Output directory={out}", ranks=ranks) as server:
                    server.ask("pair", x=AT)
                    answer = server.evaluate(AT, errors=True)
                    server.evaluate(ELSEWHERE)
                    written = server.ask("write", x=AT)
                    self.assertNotIn("error", written)
                    tolerance = server.ask("describe")["tolerance"]
                self.assertEqual(written["directory"], str(out))
                self.assertEqual(sorted(str(file.relative_to(out)) for file in out.rglob("*")
                                        if file.is_file()), written["files"])
                subprocess.run([PROGRAM, str(out / "parameters.prm"), "--output", str(again),
                                "--set", f"Solver/Relative tolerance={tolerance}",
                                "--set", "Accuracy/Estimate=responses"],
                               check=True, stdout=subprocess.DEVNULL)
                files = {str(file.relative_to(again)) for file in again.rglob("*")
                         if file.is_file()}
                # and those of the shape
                self.assertEqual(set(written["files"]) - files,
                                 {"profile.csv", "profile.step", "control-points.csv"})
                self.assertEqual(files - set(written["files"]), set())
                served, run = (json.loads((path / "summary.json").read_text())
                               for path in (out, again))
                self.assertEqual(served["task"], "state")
                found = run["state"]["accuracy"]["responses"]
                self.assertEqual(set(found), set(answer["errors"]))
                for name, error in found.items():
                    self.assertAlmostEqual(answer["errors"][name] / error, 1., delta=1e-6)
                self.assertEqual(answer["objective"]["error"], answer["errors"]["potential energy"])
                for state in (served["state"]["responses"], run["state"]["responses"]):
                    self.assertAlmostEqual(state["peak"] / answer["values"]["peak"], 1., delta=1e-8)

    def test_files_that_cannot_be_written(self):
        with Server("Output directory=/dev/null/out") as server:
            answer = server.ask("write")["error"]
            self.assertEqual((answer["kind"], answer["entry"]), ("input", "Output directory"))
            server.evaluate(AT)

    def test_gradients_are_those_of_differences(self):
        step = 1e-5
        with Server() as server:
            answer = server.evaluate(AT, gradients=True)
            for i in range(3):
                ends = []
                for sign in (1., -1.):
                    x = list(AT)
                    x[i] += sign * step
                    ends.append(server.evaluate(x))
                for name, gradient in answer["gradients"].items():
                    scale = max(map(abs, gradient))
                    difference = (ends[0]["values"][name] - ends[1]["values"][name]) / (2 * step)
                    self.assertAlmostEqual(gradient[i] / scale, difference / scale, delta=1e-6,
                                           msg=name)
        self.assertEqual(answer["objective"]["gradient"], answer["gradients"]["potential energy"])
        self.assertEqual(answer["constraints"][0]["gradient"], answer["gradients"]["volume"])

    def test_equal_requests_have_equal_answers(self):
        with Server() as server:
            first = of_solution(server.evaluate(AT, contact=True))
            again = server.evaluate(AT)
            self.assertEqual(again["work"]["f_mults"], 0)
            self.assertEqual(of_solution(again), first)
            server.evaluate(ELSEWHERE, gradients=True)
            server.evaluate([0.02, 0., 0.], start="warm")
            self.assertEqual(of_solution(server.evaluate(AT)), first)
            tangled = server.ask("evaluate", x=[-3., -3., -3.], outside=True)
            self.assertEqual(tangled["error"]["kind"], "tangled")
            self.assertEqual(server.evaluate(AT)["work"]["f_mults"], 0)
            server.evaluate(ELSEWHERE)
            self.assertEqual(of_solution(server.evaluate(AT)), first)
            for entries, kind in (({"Body upper/Poisson's ratio": 0.7}, "input"),
                                  ({"Body upper/Pressure": "top: -20"}, "solve")):
                failed = server.ask("set", entries=entries)
                if "error" not in failed:  # the model is right, but has no equilibrium
                    failed = server.ask("evaluate", x=AT)
                    server.ask("set", entries={"Body upper/Pressure": "top: 20"})
                self.assertEqual(failed["error"]["kind"], kind)
                self.assertEqual(of_solution(server.evaluate(AT)), first)

    def test_cold_starts_know_no_earlier_designs(self):
        with Server() as one, Server() as cold, Server() as warm:
            first = of_solution(one.evaluate(AT))
            cold.evaluate(ELSEWHERE)
            self.assertEqual(of_solution(cold.evaluate(AT)), first)
            warm.evaluate(ELSEWHERE)
            self.assertNotEqual(of_solution(warm.evaluate(AT, start="warm")), first)

    def test_sets_entries(self):
        with Server() as server:
            first = server.evaluate(AT)["values"]
            self.assertEqual(server.ask("set", entries={"Body upper/Pressure": "top: 10"})
                             ["rebuilt"], ["problem"])
            self.assertLess(server.evaluate(AT)["values"]["peak"], first["peak"])
            self.assertEqual(server.ask("set", entries={"Body upper/Box cells": [10, 6]})
                             ["rebuilt"], ["mesh"])
            answer = server.ask("set", entries={"Body upper/Young's modulus": -1})
            self.assertEqual(answer["error"]["entry"], "Body upper/Young's modulus")
            self.assertEqual(answer["error"]["value"], "-1")

    def test_bad_lines_are_answered_in_order(self):
        lines = ["no JSON", "[1]", '{"id": 3}', '{"id": 4, "do": "dance"}',
                 '{"id": 5, "do": "evaluate", "x": [0]}',
                 '{"id": 6, "do": "evaluate", "x": [0, 0, 0.2]}',
                 '{"id": 7, "do": "evaluate", "x": [0, 0, NaN]}',
                 '{"id": 8, "do": "evaluate", "gradients": ["peek"]}',
                 '{"id": 9, "do": "evaluate", "gradient": true}',
                 '{"id": 10, "do": "evaluate", "start": "hot"}',
                 '{"id": 11, "do": "set", "entries": {"Task": null}}',
                 '{"id": 12, "do": "evaluate", "contact": 1}']
        with Server() as server:
            for line in lines:
                server.process.stdin.write(line + "\n")
            server.process.stdin.flush()
            answers = [json.loads(server.process.stdout.readline()) for _ in lines]
        self.assertEqual([answer["id"] for answer in answers],
                         [None, None, 3, 4, 5, 6, None, 8, 9, 10, 11, 12])
        self.assertEqual([answer["error"]["kind"] for answer in answers],
                         ["request"] * len(lines))

    def test_ranks_give_equal_answers(self):
        with Server() as one, Server(ranks=2) as two:
            answers = [server.evaluate(AT, gradients=True) for server in (one, two)]
            self.assertEqual(two.ready["ranks"], 2)
        for name, value in answers[0]["values"].items():
            self.assertAlmostEqual(answers[1]["values"][name] / value, 1., delta=1e-8, msg=name)

    def test_contact_tables_balance_the_load(self):
        with Server() as server:
            answer = server.evaluate(AT, contact=True)
        table = answer["contact"][0]
        force = sum(force * normal[1] for force, normal in zip(table["force"], table["normal"]))
        self.assertAlmostEqual(abs(force) / 20., 1., delta=1e-6)  # pressure 20 on a unit length

    def test_ends(self):
        for last in ('{"do": "quit"}\n', ""):
            with Server() as server:
                server.process.communicate(last, timeout=20)
                self.assertEqual(server.process.returncode, 0)
        with Server() as server:
            server.process.send_signal(signal.SIGTERM)
            begin = time.monotonic()
            self.assertEqual(server.process.wait(timeout=20), 0)
            self.assertLess(time.monotonic() - begin, 5.)
        with Server() as server:
            server.process.stdout.close()
            server.process.stdin.write('{"do": "describe"}\n')
            server.process.stdin.flush()
            self.assertEqual(server.process.wait(timeout=20), 0)
            server.process.stdout = open(os.devnull, encoding="utf-8")

    def test_targets_are_refused(self):
        done = subprocess.run([PROGRAM, "--serve", SCENE, "--set", SETS[0], "--set", SETS[1],
                               "--set", "Accuracy/Target=peak: 0.1"],
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("--serve takes one mesh", done.stderr)


if __name__ == "__main__":
    PROGRAM, SCENE, MPIEXEC = sys.argv[1:4]
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]], warnings="ignore")
