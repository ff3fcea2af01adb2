"""Design a punch that tolerates misalignment, grinding errors and uncertain friction.

A punch is pressed on a block and pushed sideways. Three inputs are uncertain: the place of the load
(standard deviation 0.1 mm), the friction coefficient (between 0.1 and 0.4), and the height of the
crown (standard deviation 0.05 um). Each sample of offset and friction is a model in a process of its
own, which returns its peak pressure p with the gradient g. SLSQP of SciPy minimizes

    J = mean(p) + 3 deviation(p),   dJ/dx = mean(g) + 3 mean((p - mean(p)) g) / deviation(p).

The robust design is compared on fresh samples with the nominal one, which is made for a central
load. No design has a lower peak than the mean pressure of 1 MPa, which the nominal one must reach.
"""

import concurrent.futures
import sys

import numpy as np
from scipy.optimize import minimize
from scipy.stats import norm, qmc

import snug

LEVELS, N, FRESH = (2, 8, 16) if "--quick" in sys.argv else (3, 16, 64)
SCENE = {
    "Dimension": 2, "Bodies": ["punch", "block"], "Responses": ["peak"],
    "Body punch": {"Box corner": [-1, 0], "Box size": [2, 1], "Box cells": [4, 2],
                   "Refine where": "0.3 - y", "Local refinements": LEVELS, "Young's modulus": 1000},
    "Body block": {"Box corner": [-5, -5], "Box size": [10, 5], "Box cells": [10, 5],
                   "Refine where": "1.4 - sqrt(x^2 + y^2)", "Local refinements": LEVELS + 1,
                   "Young's modulus": 1000, "Supports": "bottom: xy"},
    "Contact": {"Pairs": "punch.bottom: block.top", "Friction": "Coulomb",
                "Friction coefficient": .2},
    "Shape": {"Basis": "formula modes", "Face": "punch.bottom", "Bounds": [-5, 10],  # [um]
              "Modes": "; ".join(f"0, 0.001*x^{power}" for power in (2, 4, 8, 16))},
    "Response peak": {"Quantity": "peak pressure", "Exponent": 20}}
NOMINAL = [0., .25, 0.]  # offset [mm], friction coefficient, error of the crown [um]


def entries(offset, friction):
    """Return the entries of a load of 2 N/mm at the offset, pushed sideways by 0.1 N/mm."""
    return {"Body punch/Force": "top: 0.1 -2", "Body punch/Moment": f"top: {.1 + 2. * offset}",
            "Contact/Friction coefficient": friction}


def samples(n, seed):
    unit = qmc.LatinHypercube(3, seed=seed).random(n)
    return np.column_stack([.1 * norm.ppf(unit[:, 0]), .1 + .3 * unit[:, 1],
                            .05 * norm.ppf(unit[:, 2])])


def optimum(rows):
    """Return the design with the lowest J over the samples."""
    models = [snug.Model.from_dict(SCENE, set=entries(*row[:2])) for row in rows]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        def value(x):
            results = list(pool.map(lambda row, model: model.evaluate(
                x + [row[2], 0., 0., 0.], gradients=["peak"]), rows, models))
            p = np.array([result["peak"] for result in results])
            g = np.array([result.gradients["peak"] for result in results])
            deviation = p.std() + 1e-12
            return (p.mean() + 3. * deviation,
                    g.mean(axis=0) + 3. * (p - p.mean()) @ g / len(p) / deviation)

        start, step = np.ones(4), 1e-4 * np.arange(1., 5.)
        difference = (value(start + step)[0] - value(start - step)[0]) / 2.
        assert abs(value(start)[1] @ step / difference - 1.) < 1e-3, "the gradient must be exact"
        found = minimize(value, start, jac=True, method="SLSQP", bounds=[(-4.5, 9.5)] * 4,
                         options={"ftol": 1e-6})  # the bounds leave room for the errors
    requests = sum(model.process.n for model in models)
    for model in models:
        model.close()
    return found.x, requests


designs = {"nominal": optimum([NOMINAL]), "robust": optimum(samples(N, 1))}
nominal, spread = {}, {}
for name, (x, requests) in designs.items():
    with snug.Model.from_dict(SCENE) as model:
        p = []
        for offset, friction, error in [NOMINAL, *samples(FRESH, 2)]:
            model.set(entries(offset, friction))
            p.append(model.evaluate(x + [error, 0., 0., 0.])["peak"])
    nominal[name], p = p[0], np.array(p[1:])
    spread[name] = p.mean() + 3. * p.std()
    print(f"{name}, {requests} requests: peak {nominal[name]:.3f} MPa without errors; with errors "
          f"{p.mean():.3f} + 3 * {p.std():.3f} = {spread[name]:.3f} MPa, maximum {p.max():.3f} MPa")
assert 1. <= nominal["nominal"] < 1.1, "the nominal design must have a nearly uniform pressure"
assert spread["robust"] < .85 * spread["nominal"], "the robust design must have a lower spread"
