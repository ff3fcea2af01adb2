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


def quickest(jobs, quick):
    """{name: the fastest of some equal runs} of {name: arguments of gradient()}. Others
    may use the machine, too: all jobs take turns."""
    best = {}
    for _ in range(1 if quick else 3):
        for name, (scene, settings, method, options) in jobs.items():
            found = gradient(scene, settings, method, **options)
            if (name not in best or found["gradient"]["seconds"] <
                    best[name]["gradient"]["seconds"]):
                best[name] = found
    return best


def measure_large(quick):
    """Rows for the file: the scene of 55,000 unknowns with 16 heights."""
    settings = {**COMPLIANCE, **tolerance("1e-6")}
    if quick:
        settings.update(cells(4, "punch", "foundation"))
    jobs = {"energy": (PUNCH, {
        **settings, "Optimization/Objective": "potential energy"}, "energy", {})}
    for name in ("adjoint", "direct, block", "direct, recycled"):
        jobs[name] = (PUNCH, settings, *METHODS[name])
    separate = []
    for j in range(2 if quick else 16):
        others = ", ".join(str(i) for i in range(16) if i != j)
        separate.append(f"separate {j}")
        jobs[separate[-1]] = (PUNCH, {**settings, "Shape/Fixed": others},
                              "direct", {})
    best = quickest(jobs, quick)
    groups = {name: [name] for name in jobs if name not in separate}
    groups["direct, 16 separate solves"] = separate
    return [cost_row(name, [best[part] for part in parts])
            for name, parts in groups.items()]


def cost_row(name, runs):
    """The cost of runs together, in F-mults and in those of one state."""
    parts = [found["gradient"] for found in runs]
    f_mults = sum(part["f_mults"] for part in parts)
    return {"method": name, "F-mults": f_mults,
            "states": f_mults / runs[0]["state"]["f_mults"],
            "factorizations": sum(part["numeric_factorizations"]
                                  for part in parts),
            "seconds": sum(part["seconds"] for part in parts)}


def measure_many(quick):
    """Rows for the file: 16 heights against a variable for each node of the face."""
    n = 4 if quick else 32
    mesh = {f"Body {body}/Box cells": f"{n}, {n}, {n // 4}"
            for body in ("punch", "foundation")}
    nodes = {"Shape/Basis": "node-wise", "Shape/Control points": "",
             "Shape/Filter radius": "0.1"}
    jobs = {}
    for method, objective in (("energy", "potential energy"),
                              ("adjoint", "compliance")):
        for basis, shape in (("heights", {}), ("nodes", nodes)):
            settings = {**mesh, **shape, "Optimization/Objective": objective}
            jobs[method, basis] = (PUNCH, settings, method, {})
    return [{"method": method, "variables": len(found["gradient"]["values"]),
             "F-mults": found["gradient"]["f_mults"],
             "seconds": found["gradient"]["seconds"]}
            for (method, _), found in quickest(jobs, quick).items()]
