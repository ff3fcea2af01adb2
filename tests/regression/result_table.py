#!/usr/bin/env python3
"""The end of an optimization says what it has done: result_table.py SNUG SCENES.

The table of the log, summary.json and history.csv have the same values of the first and the last
design, and the same limits. Limits of negative values, and pressures that fall with the contact force,
are warned of. 'Shape/Initial' takes the design of another run, also on another mesh, and load_cases.csv
has the values of summary.json."""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile

LIMITS = ["Responses=push", "Response push/Quantity=contact force", "Response push/Component=y",
          "Optimization/Constraints=volume: initial, push: >= 0.5 initial, contact area: <= 2",
          "Optimization/Maximum evaluations=6", "Task=optimize"]
NEGATIVE = ["Optimization/Objective=volume", "Task=optimize", "Optimization/Maximum evaluations=2",
            "Optimization/Constraints=potential energy: >= 1.5 initial"]
# The upper block is pressed by a displacement, without a force.
RETREAT = ["Body upper/Pressure=", "Body upper/Displacement=top: y = -0.01",
           "Optimization/Objective=peak pressure", "Optimization/Maximum evaluations=2",
           "Task=optimize"]

# A search on the peak pressure ends with 17 of 25 nodes in contact. The pressure of the load is a
# lower bound of the peak, which the uniform pressure of all nodes in contact reaches.
WIDEN = ["Optimization/Objective=peak pressure", "Task=optimize", "Body upper/Box cells=24, 12",
         "Body lower/Box cells=24, 12", "Body upper/Curved faces=bottom: cylinder z 1.5",
         "Body upper/Pressure=top: 8", "Shape/Basis=B-spline patch", "Shape/Control points=8",
         "Shape/Bounds=-0.2, 0.2", "Shape/Face=upper.bottom"]

SAME = ["Optimization/Objective=peak pressure", "Optimization/Maximum evaluations=1",
        "Task=optimize"]


