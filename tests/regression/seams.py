#!/usr/bin/env python3
"""Contact faces that a mesh file cuts into several boundaries: seams.py SNUG [RANKS].

Two blocks, or a block and an obstacle, are pressed on each other by 100. The faces in contact are
cut into boundaries in many ways; each cut scene, whether the entries of its pairs are equal or not,
has the rows, forces, areas and pressures of the uncut one, a pressure of 100 at each node where the method passes the patch test, and the force on
each pair is 100 times its area. A curved punch is cut through the peak of its pressure. A block in
a corner touches two walls."""

import itertools
import pathlib
import sys
import tempfile

from corner_blocks import check_corner
from cut_blocks import Block, halves, on_face, run, sphere, thirds, whole
from runs import sample

PRESSURE = 100.
def scene_of(case, pairs, more=""):
    """The bodies of a case, their meshes beside it."""
    dim, master = case["dim"], case["master"]
    rollers = "left: x" + (", front: y" if dim == 3 else "")
    if case["model"] == "axisymmetric":
        rollers = ""
    axis = "xyz"[dim - 1]
    text = f"""
set Task = state
set Dimension = {dim}
set Element degree = {case["degree"]}
set Model = {case["model"]}
set Bodies = punch{", foundation" if master == "body" else ""}
set Obstacles = {"floor" if master == "obstacle" else ""}
subsection Body punch
  set Mesh = file
  set File = punch.inp
  set Young's modulus = 1000
  set Supports = {rollers}
  set Pressure = top: {PRESSURE}
end
"""
    if master == "body":
        text += f"""
subsection Body foundation
  set Mesh = file
  set File = foundation.inp
  set Young's modulus = 1000
  set Supports = {rollers + ", " if rollers else ""}bottom: {axis}
end
"""
    else:
        text += f"""
subsection Obstacle floor
  set Point = {"0, 1" if dim == 2 else "0, 0, 1"}
end
"""
    return text + f"""
subsection Contact
  set Pairs = {pairs}
  set Slave = first
  set Method = {case["method"]}
end
subsection Solver
  set Relative tolerance = 1e-11
end
subsection Accuracy
  set Estimate = energy
end
{more}"""


def names_of(case, slaves, masters):
    """Pairs as the scene names them."""
    if case["master"] == "obstacle":
        return [(s, "floor") for s in slaves]
    pairs = [("punch." + s, "foundation." + m) for s in slaves for m in masters]
    if case["named"] == "list":
        return [(" + ".join(sorted({s for s, m in pairs})), " + ".join(sorted({m for s, m in pairs})))]
    return pairs


def check_case(snug, case, ranks):
    """The errors of a case, empty: none."""
    dim, n = case["dim"], case["cells"]
    flat = [0.] * (dim - 1)
    punch = Block([*flat, 1.], [1.] * (dim - 1) + [2.], [n] * (dim - 1) + [2],
                  case.get("lift", lambda x: 0.))
    below = Block([0.] * dim, [1.] * dim, [case["below"]] * (dim - 1) + [2])
    results = []
    for slave, master, unlike in ((whole("s"), whole("m"), False),
                                  (case["slave"], case["master_cut"], False),
                                  (case["slave"], case["master_cut"], True)):
        with tempfile.TemporaryDirectory() as directory:
            text, slaves = punch.text(on_face("bottom", slave))
            (pathlib.Path(directory) / "punch.inp").write_text(text)
            masters = []
            if case["master"] == "body":
                text, masters = below.text(on_face("top", master))
                (pathlib.Path(directory) / "foundation.inp").write_text(text)
            if case["master"] == "obstacle":
                pairs = [("punch." + s, "floor") for s in slaves]
            else:
                pairs = names_of(case, slaves, masters)
            scene = scene_of(case, ", ".join(f"{s}: {m}" for s, m in pairs),
                             case.get("more", "") + (unlike_entries(pairs, case) if unlike else ""))
            results.append(run(snug, directory, scene, ranks))
    return compare_cut(case, results[0], results[1]) + [
        "unlike entries: " + error for error in compare_cut(case, results[0], results[2])]


