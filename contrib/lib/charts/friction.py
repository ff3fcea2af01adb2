"""The chart of friction: F-mults of a state, of the next load step and of a gradient.

A round block is pressed on another one and sheared by 0.7 times the limit of friction; the
resultant of its loads passes through the middle of the contact. Without friction, the block is
guided and only pressed."""

import drawing

from common import BLOCKS, COMPLIANCE, by, cells, curves, legend_below, numbers, panels
from runs import print_table, solve

BLOCKS_3D = "tests/scenes/two-blocks-3d.prm"
BODIES = ("upper", "lower")
PRESSURE = 20.
CURVES = ("state without friction", "gradient without friction", "state", "next load step",
          "gradient")


def mesh(dim, subdomains, per_edge):
    """Return cubes of subdomains in both bodies."""
    edge = round((subdomains / 2)**(1 / dim))
    return {**cells(edge * per_edge, *BODIES, dim=dim), "Decomposition/Subdomains": 2 * edge**dim,
            "Decomposition/Method": "grid"}


def loads(dim, shear, factor=1., body=""):
    """Return the loads of the top of the upper block, with the couple of the shear there."""
    shear, pressure = shear * factor, PRESSURE * factor
    traction, moment = ((f"{shear} -{pressure}", f"{shear}") if dim == 2 else
                        (f"{shear} 0 -{pressure}", f"0 -{shear} 0"))
    return {"Traction": f"{body}top: {traction}", "Moment": f"{body}top: {moment}"}


def load_case(name, *given):
    return {f"Load case {name}/{entry}": value
            for entry, value in loads(*given, body="upper.").items()}


def f_mults(dim, entries, friction):
    """Return the F-mults of CURVES."""
    scene = BLOCKS if dim == 2 else BLOCKS_3D
    common = {"Task": "sensitivity", "Gradient/Compare": "false", "Gradient/Method": "adjoint",
              "Accuracy/Estimate": "none", "Accept large displacements": "true",
              "Shape/Control points": "2" if dim == 2 else "2, 2",
              **COMPLIANCE, **entries}
    guided = solve(scene, common).summary
    free = {**common, "Body upper/Supports": "", "Body upper/Pressure": "",
            "Contact/Friction": "Coulomb", "Contact/Friction coefficient": friction}
    shear = 0.7 * friction * PRESSURE
    alone = solve(scene, {**free, **{f"Body upper/{entry}": value
                                     for entry, value in loads(dim, shear).items()}}).summary
    steps = solve(scene, {**free, "Task": "state", "Load cases": "first, next",
                          "Load case next/Load step": "true", **load_case("first", dim, shear),
                          **load_case("next", dim, shear, 1.02)}).summary
    return (guided["state"]["f_mults"], guided["gradient"]["f_mults"], alone["state"]["f_mults"],
            steps["work"]["f_mults"] - steps["state"]["f_mults"], alone["gradient"]["f_mults"])


# Titles: dimension, values, the mesh and the coefficient of friction for a value.
CHARTS_OF_STATES = {
    "2D: coefficient of friction": (2, [.05, .1, .2, .3, .6, 1.], lambda x: (mesh(2, 32, 8), x)),
    "2D: subdomains": (2, [8, 32, 128, 512], lambda x: (mesh(2, x, 8), .3)),
    "2D: modulus of the upper over the lower body": (
        2, [1e-4, 1e-2, 1., 1e2, 1e4],
        lambda x: ({**mesh(2, 32, 8), "Body upper/Young's modulus": 1000 * x}, .3)),
    "3D: coefficient of friction": (3, [.05, .1, .2, .3, .6, 1.], lambda x: (mesh(3, 54, 4), x)),
    "3D: subdomains": (3, [16, 54, 128], lambda x: (mesh(3, x, 4), .3)),
    # 20k, 56k, 94k and 197k unknowns
    "3D: cells per edge of a block": (3, [14, 20, 24, 31], lambda x: (
        {**cells(x, *BODIES), "Decomposition/Subdomains": "auto"}, .3))}
SHOWN = "2D: subdomains", "3D: cells per edge of a block"  # in the picture
QUICK = {"2D: coefficient of friction": [.3], "2D: subdomains": [8],
         "3D: cells per edge of a block": [4]}


def measure(quick):
    rows = []
    for chart, (dim, values, entries) in CHARTS_OF_STATES.items():
        for x in QUICK.get(chart, []) if quick else values:
            counts = f_mults(dim, *entries(x))
            rows += [{"chart": chart, "x": x, "curve": name, "F-mults": count}
                     for name, count in zip(CURVES, counts)]
    return rows


def draw(output, quick):
    rows = numbers(output / "friction.csv", lambda: measure(quick))
    charts = by(rows, "chart")
    print_table([{"chart": chart, "curve": name,
                  **{key: " / ".join(f"{row[key]:g}" for row in group)
                     for key in ("x", "F-mults")}}
                 for chart, of_chart in charts.items()
                 for name, group in by(of_chart, "curve").items()])
    figure, axes = panels(2)
    for axis, chart in zip(axes, SHOWN):
        curves(axis, charts[chart], "curve", "x", "F-mults", CURVES)
        axis.set_xlabel(chart)
        axis.set_ylabel("F-mults")
        axis.set_yscale("linear")
        places = sorted({row["x"] for row in charts[chart]})
        axis.set_xticks(places, [f"{x:g}" for x in places])
        axis.minorticks_off()
        axis.set_ylim(0)
    figure.suptitle("F-mults of states with Coulomb friction and of their gradients")
    legend_below(figure, axes, 3, .12)
    drawing.save(figure, output, "friction.png")


CHARTS = {"friction": draw}
