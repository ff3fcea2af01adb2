"""Charts of what a design costs: gradients against the number of variables, whole searches, and
the table of the paper."""

import drawing

from common import (COMPLIANCE, HERTZ_3D, add_legend, by, cells, curves, error, gradient,
                    heights, numbers, panels, tolerance)
from runs import print_table, solve, write_csv

STATE = ("assembly", "factorization", "soft_modes", "solve")

# method, its entries, the most variables whose states are worth their time
METHODS = {
    "adjoint": ("adjoint", {}, 256),
    "direct, block": ("direct", {}, 256),
    "direct, recycled": ("direct", {"Gradient/Solves": "recycled"}, 256),
    "semi-analytic, central": ("direct", {"Gradient/Derivatives": "central differences"}, 256),
    "overall, forward": ("finite differences", {"Gradient/Differences": "forward",
                                                "Gradient/Step": "1e-5"}, 64),
    "overall, central": ("finite differences", {"Gradient/Differences": "central",
                                                "Gradient/Step": "1e-4"}, 64)}
ENERGY = {"energy": ("energy", {}, 256)}


def variables_rows(n, quick):
    """Return the rows of n x n variables: F-mults, states, seconds, error of dJ."""
    # many nodes on the face that is shaped, few below it
    across = 4 if quick else 16
    base = {**heights(n), **{f"Body {body}/Box cells": f"{across}, {across}, 4"
                             for body in ("punch", "foundation")}}
    rows = []
    for objective, methods in (("compliance", METHODS), ("potential energy", ENERGY)):
        chosen = {**base, "Optimization/Objective": objective}
        exact = gradient(HERTZ_3D, {**chosen, **tolerance("1e-12")},
                         "adjoint").summary["gradient"]["values"]
        for name, (method, entries, most) in methods.items():
            if n * n > most:
                continue
            found = gradient(HERTZ_3D, {**chosen, **tolerance("1e-6"), **entries}, method)
            of = found.summary["gradient"]
            rows.append({"variables": n * n, "method": name, "F-mults": of["f_mults"],
                         "states": of["f_mults"] / found.state["f_mults"],
                         "seconds": found.share * of["seconds"],
                         "seconds of the state": found.on_processor(*STATE),
                         "error of dJ": error(of["values"], exact)})
    return rows


def draw_variables(output, quick):
    rows = numbers(output / "design-variables.csv", lambda: [
        row for n in ((2,) if quick else (1, 2, 4, 8, 16)) for row in variables_rows(n, quick)])
    figure, (seconds, errors) = panels(2)
    order = list(by(rows, "method"))
    state = by(rows, "method")["adjoint"]
    seconds.loglog([row["variables"] for row in state],
                   [row["seconds of the state"] for row in state], "k--", label="the state")
    counts = sorted(by(rows, "variables"))
    curves(seconds, rows, "method", "variables", "seconds", order)
    seconds.set_ylabel("CPU seconds of the gradient")
    seconds.set_xticks(counts, [f"{count:g}" for count in counts])
    seconds.minorticks_off()
    curves(errors, rows, "method", "seconds", "error of dJ", order)
    errors.set_xlabel("CPU seconds of the gradient")
    errors.set_ylabel("relative error of dJ, 1 to 256 variables")
    figure.suptitle("Gradients against the number of variables; states solved to 1e-6")
    add_legend(errors, *seconds.get_legend_handles_labels())
    drawing.save(figure, output, "design-variables.png")
    print_table([{key: row[key] for key in ("method", "variables", "F-mults", "states",
                                            "seconds", "error of dJ")} for row in rows
                 if quick or row["variables"] != 4])


LOOSE = ("1e-1", "1e-2", "1e-4")