def unlike_entries(pairs, case):
    """Sections of every second pair with entries that differ from those of the others, but do not
    change the answer by more than its rounding: blocks of one material expand alike, so that
    friction has no forces where their pressure is even."""
    text = ""
    for slave, master in pairs[1::2]:
        text += f"""
subsection Pair {slave}: {master}
  set Gap = 1e-14
  set Search distance = 0.7
  set Interference = true
"""
        if case["patch"] and case["master"] == "body":
            text += "  set Friction = Coulomb\n  set Friction coefficient = 0.3\n"
        if case["method"] == "mortar":
            text += "  set Method = nodal\n"
        text += "end\n"
    return text


def compare_cut(case, uncut_result, cut_result):
    """The errors of a cut scene by the uncut one."""
    dim = case["dim"]
    (uncut, uncut_rows), (cut, rows) = uncut_result, cut_result
    errors = []

    def expect(what, value, wanted, tolerance=1e-9):
        if not abs(value - wanted) <= tolerance * max(1., abs(wanted)):
            errors.append(f"{what}: {value!r} instead of {wanted!r}")

    expect("number of rows", len(rows), len(uncut_rows), 0.)
    for row, other in zip(rows, uncut_rows):
        for key in ("pressure", "force", "area", "gap"):
            expect(f"{key} at {row['x']}", row[key], other[key])
        if case["patch"]:
            expect(f"pressure at {row['x']}", row["pressure"], PRESSURE)
    for key in ("contact_area", "max_pressure", "energy", "active_contacts"):
        expect(key, cut["state"][key], uncut["state"][key])
    for p, key in itertools.product(range(dim), ("contact_force", "balance")):
        expect(f"{key} {p}", cut["state"][key][p], uncut["state"][key][p])
    of_pairs = cut["state"]["pairs"]
    expect("sum of forces", sum(p["force"][-1] for p in of_pairs), uncut["state"]["contact_force"][-1])
    expect("sum of moments", sum(p["moment"][0] for p in of_pairs if p["centre"][-1] >= 0.),
           sum(p["moment"][0] for p in of_pairs), 0.)
    if case["patch"]:
        for pair in of_pairs:
            expect(f"force of {pair['name']}", abs(pair["force"][-1]),
                   PRESSURE * pair["contact_area"])
        if case["model"] != "axisymmetric":
            wanted = case["areas"]
            got = sorted(pair["contact_area"] for pair in of_pairs)
            for a, b in zip(got, sorted(wanted) if len(of_pairs) > 1 else [1.]):
                expect("area of a pair", a, b)
        expect("estimated error", cut["state"]["accuracy"]["relative"], 0., 1e-6)
    return errors


