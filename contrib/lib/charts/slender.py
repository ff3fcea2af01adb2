"""Error against slenderness: chart (b)."""

import beam
from runs import gradient
from scenes import BEAM, tolerance

MODULUS, RATIO = "1000", "0.3"

METHODS = {"exact": ("exact", "1e-5"),
           "forward": ("forward differences", "1e-5"),
           "central": ("central differences", "1e-4"),
           "refined forward": ("refined forward differences", "1e-5"),
           "refined central": ("refined central differences", "1e-4")}


def settings(slenderness):
    """Square cells. Forces of a chain of subdomains lose digits with its length
    only: five are enough."""
    return {"Body beam/Box size": f"{slenderness}, 1",
            "Body beam/Box cells": f"{slenderness}, 1",
            "Decomposition/Subdomains": "5" if slenderness >= 20 else "1",
            **tolerance("1e-5")}


def measure(quick):
    """Rows for the file: L/H, derivatives, step, error of dC/dL."""
    rows = []
    for slenderness in (5, 20) if quick else (5, 10, 20, 40, 80, 160, 320):
        reference = float(beam.compliance_derivative(
            slenderness, slenderness, 1, MODULUS, RATIO))
        for name, (derivatives, step) in METHODS.items():
            found = gradient(BEAM, settings(slenderness), "adjoint",
                             **{"Derivatives": derivatives,
                                "Semi-analytic step": step})
            value = found["gradient"]["values"][0]
            rows.append({"L/H": slenderness, "derivatives": name,
                         "step": float(step),
                         "error": abs(value / reference - 1)})
    return rows
