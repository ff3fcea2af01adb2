"""F-mults and seconds of a state: what the solvers' charts measure.

A round block on another in 2D, two-blocks-2d, each of m x m square subdomains of r x r
cells; rows are {"chart", "x", "solver", "F-mults", "seconds"}."""

from runs import run
from scenes import BLOCKS, cells, tolerance

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
    """Blocks so many times their height, in as many cells along both edges."""
    return {**of_all("Box size", f"{aspect}, 1"),
            "Body upper/Curved faces": f"bottom: -(x/{aspect})^2/8", **mesh(4, 8)}


def graded(ratio):
    """Small cells at the contact, at its left end."""
    return {**mesh(4, 8), "Body upper/Box grading": f"{ratio}, {ratio}",
            "Body lower/Box grading": f"{ratio}, {1 / ratio}"}


# Titles: values, the entries that make them, and solvers.
CHARTS = {
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
QUICK = {"tolerance": [1e-12, 1e-6], "H/h": [2, 16], "subdomains": [8, 32]}


def row(chart, x, solver, f_mults, seconds):
    return {"chart": chart, "x": x, "solver": solver, "F-mults": f_mults, "seconds": seconds}


def cold(chart, x, solver, entries):
    """Of one state; parts of the run that do not depend on the solver do not count."""
    found = run(BLOCKS, {"Task": "state", "Accuracy/Estimate": "none", **entries})
    return row(chart, x, solver, found["state"]["f_mults"],
               sum(found["times"][part]
                   for part in ("assembly", "factorization", "soft_modes", "solve")))


def warm(x, solver, entries, start):
    """The mean of the states of a search after the first one, which start is as well."""
    found = run(BLOCKS, {"Task": "optimize", "Accuracy/Estimate": "none",
                         "Optimization/Maximum evaluations": 8, **entries})
    after = found["optimization"]["evaluations"] - 1
    return row("tolerance", x, f"{solver}, warm",
               (found["work"]["f_mults"] - start["F-mults"]) / after,
               found["times"]["solve"] / (after + 1))


def measure(quick):
    rows = []
    for chart, (values, entries, solvers) in CHARTS.items():
        for x in QUICK.get(chart, []) if quick else values:
            for solver, chosen in solvers.items():
                rows.append(cold(chart, x, solver, {**entries(x), **chosen}))
                if chart == "tolerance" and solver in ("active set", "SMALSE-M"):
                    rows.append(warm(x, solver, {**entries(x), **chosen}, rows[-1]))
    return rows
