"""Contact beside a linear solve: this program and others on two scenes of Hertz.

(a) is prm/hertz-2d.prm with the load of a top that moves down by 0.004, on n x n cells per
body, half of those along x on 0.16, growing twelvefold downwards and upwards; (b) is
prm/point-contact.prm. The linear problem is one body of both blocks on the same mesh."""

import drawing

import known_answers
from common import BEAM, by, cells, curves, legend_below, numbers, panels
from runs import print_table, solve

# program: scene, unknowns, error of p0 in percent, seconds, those of its own linear solve;
# all on the same meshes, on one core of one machine
OTHERS = [
    ("GetFEM, nodal", "a", 66564, .18, 3.3, .8),
    ("Kratos, mortar, tuned search", "a", 66564, .52, 6.1, 1.9),
    ("Kratos, mortar, default search", "a", 66564, 580., 4.4, 1.9),
    ("CalculiX, node to face, K = 50 E", "a", 66564, 2.9, 14.8, 2.7),
    ("CalculiX, face to face, K = 1000 E", "a", 66564, .04, 21.8, 2.7),
    ("GetFEM, nodal", "b", 48000, .01, 12.2, 3.05),
    ("GetFEM, nodal", "b", 196608, .03, 109., 22.),
    ("Kratos, mortar, tuned search", "b", 48000, 1.03, 13.4, 1.6),
    ("Kratos, mortar, tuned search", "b", 196608, 1.06, 104., 7.8),
    ("CalculiX, node to face, K = 1000 E", "b", 48000, 1.04, 44., 5.2)]
SCENES = {"a": (2, .16, 12, (32, 64, 128)), "b": (3, .3, 8, (11, 19, 31))}


def line(n):
    entries = {**cells(n, "cylinder", "plane", dim=2), "Body cylinder/Pressure": "",
               "Body cylinder/Displacement": "top: y = -0.004",
               "Body cylinder/Box grading": "1, 12", "Body plane/Box grading": f"1, {1 / 12}"}
    for body in ("cylinder", "plane"):
        entries.update({f"Body {body}/Refine where": "", f"Body {body}/Local refinements": 0,
                        f"Body {body}/Box fine length": "0.16, 0"})
    return entries


def bonded(scene, n):
    """Return the entries of the two blocks as one body, whose cells grow from its middle."""
    dim, fine, growth, _ = SCENES[scene]
    axis, flat = "xyz"[dim - 1], dim - 1
    rate = growth**(n / (n - 1))
    return {
        "Task": "state", "Dimension": dim, "Element degree": 1, "Shape/Basis": "none",
        "Body beam/Box size": ", ".join(["1"] * flat + ["2"]),
        "Body beam/Box cells": ", ".join([str(n)] * flat + [str(2 * n)]),
        "Body beam/Box fine length": ", ".join([str(fine)] * flat + ["0"]),
        "Body beam/Warp": "; ".join(["0"] * flat + [
            f"({axis} > 1 ? 1 : -1)*(({rate}^abs({axis} - 1) - 1)/{rate - 1} - abs({axis} - 1))"]),
        "Body beam/Traction": "", "Body beam/Displacement": f"top: {axis} = -0.004",
        "Body beam/Supports": "left: x, " + ("front: y, " if dim == 3 else "") +
                              f"bottom: {axis}"}


def contact(scene, n):
    if scene == "a":
        return "prm/hertz-2d.prm", line(n), known_answers.line_contact
    return "prm/point-contact.prm", cells(n, "upper", "lower"), known_answers.point_contact


def row(scene, program, unknowns, percent, seconds, linear):
    return {"scene": scene, "program": program, "unknowns": unknowns,
            "error of p0 [%]": percent, "seconds": seconds, "linear": linear,
            "ratio": seconds / linear}


def measure(quick):
    """Return the rows of the file."""
    rows = [row(scene, program, *numbers) for program, scene, *numbers in OTHERS]
    state = {"Accuracy/Estimate": "none"}
    for scene, (_, _, _, sizes) in SCENES.items():
        for n in (8,) if quick else sizes:
            file, entries, measured = contact(scene, n)
            found = solve(file, {**entries, **state})
            (_, p0, exact), _ = measured(found, None)
            linear = solve(BEAM, {**bonded(scene, n), **state}).on_processor("total")
            rows.append(row(scene, "Snug", found.summary["mesh"]["dofs"],
                            100 * abs(p0 / exact - 1), found.on_processor("total"), linear))
    return rows


def draw(output, quick):
    rows = numbers(output / "precision-peers.csv", lambda: measure(quick))
    order = sorted(by(rows, "program"), key=lambda name: (name != "Snug", name))
    figure, axes = panels(2, 5.)
    for axis, (scene, group) in zip(axes, by(rows, "scene").items()):
        curves(axis, group, "program", "ratio", "error of p0 [%]", order)
        for one in group:
            axis.annotate(f"{one['unknowns'] / 1000:.0f}k", (one["ratio"], one["error of p0 [%]"]),
                          fontsize="x-small", textcoords="offset points",
                          xytext=(4, -10 if "CalculiX" in one["program"] else 4))
        axis.set_title({"a": "(a) line contact", "b": "(b) point contact in 3D"}[scene])
        axis.set_xlabel("seconds of the contact problem over those of a linear one")
        axis.set_ylabel("error of the largest pressure [%]")
        axis.set_xticks((1, 2, 3, 5, 10), ("1", "2", "3", "5", "10"))
        axis.minorticks_off()
        axis.set_xlim(.6, 18.)
    legend_below(figure, axes, 3, .13)
    drawing.save(figure, output, "precision-peers.png")
    print_table(rows)