def searches(quick):
    """Return {(picture, curve): entries}; the default tolerance of states is 1e-6."""
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
    """Return rows for the file, one per design that an iteration ended with, and rows of the
    table, one per search."""
    rows, table = [], []
    for (picture, name), entries in searches(quick).items():
        found = solve(HERTZ_3D, {
            "Accuracy/Estimate": "none", "Solver/Relative tolerance": "1e-6",
            **cells(4 if quick else 8, "punch", "foundation"), **heights(3),
            "Optimization/Maximum evaluations": 5 if quick else 200, **entries})
        end = found.summary["optimization"]
        rows += [{"picture": picture, "search": name, "iteration": row["iteration"],
                  "seconds": found.share * row["seconds"], "objective": row["objective"],
                  "volume": row["constraint_violation"]} for row in found.history]
        table.append({"picture": picture, "search": name, "evaluations": end["evaluations"],
                      "F-mults": found.summary["work"]["f_mults"],
                      "seconds": rows[-1]["seconds"], "objective": end["objective_final"],
                      "stopped by": end["stop_reason"]})
    # loosely solved states have objectives below the least one
    best = min(row["objective"] for row in table if row["search"] not in LOOSE)
    start = rows[0]["objective"]
    for row in rows + table:
        row["distance"] = abs((row["objective"] - best) / (start - best))
    return rows, table


def draw_searches(output, quick):
    table = []

    def measured():
        rows, of_searches = measure_searches(quick)
        table.extend(of_searches)
        return rows
    rows = numbers(output / "design-searches.csv", measured)
    seconds = [row["seconds"] for row in rows]
    figure, axes = panels(2, 5.)
    for axis, (picture, group) in zip(axes, by(rows, "picture").items()):
        curves(axis, group, "search", "seconds", "distance")
        axis.set_title(picture, fontsize="medium")
        axis.set_xlabel("CPU seconds of the search")
        axis.set_ylabel("objective above the best, relative to the first")
        axis.set_ylim(1e-9, 2.)
        axis.set_xlim(.8 * min(seconds), 1.2 * max(seconds))
        axis.legend(fontsize="small", loc="lower left")
    figure.suptitle("Searches for the least potential energy at fixed volume, 9 heights")
    drawing.save(figure, output, "design-searches.png")
    if table:
        print_table([{**{key: value for key, value in row.items() if key != "picture"},
                      "objective": f"{row['objective']:.8f}"} for row in table])


# Of the paper, seconds: its state, and the derivatives one after the other and in parallel.
PAPER = {9: (15, 135, 30), 16: (15, 240, 40)}


def paper_row(variables, ranks, name, quick):
    """Return seconds of a processor per rank, also those in which it waits for the other."""
    method, entries, _ = {**METHODS, **ENERGY}[name]
    found = gradient(f"prm/hertz-3d-{variables}.prm", {
        **({} if method == "energy" else COMPLIANCE),
        **(cells(4, "punch", "foundation") if quick else {}), **entries}, method, ranks)
    of = found.summary["gradient"]
    return {"variables": variables, "ranks": ranks, "method": name,
            "state": found.on_processor(*STATE) / ranks,
            "gradient": found.share * of["seconds"] / ranks,
            "state F-mults": found.state["f_mults"], "F-mults": of["f_mults"]}


def write_paper(output, quick):
    """Print a table only: per problem and method, on one rank and on two, beside the paper."""
    names = ("adjoint",) if quick else ("adjoint", "direct, block", "direct, recycled", "energy")
    found = {(variables, ranks, name): paper_row(variables, ranks, name, quick)
             for variables in PAPER for ranks in (1, 2) for name in names}
    write_csv(output / "design-paper.csv", list(found.values()))
    columns = ("variables", "method", "state", "derivatives", "in states", "state, parallel",
               "derivatives, parallel", "speed-up")
    table = []
    for variables, (state, serial, parallel) in PAPER.items():
        table.append(dict(zip(columns, (variables, "the paper", state, serial, serial / state, "",
                                        parallel, serial / parallel))))
        for name in names:
            one, two = (found[variables, ranks, name] for ranks in (1, 2))
            table.append(dict(zip(columns, (
                variables, name, one["state"], one["gradient"], one["gradient"] / one["state"],
                two["state"], two["gradient"], one["gradient"] / two["gradient"]))))
    print_table(table)


CHARTS = {"variables": draw_variables, "searches": draw_searches, "paper": write_paper}
