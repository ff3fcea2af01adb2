#!/usr/bin/env python3
"""Optimizations end by themselves, whatever the objective and the basis.

usage: ends.py SNUG SCENES
"""

import pathlib
import subprocess
import sys
import tempfile

SPLINE = ["Shape/Basis=B-spline patch", "Shape/Control points=5"]
NODES = ["Shape/Basis=node-wise", "Shape/Control points=", "Shape/Filter radius=0.3"]
BOX = ["Shape/Basis=B-spline box", "Shape/Face=", "Shape/Bodies=lower", "Shape/Box size=1.1, 1.1",
       "Shape/Box corner=-0.05, 0", "Shape/Control points=4, 4"]
POINT = ["Responses=tip", "Response tip/Quantity=displacement", "Response tip/Face=upper.top",
         "Optimization/Objective=tip"]
RUNS = [
    ("squeezed-beam.prm", []),
    ("two-blocks-2d.prm", ["Optimization/Objective=peak pressure"]),
    ("two-blocks-2d.prm", ["Optimization/Objective=pressure variance", *SPLINE]),
    ("two-blocks-2d.prm", ["Optimization/Objective=von Mises norm", *NODES]),
    ("two-blocks-2d.prm", ["Optimization/Objective=pressure norm", *BOX]),
    ("two-blocks-2d.prm", POINT),
]
TOLERANCES = ("gradient", "objective", "design")


def main(snug, scenes):
    failures = 0
    for scene, settings in RUNS:
        with tempfile.TemporaryDirectory() as output:
            command = [snug, pathlib.Path(scenes) / scene, "--output", output,
                       "--set", "Task=optimize"]
            for setting in settings:
                command += ["--set", setting]
            run = subprocess.run(command, capture_output=True, text=True, timeout=200)
        ended = [line for line in run.stdout.splitlines() if line.startswith("converged: ")]
        good = run.returncode == 0 and ended and any(
            ended[0].startswith(f"converged: {name} tolerance") for name in TOLERANCES)
        print("ok" if good else "FAILED", scene, settings, *ended, run.stderr.strip())
        failures += not good
    return failures > 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
