#!/usr/bin/env python3
"""The worst of several positions, against scipy on the same values: minimax.py SNUG SCENE MPIEXEC.

Snug minimizes the worst weighted peak pressure of three positions at a fixed volume. SLSQP of scipy
solves the same problem with a variable for the maximum; for each of its designs the values and the
gradients of all load cases come from a run of Snug. Both reach the same maximum. A search on three ranks
ends there, too."""

import importlib.util
import json
import os
import pathlib
import sys
import tempfile

# The packages of the system belong to the interpreter of the system.
SYSTEM = "/usr/bin/python3"
if importlib.util.find_spec("scipy") is None and sys.executable != SYSTEM:
    os.execv(SYSTEM, [SYSTEM, *sys.argv])

import numpy  # noqa: E402
from scipy.optimize import minimize  # noqa: E402

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "contrib/lib"))

from runs import execute, execute_in_common  # noqa: E402

TOLERANCE = 1e-5
# of the load cases of the scene
WEIGHTS = {"middle": 1., "rocking-0": 1., "rocking-1": 0.7}


def run(snug, scene, folder, *sets, launcher=()):
    words = [*launcher, snug, scene, "--output", str(folder)]
    for text in sets:
        words += ["--set", text]
    status, _, said, *_ = execute(words) if launcher else execute_in_common(words)
    if status != 0:
        sys.exit(f"{' '.join(words)}: status {status}\n{said}")
    return json.loads((folder / "summary.json").read_text(encoding="utf-8"))


class Values:
    """The peak pressures of the load cases and the volume, with differences as gradients."""

    def __init__(self, snug, scene, folder):
        self.snug, self.scene, self.folder = snug, scene, folder
        self.known = {}

    def __call__(self, design):
        key = tuple(design)
        if key not in self.known:
            text = ", ".join(repr(float(x)) for x in design)
            summary = run(self.snug, self.scene, self.folder, "Task=state",
                          f"Shape/Initial={text}", "Solver/Relative tolerance=1e-11",
                          "Accuracy/Estimate=none")
            cases = summary["state"]["load_cases"]
            self.known[key] = numpy.array(
                [weight * cases[name]["responses"]["peak"] for name, weight in WEIGHTS.items()] +
                [cases["middle"]["responses"]["space"]])
        return self.known[key]

    def gradients(self, design, step=1e-6):
        columns = []
        for i in range(len(design)):
            moved = numpy.array(design, float)
            moved[i] += step
            columns.append((self(moved) - self(design)) / step)
        return numpy.array(columns).T


def independent_minimax(values, start, bounds):
    """Return the least maximum, with x = (design, maximum / scale)."""
    scale = max(values(start)[:-1])
    volume = values(start)[-1]
    n = len(start)
    result = minimize(
        lambda x: x[n], [*start, 1.], jac=lambda x: numpy.eye(n + 1)[n],
        bounds=[bounds] * n + [(0., 10.)], method="SLSQP",
        constraints=[
            {"type": "ineq", "fun": lambda x: x[n] - values(x[:n])[:-1] / scale,
             "jac": lambda x: numpy.column_stack([-values.gradients(x[:n])[:-1] / scale,
                                                  numpy.ones(len(WEIGHTS))])},
            {"type": "eq", "fun": lambda x: values(x[:n])[-1] - volume,
             "jac": lambda x: numpy.append(values.gradients(x[:n])[-1], 0.)}],
        options={"ftol": 1e-10, "maxiter": 60})
    if not result.success:
        sys.exit(f"scipy: {result.message}")
    return result.x[n] * scale, result.x[:n]


def main():
    snug, scene, mpiexec = sys.argv[1:4]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        summary = run(snug, scene, folder / "snug")
        found = summary["optimization"]["objective_final"]
        values = Values(snug, scene, folder / "values")
        best, design = independent_minimax(values, [0.] * 4, (-0.1, 0.1))
        print(f"snug {found:.8g}, scipy {best:.8g} at {design}")
        if not abs(found - best) <= TOLERANCE * best:
            sys.exit("the minimax values differ")
        other = run(snug, scene, folder / "np3", launcher=[mpiexec, "-np", "3"])
        value = other["optimization"]["objective_final"]
        if not abs(found - value) <= 1e-6 * found:
            sys.exit(f"3 ranks: {value} instead of {found}")


if __name__ == "__main__":
    main()