def cases():
    """Return all combinations, the crowned punch first."""
    result = []
    for dim, model in ((2, "plane strain"), (2, "axisymmetric"), (3, "solid")):
        for degree, method, master, cut in itertools.product(
                (1, 2), ("nodal", "mortar"), ("obstacle", "body"),
                ("slave", "master", "both", "apart", "list", "thirds")):
            for below in (4, 6):
                if master == "obstacle" and (cut in ("master", "both", "apart", "list")
                                             or method == "mortar" or below != 4):
                    continue
                if (cut == "thirds" and dim == 2) or (dim == 3 and degree == 2 and below == 6):
                    continue
                at, at_master = 0.5, 0.5
                if cut == "apart":
                    at, at_master = (0.25, 0.5)
                slave, of_master = whole("s"), whole("m")
                areas = [1.]
                if cut in ("slave", "both", "apart", "list"):
                    slave = halves("s", at)
                    areas = [at, 1. - at]
                if cut in ("master", "both", "apart", "list"):
                    of_master = halves("m", at_master)
                    areas = [at_master, 1. - at_master]
                if cut in ("both", "apart", "list"):
                    areas = [min(at, at_master), max(0., at_master - at), 0., 1. - max(at, at_master)]
                if cut == "thirds":
                    slave = thirds("s", 0.5)
                    areas = [0.25, 0.25, 0.5]
                    if master == "body":
                        of_master = halves("m", 0.5)
                        areas = [0.25, 0., 0., 0.25, 0.25, 0.25]
                result.append({
                    "dim": dim, "model": model, "degree": degree, "method": method,
                    "master": master, "slave": slave, "master_cut": of_master, "areas": areas,
                    "cells": 4, "below": below, "named": "list" if cut == "list" else "pairs",
                    "patch": method == "mortar" or below == 4,
                    "name": f"{model} degree {degree} {method} {master} {below}, cut: {cut}"})
    # through the peak of a crowned punch
    crowned = []
    for dim, method, master in ((2, "nodal", "obstacle"), (2, "mortar", "body"), (3, "nodal", "body"),
                                (3, "mortar", "body")):
        crowned.append({
            "dim": dim, "model": "plane strain" if dim == 2 else "solid", "degree": 1,
            "method": method, "master": master, "slave": halves("s", 0.5),
            "master_cut": halves("m", 0.5), "areas": [], "cells": 8, "below": 8,
            "named": "pairs", "patch": False, "lift": sphere(4., 0.5),
            "name": f"crowned {dim}D {method} {master}"})
    return crowned + result


GRADIENT = """
set Task = sensitivity
set Dimension = {dim}
set Bodies = punch, foundation
set Responses = value
subsection Body punch
  set Mesh = file
  set File = punch.inp
  set Young's modulus = 1000
  set Supports = left: x, right: x{front}
  set Pressure = top: 20
end
subsection Body foundation
  set Box cells = {cells}
  set Young's modulus = 1000
  set Supports = bottom: {all}
end
subsection Shape
  set Basis = Bezier patch
  set Face = foundation.top
  set Control points = {points}
  set Direction = {direction}
  set Bounds = -0.1, 0.1
end
subsection Contact
  set Pairs = {pairs}
  set Slave = first
  set Method = {method}
end
subsection Solver
  set Relative tolerance = 1e-12
end
subsection Response value
  set Quantity = {quantity}
  set Pair = {pair}
end
subsection Optimization
  set Objective = value
end
subsection Gradient
  set Method = adjoint
  set Compare = {compare}
end
"""


def gradients(snug, slave, quantity, pair, case, compare=False):
    """Those of one response by the adjoint method, or all: {method: values}."""
    dim, method, ranks = case
    punch = Block([0.] * (dim - 1) + [1.], [1.] * (dim - 1) + [2.], [8, *[4] * (dim - 2), 2],
                  lift=sphere(16., 0.45))
    with tempfile.TemporaryDirectory() as directory:
        text, slaves = punch.text(on_face("bottom", slave))
        (pathlib.Path(directory) / "punch.inp").write_text(text)
        summary, _ = run(snug, directory, GRADIENT.format(
            dim=dim, method=method, quantity=quantity, pair=pair, all="xyz"[:dim],
            cells=", ".join(["7", *["5"] * (dim - 2), "3"]),
            front=", front: y, back: y" if dim == 3 else "",
            compare=str(compare).lower(), points=", ".join(["3"] * (dim - 1)),
            direction=", ".join(["0"] * (dim - 1) + ["1"]),
            pairs=", ".join(f"punch.{s}: foundation.top" for s in slaves)), ranks)
    return {of["method"]: of["values"] for of in summary["gradient"]["methods"]}