class Runner:
    def __init__(self, snug, scenes, folder):
        self.snug, self.scenes, self.folder, self.wrong = snug, scenes, folder, 0

    def run(self, name, scene, entries):
        """Run a scene. Return its log, its summary and its output directory."""
        output = self.folder / name
        command = [self.snug, self.scenes / scene, "--output", output]
        for entry in entries:
            command += ["--set", entry]
        done = subprocess.run(command, text=True, check=False, timeout=200,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        if not (output / "summary.json").exists():
            raise SystemExit(f"{name}: {done.stdout}")
        return done.stdout, json.loads((output / "summary.json").read_text()), output

    def require(self, title, good, message=""):
        print(f"{title}: {'good' if good else 'WRONG'} {'' if good else message}")
        self.wrong += not good


def row_of(log, name):
    """Return the words behind a name in the table at the end of a log."""
    table = log.split("first design  last design")[1]
    rows = [line.split(name, 1)[1].split() for line in table.splitlines()
            if line.strip().startswith(name + " ")]
    return rows[0] if rows else []


def close(a, b, tolerance=1e-5):
    return abs(float(a) - b) <= tolerance * max(abs(b), 1e-12)


def check_table(runner):
    log, summary, output = runner.run("limits", "two-blocks-2d.prm", LIMITS)
    with open(output / "history.csv", encoding="utf-8") as file:
        lines = list(csv.DictReader(file))
    found = summary["optimization"]
    row = row_of(log, "potential energy")
    change = 100. * abs(1. - found["objective_final"] / found["objective_initial"])
    runner.require("objective", "minimized:" in row and close(row[-3], change, 5e-3) and
                   row[-1] == "lower" and close(row[0], float(lines[0]["objective"])) and
                   close(row[1], found["objective_final"]), log)
    runner.require("three constraints", len(found["constraints"]) == 3, str(found))
    for constraint in found["constraints"]:
        name = constraint["name"]
        row = row_of(log, name)
        text = " ".join(row[2:])
        state = "not active" if not constraint["active"] else "active"
        runner.require(f"row of {name}", close(row[0], constraint["initial"]) and
                       close(row[1], constraint["value"]) and
                       close(text.split()[1].rstrip(","), constraint["limit"]) and
                       (text.endswith(", " + state) or "violated by" in text), text)
    push = next(item for item in found["constraints"] if item["name"].startswith("push"))
    runner.require("value of history", close(lines[-1]["push"], push["value"], 1e-12), str(lines[-1]))
    runner.require("limit of a positive value", push["initial"] > 0. and
                   "refers to a negative value" not in log, log)
    log, _, _ = runner.run("negative", "two-blocks-2d.prm", NEGATIVE)
    runner.require("limit of a negative value",
                   "'potential energy >= 1.5 initial' refers to a negative value:" in log, log)
    return output, summary


def check_initial(runner, output, summary):
    volume = next(item for item in summary["optimization"]["constraints"]
                  if item["name"].startswith("volume"))
    # The volume below a curve depends on its facets.
    for name, tolerance, entries in (("same", 1e-9, []),
                                     ("finer", 1e-3, ["Body lower/Refinements=1"])):
        _, found, _ = runner.run(name, "two-blocks-2d.prm", [
            *LIMITS[:3], "Task=state", f"Shape/Initial={output}", "Responses=push, size",
            "Response size/Quantity=volume", *entries])
        runner.require(f"design of another run, {name} mesh", close(
            found["state"]["responses"]["size"], volume["value"], tolerance),
                       str(found["state"]["responses"]))


def check_load_cases(runner):
    _, summary, output = runner.run("cases", "load-cases-2d.prm", ["Task=state"])
    with open(output / "load_cases.csv", encoding="utf-8") as file:
        lines = list(csv.DictReader(file))
    runner.require("load_cases.csv", len(lines) == len(summary["load_cases"]) and all(
        float(line["energy"]) == case["state"]["energy"] and line["load_case"] == case["name"]
        for line, case in zip(lines, summary["load_cases"])), str(lines))


def check_estimated_case(runner):
    """The error in the energy norm is that of the load case with the largest strain energy; those of responses
    are of all load cases."""
    log, found, output = runner.run("energy", "load-cases-2d.prm", ["Task=state"])
    _, every, _ = runner.run("every", "load-cases-2d.prm", ["Task=state", "Accuracy/Estimate=responses"])
    cases = {case["name"]: case["state"] for case in found["load_cases"]}
    largest = max(cases, key=lambda name: cases[name]["strain_energy"])
    runner.require("one error", [name for name, state in cases.items() if state["accuracy"]] == [largest] and
                   log.count("estimated discretization error") == 1 and
                   f"error in load case {largest}, which has the largest strain energy" in log, log)
    runner.require("largest error", found["state"]["largest"]["discretization_error"]
                   == {"load_case": largest, "value": cases[largest]["accuracy"]["relative"]},
                   str(found["state"]["largest"]))
    fields = {name: b'Name="error"' in next((output / name).glob("solution-*.pvtu")).read_bytes() for name in cases}
    runner.require("pictures of the error", fields == {name: name == largest for name in cases}, str(fields))
    all_errors = {case["name"]: case["state"]["accuracy"] for case in every["load_cases"]}
    runner.require("errors of all load cases", all(all_errors.values()) and
                   close(all_errors[largest]["relative"], cases[largest]["accuracy"]["relative"], 1e-9),
                   str(all_errors))


def main(snug, scenes):
    with tempfile.TemporaryDirectory() as folder:
        runner = Runner(pathlib.Path(snug).resolve(), pathlib.Path(scenes), pathlib.Path(folder))
        check_initial(runner, *check_table(runner))
        log, _, _ = runner.run("retreat", "two-blocks-2d.prm", RETREAT)
        runner.require("retreat", "falls if the face retreats" in log, log)
        log, _, _ = runner.run("same contact", "two-blocks-2d.prm", SAME)
        runner.require("contact as it was", "as many as in the first design" in log, log)
        log, summary, _ = runner.run("wider contact", "two-blocks-2d.prm", WIDEN)
        runner.require("wider contact", "searching again" in log and
                       8. < summary["optimization"]["objective_final"] < 8. * 1.001, log)
        check_load_cases(runner)
        check_estimated_case(runner)
    return runner.wrong > 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
