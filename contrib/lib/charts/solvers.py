"""The chart of solvers: F-mults and seconds of a state.

The scene is a round block on another in 2D, each of m x m square subdomains of r x r cells."""

import drawing

from common import BLOCKS, by, cells, curves, legend_below, numbers, panels, tolerance
from runs import print_table, solve

ACTIVE, SMALSE = {}, {"Solver/Method": "SMALSE-M"}
LUMPED, NONE = ({"Solver/Preconditioner": name} for name in ("lumped", "none"))
MULTIPLICITY = {"Solver/Scaling": "multiplicity"}
PRECONDITIONERS = {"active set": ACTIVE, "lumped": LUMPED, "no preconditioner": NONE,
                   "SMALSE-M": SMALSE}
SCALINGS = {"active set": ACTIVE, "scaled by multiplicity": MULTIPLICITY,
            "SMALSE-M": SMALSE}
BODIES = ("upper", "lower")


def mesh(m, r):
    return {**cells(m * r, *BODIES, dim=2), "Decomposition/Subdomains": 2 * m**2,
            "Decomposition/Method": "grid"}


def of_all(entry, value):
    return {f"Body {body}/{entry}": value for body in BODIES}


def stretched(aspect):
    """Return blocks so many times their height, in as many cells along both edges."""
    return {**of_all("Box size", f"{aspect}, 1"),
            "Body upper/Curved faces": f"bottom: -(x/{aspect})^2/8", **mesh(4, 8)}


def graded(ratio):
    """Return blocks with small cells at the contact, at its left end."""
    return {**mesh(4, 8), "Body upper/Box grading": f"{ratio}, {ratio}",
            "Body lower/Box grading": f"{ratio}, {1 / ratio}"}


# Titles: values, the entries that make them, and solvers.
CHARTS_OF_STATES = {
    "tolerance": ([10.**-k for k in range(1, 13)],
                  lambda x: {**mesh(4, 8), **tolerance(x)}, PRECONDITIONERS),
    "H/h": ([4, 8, 16, 32], lambda x: mesh(4, x), PRECONDITIONERS),
    "subdomains": ([8, 32, 128, 512, 2048], lambda x: mesh(int((x / 2)**.5), 8),
                   PRECONDITIONERS),
    "modulus of the upper over the lower body": (
        [10.**k for k in range(-6, 7, 2)],
        lambda x: {**mesh(4, 8), "Body upper/Young's modulus": 1000 * x}, SCALINGS),
    "0.5 - Poisson's ratio": (
        [.5, .3, .1, .03, .01, .001, .0001],
        lambda x: {**mesh(4, 8), **of_all("Poisson's ratio", .5 - x)},
        {**SCALINGS, "active set, B-bar": of_all("Formulation", "B-bar")}),
    "aspect of subdomains": ([1, 2, 4, 8, 16, 32], stretched, SCALINGS),
    "largest over smallest cell": ([1, 10, 100, 1000], graded, SCALINGS)}
# The charts in the picture with their axes.
SHOWN = {"subdomains": "subdomains of 8 x 8 cells", "H/h": "cells along the edge of a subdomain"}
QUICK = {"tolerance": [1e-12, 1e-6], "H/h": [8], "subdomains": [32]}


def cold(entries):
    """Return F-mults of one state, and the seconds that depend on the solver."""
    found = solve(BLOCKS, {"Task": "state", "Accuracy/Estimate": "none", **entries}).summary
    return found["state"]["f_mults"], sum(
        found["times"][part] for part in ("assembly", "factorization", "soft_modes", "solve"))


def warm(entries, first):
    """Return the means of the states of a search after the first one, with its F-mults."""
    found = solve(BLOCKS, {"Task": "optimize", "Accuracy/Estimate": "none",
                           "Optimization/Maximum evaluations": 8, **entries}).summary
    evaluations = found["optimization"]["evaluations"]
    return ((found["work"]["f_mults"] - first) / (evaluations - 1),
            found["times"]["solve"] / evaluations)


def measure(quick):
    """Return the rows of the file."""
    rows = []

    def add(chart, x, solver, f_mults, seconds):
        rows.append({"chart": chart, "x": x, "solver": solver, "F-mults": f_mults,
                     "seconds": seconds})
    for chart, (values, entries, solvers) in CHARTS_OF_STATES.items():
        for x in QUICK.get(chart, []) if quick else values:
            for solver, chosen in solvers.items():
                given = {**entries(x), **chosen}
                add(chart, x, solver, *cold(given))
                if chart == "tolerance" and solver in ("active set", "SMALSE-M"):
                    add(chart, x, f"{solver}, warm", *warm(given, rows[-1]["F-mults"]))
    return rows


def draw(output, quick):
    rows = numbers(output / "solvers.csv", lambda: measure(quick))
    charts = by(rows, "chart")
    print_table([{"chart": chart, "solver": solver,
                  **{key: " / ".join(f"{row[key]:g}" for row in group)
                     for key in ("x", "F-mults")}}
                 for chart, of_chart in charts.items()
                 for solver, group in by(of_chart, "solver").items()])
    figure, axes = panels(2)
    order = sorted({row["solver"] for row in rows})
    for axis, (chart, label) in zip(axes, SHOWN.items()):
        curves(axis, charts[chart], "solver", "x", "F-mults", order)
        values = sorted(by(charts[chart], "x"))
        axis.set_xticks(values, [f"{x:g}" for x in values])
        axis.set_yticks((10, 20, 40, 80), ("10", "20", "40", "80"))
        axis.minorticks_off()
        axis.set_xlabel(label)
        axis.set_ylabel("F-mults")
    figure.suptitle("F-mults of a state of two blocks in 2D")
    legend_below(figure, axes, 4, .08)
    drawing.save(figure, output, "solvers.png")


CHARTS = {"solvers": draw}
