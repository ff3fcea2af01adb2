"""Optimize the three parameters of a roller's profile by the chain rule.

The profile of Fujiwara and Kawase (NTN Technical Review 75, 2007, p. 140) is the logarithm of Lundberg
with three parameters K1, K2, zm. The drop at the distance x from the middle of the roller is

    z = K1 A ln 1 / (1 - (1 - exp(-zm / (K1 A))) t^2),  t = max(0, (x - HALF) / (K2 HALF) + 1).

The variables of the model are the heights of the profile at the nodes. Snug returns the derivatives of
all peak pressures with respect to them, and the formula has those of the heights, so that SLSQP of
SciPy minimizes the largest peak under three loads and three tilts with exact gradients. The answer is
compared with a search without gradients (doc/gallery/roller.md), and with the profile of Lundberg, which
is K1 = K2 = 1 and zm = infinity.
"""

import pathlib
import sys

import numpy as np
from scipy.optimize import minimize

import snug

SCENE = pathlib.Path(__file__).resolve().parents[3] / "prm" / "roller.prm"
HALF, A = 9., 20. * (3000. * .91 / 206000.) ** 2  # [mm], A = R (p0 / E*)^2
WEIGHTS = {"light": 2., "middle": 3000. / 2200., "heavy": 1.}
KNOWN = np.array([1.44, 1., .0165 / (1.44 * A)])  # found without gradients
SETTINGS = {"Shape/Bounds": [-1., .1]}
if "--quick" in sys.argv:
    SETTINGS["Body block/Box cells"] = [24, 3, 2]
    for case in WEIGHTS:  # the largest tilt alone
        SETTINGS[f"Load case {case}/Cases"] = 1
        SETTINGS[f"Load case {case}/Position"] = "race: rotate y 0.0286478"


def drop(y, x):
    """Return the drop [mm] at x for y = K1, K2, zm / (K1 A), along its tangent beyond HALF."""
    c, t = 1. - np.exp(-y[2]), (np.minimum(x, HALF) - HALF) / (y[1] * HALF) + 1.
    t = np.where(np.real(t) > 0., t, 0.)
    slope = 2. * y[0] * A * c / (1. - c) / (y[1] * HALF)
    return -y[0] * A * np.log(1. - c * t * t) + slope * np.maximum(x - HALF, 0.)


with snug.Model(SCENE, SETTINGS) as model:
    places = np.unique(np.round(np.abs(model.evaluate(contact=True).contact()["x"]), 6))
    near = np.minimum(places, HALF + 1.)  # there is no contact beyond
    model.set({"Shape/Modes": snug.heights(places, (0, 0, -1), "abs(x)")})
    weights = np.array([WEIGHTS[case["name"].split("-")[0]] for case in model.load_cases])
    names = [f"{case['name']}.peak" for case in model.load_cases]

    def peaks(y):
        """Return the weighted peaks and their derivatives with respect to y, a row for each."""
        result = model.evaluate(drop(y, near), gradients=names)
        slopes = [np.imag(drop(y + 1e-30j * unit, near)) / 1e-30 for unit in np.eye(3)]
        return (weights * [result[name] for name in names],
                weights[:, None] * [np.dot(slopes, result.gradients[name]) for name in names])

    def largest(z):
        """Return the largest weighted nodal pressure of a profile of drops z."""
        return max(weights * [case["max_pressure"] for case in model.evaluate(z).load_cases])

    start, step = np.array([1., .9, 3.]), 1e-5 * np.array([1., 2., 3.])
    difference = (peaks(start + step)[0] - peaks(start - step)[0]) / 2.
    # Relative to the largest slope, as differences contain the errors of the states.
    error = np.abs(peaks(start)[1] @ step - difference).max() / np.abs(difference).max()
    assert error < 1e-3, "gradients must agree with differences"

    # Minimize the variable y[3] [GPa], which no peak exceeds.
    found = minimize(lambda y: (y[3], np.array([0., 0., 0., 1.])), jac=True, method="SLSQP",
                     x0=[*start, peaks(start)[0].max() / 1e3], options={"ftol": 1e-5},
                     bounds=[(.5, 3.), (.3, 1.), (1., 5.), (0., None)], constraints={
                         "type": "ineq", "fun": lambda y: y[3] - peaks(y[:3])[0] / 1e3,
                         "jac": lambda y: np.column_stack([-peaks(y[:3])[1] / 1e3, weights ** 0])})
    best = found.x[:3]
    norm, known = peaks(best)[0].max(), peaks(KNOWN)[0].max()
    end = 8.8543  # where the curvature of Lundberg's profile is that of the end radius of 6 mm
    lundberg = (-A * np.log(1. - (np.minimum(near, end) / HALF) ** 2)
                + 2. * A * end / (HALF ** 2 - end ** 2) * np.maximum(near - end, 0.)
                + np.maximum(near - end, 0.) ** 2 / 12. - np.maximum(near - HALF, 0.) ** 2 / 12.)
    print(f"K1 = {best[0]:.3f}, K2 = {best[1]:.3f}, zm = {1e3 * best[0] * A * best[2]:.1f} um in "
          f"{found.nfev} evaluations; largest norm {norm:.0f} MPa, without gradients {known:.0f} MPa")
    table = {"straight": 0. * places, "Lundberg": lundberg, "without gradients": drop(KNOWN, near),
             "SLSQP": drop(best, near)}
    pressures = {name: largest(z) for name, z in table.items()}
    print("largest pressures [MPa]:", ", ".join(f"{n} {p:.0f}" for n, p in pressures.items()))
assert norm <= known * 1.001, "the search with gradients must not be worse"
assert pressures["SLSQP"] < pressures["Lundberg"] < pressures["straight"], "crowning must help"