def check_gradient(snug, dim, method, ranks):
    """Derivatives with a punch that is cut through the peak of its pressure: those with an uncut
    one, and of the force on one part those by finite differences."""
    errors, case = [], (dim, method, ranks)

    def compare(what, values, others, tolerance):
        scale = max(map(abs, others))
        difference = max(abs(a - b) for a, b in zip(values, others))
        if not difference <= tolerance * scale:
            errors.append(f"{what} {difference / scale:.1e} off")

    for quantity in ("potential energy", "pressure norm", "contact area", "peak pressure"):
        uncut = gradients(snug, whole("s"), quantity, "", case)
        cut = gradients(snug, halves("s", 0.5), quantity, "", case)
        compare(quantity, cut["adjoint"], uncut["adjoint"], 1e-8)
    for quantity in ("contact force", "pressure norm"):
        half = gradients(snug, halves("s", 0.5), quantity, "punch.sa: foundation.top", case, True)
        compare(f"{quantity} of a half, adjoint", half["adjoint"], half["direct"], 1e-8)
        compare(f"{quantity} of a half", half["adjoint"], half["finite differences"], 1e-4)
    return errors


TARGET = """
subsection Accuracy
  set Target = peak pressure: 2 %, contact area: 3 %, contact force: 0.1
end
"""


def check_target(snug, master, ranks):
    """A curved punch, cut through the peak of its pressure, on the mesh that targets ask for: the
    meshes and the values are those of the uncut one."""
    punch = Block([0., 1.], [1., 2.], [8, 4], lift=sphere(2., 0.5))
    below = Block([-0.5, 0.], [1.5, 1.], [16, 8])
    case = {"dim": 2, "degree": 1, "method": "mortar", "model": "plane strain", "master": master,
            "named": "pairs"}
    runs = []
    for slave, of_master in ((whole("s"), whole("m")), (halves("s", 0.5), halves("m", 0.5))):
        with tempfile.TemporaryDirectory() as directory:
            text, slaves = punch.text(on_face("bottom", slave))
            (pathlib.Path(directory) / "punch.inp").write_text(text)
            text, masters = below.text(on_face("top", of_master))
            (pathlib.Path(directory) / "foundation.inp").write_text(text)
            pairs = names_of(case, slaves, masters)
            if master == "obstacle":
                pairs = [("punch." + s, "floor") for s in slaves]
            scene = scene_of(case, ", ".join(f"{s}: {m}" for s, m in pairs), TARGET).replace(
                f"top: {PRESSURE}", "top: 20")
            runs.append(run(snug, directory, scene, ranks)[0]["accuracy"]["meshes"])
    uncut, cut = runs
    errors = []
    sizes = [[mesh["dofs"] for mesh in meshes] for meshes in runs]
    if sizes[0] != sizes[1]:
        errors.append(f"meshes of {sizes[1]} instead of {sizes[0]} unknowns")
    for name, wanted in uncut[-1]["responses"].items():
        value = cut[-1]["responses"][name]["value"]
        if not abs(value - wanted["value"]) <= 1e-5 * abs(wanted["value"]):
            errors.append(f"{name}: {value} instead of {wanted['value']}")
    return errors


def main(snug, ranks=1):
    ranks = int(ranks)
    checks = [(case["name"], lambda case=case: check_case(snug, case, ranks))
              for case in sample(cases())]
    corners = [corner for corner in itertools.product((2, 3), (1, 2), ("nodal", "mortar"),
                                                      ("obstacle", "body"))
               if corner[2:] != ("mortar", "obstacle")]
    for corner in sample(corners[::-1]):
        checks.append(("corner " + " ".join(map(str, corner)),
                       lambda corner=corner: check_corner(snug, *corner, ranks)))
    for master in sample(("body", "obstacle")):
        checks.append((f"target {master}",
                       lambda master=master: check_target(snug, master, ranks)))
    for dim, method in sample(((2, "nodal"), (2, "mortar"), (3, "mortar"))):
        checks.append((f"gradient {dim}D {method}",
                       lambda dim=dim, method=method: check_gradient(snug, dim, method, ranks)))
    wrong = 0
    for name, check in checks:
        try:
            errors = check()
        except RuntimeError as error:
            errors = [str(error)]
        print(name, "right" if not errors else "wrong: " + "; ".join(errors[:3]), flush=True)
        wrong += bool(errors)
    print(f"{wrong} wrong")
    return wrong > 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
