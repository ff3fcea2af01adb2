"""Compute a Pareto front of volume against peak pressure by gradients and by NSGA-II.

A ball-shaped punch is pressed on a block, whose top face is shaped. Less volume costs a higher peak
pressure. SLSQP of SciPy minimizes the pressure under several limits of the volume (epsilon
constraint method), from two starts each, because the peak pressure has local minima. NSGA-II of
pymoo, if it is installed, uses no gradients. Both ends of the front are known: with all heights at
their lower bounds the volume is smallest, and a block that has the shape of the punch carries the
uniform pressure LOAD. The picture is pareto.png with the option --picture.
"""

import importlib.util
import pathlib
import sys

import numpy as np
from scipy.optimize import minimize

import snug
import snug.scipy

SCENE = pathlib.Path(__file__).resolve().parents[3] / "prm" / "peak-pressure.prm"
N = 4 if "--quick" in sys.argv else 8
SETTINGS = {"Body punch/Box cells": [N, N, N], "Body foundation/Box cells": [N, N, N],
            "Shape/Control points": [3, 3], "Shape/Symmetry": "x: 0.5, y: 0.5",
            "Responses": "peak, size", "Response size/Quantity": "volume",
            "Response size/Body": "foundation", "Response peak/Exponent": 8}
LOAD = 100.  # force over the area of the face [MPa]
WORST = 2000., .8  # reference point of the hypervolume [MPa, mm^3]
# Heights of the corners, edges and centre: a sphere of radius 8 rises by 1/16, 1/32 and 0.
CONFORMING = -.25 + np.array([1 / 16, 1 / 32, 1 / 32, 0.])


def hypervolume(points):
    """Return the area that points (peak, size) dominate up to WORST, relative to that of (0, 0.75)."""
    area, pressure = 0., WORST[0]
    for peak, size in sorted(map(tuple, points), key=lambda point: point[1]):
        if peak < pressure and size < WORST[1]:
            area, pressure = area + (pressure - peak) * (WORST[1] - size), peak
    return area / (WORST[0] * (WORST[1] - .75))


with snug.Model(SCENE, SETTINGS) as model:
    front, last = [], model.lower
    for part in np.linspace(0., 1., 9):
        guess = model.lower + part * (CONFORMING - model.lower)
        limit = model.evaluate(guess)["size"]
        task = snug.scipy.problem(model, "peak", [("size", 0., limit)])
        best = min((minimize(**{**task, "x0": start / model.scale}, method="SLSQP",
                             options={"ftol": 1e-6}) for start in (guess, last)),
                   key=lambda found: found.fun)
        last = np.array(model.design(best.x * model.scale))
        front.append((best.fun, model.evaluate(last)["size"]))
        print(f"volume {front[-1][1]:.4f} mm^3: peak pressure {best.fun:6.1f} MPa")
    requests = model.process.n
    print(f"SLSQP: {len(front)} points, hypervolume {hypervolume(front):.3f}, {requests} requests")
    peaks = np.array(front)[:, 0]
    assert (np.diff(peaks) <= 1e-6 * peaks[0]).all(), "a larger volume must not cost pressure"
    assert LOAD <= peaks[-1] < 1.01 * LOAD, "the conforming block must carry the mean pressure"
    fronts = {"SLSQP": front}
    if importlib.util.find_spec("pymoo"):
        from pymoo.algorithms.moo.nsga2 import NSGA2
        from pymoo.optimize import minimize as evolve
        from snug.pymoo import SnugProblem
        for generations in (15, 50):
            before = model.process.n
            found = evolve(SnugProblem(model, ["peak", "size"]), NSGA2(pop_size=24),
                           ("n_gen", generations), seed=1).F
            fronts[f"NSGA-II, {generations} generations"] = found
            print(f"NSGA-II: {len(found)} points, hypervolume {hypervolume(found):.3f}, "
                  f"{model.process.n - before} requests")

if "--picture" in sys.argv:
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(figsize=(6., 3.6), layout="constrained")
    for (name, points), style in zip(fronts.items(), ("o-", "v", "s")):
        axes.plot(*np.array(sorted(map(tuple, points)))[:, ::-1].T, style, label=name, mfc="none")
    axes.set(xlabel="volume of the block, mm$^3$", ylabel="peak pressure, MPa",
             xlim=(.748, WORST[1]))
    axes.legend()
    figure.savefig("pareto.png", dpi=120)
