"""Error against cost: chart (c) and the table of the large scene."""

from runs import error, gradient
from scenes import (COMPLIANCE, HERTZ_3D, PUNCH, cells, heights, tolerance)

# name: method, options
METHODS = {
    "adjoint": ("adjoint", {}),
    "direct, block": ("direct", {}),
    "direct, recycled": ("direct", {"Solves": "recycled"}),
    "semi-analytic, central": ("direct", {"Derivatives": "central differences"}),
    "overall, forward": ("finite differences", {"Differences": "forward",
                                                "Step": "1e-5"}),
    "overall, central": ("finite differences", {"Differences": "central",
                                                "Step": "1e-4"})}


def measure(quick):
    """Rows for the file: variables, method, F-mults, seconds, error of dJ."""
    rows = []
    for n in (2,) if quick else (2, 3, 4, 8):
        base = {**cells(4 if quick else 10, "punch", "foundation"), **heights(n)}
        for objective, methods in (("compliance", METHODS),
                                   ("potential energy",
                                    {"energy": ("energy", {})})):
            chosen = {**base, "Optimization/Objective": objective}
            exact = gradient(HERTZ_3D, {**chosen, **tolerance("1e-12")},
                             "adjoint")["gradient"]["values"]
            for name, (method, options) in methods.items():
                found = gradient(HERTZ_3D, {**chosen, **tolerance("1e-6")},
                                 method, **options)
                of = found["gradient"]
                rows.append({"variables": n * n, "method": name,
                             "F-mults": of["f_mults"],
                             "states": of["f_mults"] / found["state"]["f_mults"],
                             "seconds": of["seconds"],
                             "error of dJ": error(of["values"], exact)})
    return rows


def of_one_variable(j, settings):
    """The direct method for one of 16 heights, the others fixed."""
    others = ", ".join(str(i) for i in range(16) if i != j)
    return gradient(PUNCH, {**settings, "Shape/Fixed": others}, "direct")


def measure_large(quick):
    """Rows for the file: the scene of 55,000 unknowns with 16 heights."""
    settings = {**COMPLIANCE, **tolerance("1e-6")}
    if quick:
        settings.update(cells(4, "punch", "foundation"))
    rows = []

    def add(name, runs):
        parts = [found["gradient"] for found in runs]
        f_mults = sum(part["f_mults"] for part in parts)
        rows.append({"method": name, "F-mults": f_mults,
                     "states": f_mults / runs[0]["state"]["f_mults"],
                     "factorizations": sum(part["numeric_factorizations"]
                                           for part in parts),
                     "seconds": sum(part["seconds"] for part in parts)})

    add("energy", [gradient(PUNCH, {
        **settings, "Optimization/Objective": "potential energy"}, "energy")])
    for name in ("adjoint", "direct, block", "direct, recycled"):
        method, options = METHODS[name]
        add(name, [gradient(PUNCH, settings, method, **options)])
    add("direct, 16 separate solves",
        [of_one_variable(j, settings) for j in range(2 if quick else 16)])
    return rows


def measure_many(quick):
    """Rows for the file: 16 heights against a variable for each node of the face."""
    n = 4 if quick else 32
    mesh = {f"Body {body}/Box cells": f"{n}, {n}, {n // 4}"
            for body in ("punch", "foundation")}
    nodes = {"Shape/Basis": "node-wise", "Shape/Control points": "",
             "Shape/Filter radius": "0.1"}
    rows = []
    for method, objective in (("energy", "potential energy"),
                              ("adjoint", "compliance")):
        for shape in ({}, nodes):
            runs = [gradient(PUNCH, {**mesh, **shape,
                                     "Optimization/Objective": objective},
                             method)["gradient"]
                    for _ in range(1 if quick else 5)]
            rows.append({"method": method,
                         "variables": len(runs[0]["values"]),
                         "F-mults": runs[0]["f_mults"],
                         "seconds, least": min(of["seconds"] for of in runs)})
    return rows
