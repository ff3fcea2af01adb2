"""What a design costs: gradients against the number of variables, whole searches, and the
table of the paper."""

from runs import error, gradient, history, on_processor
from scenes import COMPLIANCE, HERTZ_3D, cells, heights, tolerance

# name: method, options, the most variables whose states are worth their time
METHODS = {
    "adjoint": ("adjoint", {}, 256),
    "direct, block": ("direct", {}, 256),
    "direct, recycled": ("direct", {"Solves": "recycled"}, 256),
    "semi-analytic, central": ("direct", {"Derivatives": "central differences"}, 256),
    "overall, forward": ("finite differences", {"Differences": "forward",
                                                "Step": "1e-5"}, 64),
    "overall, central": ("finite differences", {"Differences": "central",
                                                "Step": "1e-4"}, 64)}
ENERGY = {"energy": ("energy", {}, 256)}


def face(n, cells_below=4):
    """Many nodes on the face that is shaped, few below it."""
    return {f"Body {body}/Box cells": f"{n}, {n}, {cells_below}"
            for body in ("punch", "foundation")}


def measure_variables(quick):
    """Rows for the file: variables, method, F-mults, states, seconds, error of dJ."""
    rows = []
    for n in (2,) if quick else (1, 2, 4, 8, 16):
        base = {**face(4 if quick else 16), **heights(n)}
        for objective, methods in (("compliance", METHODS), ("potential energy", ENERGY)):
            chosen = {**base, "Optimization/Objective": objective}
            exact = gradient(HERTZ_3D, {**chosen, **tolerance("1e-12")},
                             "adjoint")["gradient"]["values"]
            for name, (method, options, most) in methods.items():
                if n * n > most:
                    continue
                found = gradient(HERTZ_3D, {**chosen, **tolerance("1e-6")}, method, **options)
                of, state = found["gradient"], on_processor(found, "assembly", "factorization",
                                                            "soft_modes", "solve")
                rows.append({"variables": n * n, "method": name, "F-mults": of["f_mults"],
                             "states": of["f_mults"] / found["state"]["f_mults"],
                             "seconds": found["share"] * of["seconds"],
                             "seconds of the state": state,
                             "error of dJ": error(of["values"], exact)})
    return rows


LOOSE = ("1e-1", "1e-2", "1e-4")


def searches(quick):
    """{(picture, curve): entries}; the default tolerance of states is 1e-6."""
    gradients = {
        "energy formula": {"Gradient/Method": "energy"},
        "adjoint": {"Gradient/Method": "adjoint"},
        "direct": {"Gradient/Method": "direct"},
        "semi-analytic, forward": {"Gradient/Method": "direct",
                                   "Gradient/Derivatives": "forward differences"},
        **{f"overall, {stencil}": {"Gradient/Method": "finite differences",
                                   "Gradient/Differences": stencil, "Gradient/Step": step}
           for stencil, step in (("forward", "1e-5"), ("central", "1e-4"))}}
    result = {("gradients", name): entries for name, entries in gradients.items()}
    for value in (*LOOSE, "1e-6", "1e-8"):
        result["tolerances", value] = {**gradients["energy formula"], **tolerance(value)}
    return dict(list(result.items())[::4]) if quick else result


def measure_searches(quick):
    """Rows for the file, one per design that an iteration ended with, and rows of the
    table, one per search."""
    rows, table = [], []
    for (picture, name), entries in searches(quick).items():
        iterations, found = history(HERTZ_3D, {
            "Accuracy/Estimate": "none", "Solver/Relative tolerance": "1e-6",
            **cells(4 if quick else 8, "punch", "foundation"), **heights(3),
            "Optimization/Maximum evaluations": 5 if quick else 200, **entries})
        end = found["optimization"]
        rows += [{"picture": picture, "search": name, "iteration": row["iteration"],
                  "seconds": found["share"] * row["seconds"], "objective": row["objective"],
                  "volume": row["constraint_violation"]} for row in iterations]
        table.append({"picture": picture, "search": name, "evaluations": end["evaluations"],
                      "F-mults": found["work"]["f_mults"], "seconds": rows[-1]["seconds"],
                      "objective": end["objective_final"],
                      "stopped by": end["stop_reason"]})
    # loosely solved states have objectives below the least one
    best = min(row["objective"] for row in table if row["search"] not in LOOSE)
    start = rows[0]["objective"]
    for row in rows + table:
        row["distance"] = abs((row["objective"] - best) / (start - best))
    return rows, table


# Of the paper, seconds: its state, and the derivatives one after the other and in parallel.
PAPER = {9: (15, 135, 30), 16: (15, 240, 40)}


def measure_paper(quick):
    """Rows for the file: seconds of a processor per rank, also those in which it waits for
    the other rank."""
    rows = []
    names = ("adjoint",) if quick else ("adjoint", "direct, block", "direct, recycled", "energy")
    for variables in PAPER:
        for ranks in (1, 2):
            for name in names:
                method, options, _ = {**METHODS, **ENERGY}[name]
                found = gradient(f"prm/hertz-3d-{variables}.prm", {
                    **({} if method == "energy" else COMPLIANCE),
                    **(cells(4, "punch", "foundation") if quick else {})},
                    method, ranks, **options)
                rows.append({
                    "variables": variables, "ranks": ranks, "method": name,
                    "state": on_processor(found, "assembly", "factorization",
                                          "soft_modes", "solve") / ranks,
                    "gradient": found["share"] * found["gradient"]["seconds"] / ranks,
                    "state F-mults": found["state"]["f_mults"],
                    "F-mults": found["gradient"]["f_mults"]})
    return rows
