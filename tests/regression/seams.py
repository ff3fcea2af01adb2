#!/usr/bin/env python3
"""Contact faces that a mesh file cuts into several boundaries: seams.py SNUG [all] [RANKS].

Two blocks, or a block and an obstacle, are pressed on each other by 100. The faces in contact are
cut into boundaries in many ways; each cut scene has the rows, forces, areas and pressures of the
uncut one, a pressure of 100 at each node where the method passes the patch test, and the force on
each pair is 100 times its area. A curved punch is cut through the peak of its pressure. A block in
a corner touches two walls. 'all' runs every combination instead of a sample of them."""

import csv
import itertools
import json
import pathlib
import subprocess
import sys
import tempfile

PRESSURE = 100.
QUAD = {"bottom": (1, (0, 1)), "right": (2, (1, 2)), "top": (3, (2, 3)), "left": (4, (3, 0))}
HEX = {"bottom": 1, "top": 2, "front": 3, "right": 4, "back": 5, "left": 6}


class Block:
    """A box of equal cells as an Abaqus file; faces in contact are cut by name(centre)."""

    def __init__(self, lower, upper, cells, lift=lambda x: 0.):
        self.lower, self.upper, self.cells, self.lift = lower, upper, cells, lift
        self.dim = len(cells)

    def text(self, cut_face, name):
        dim, n = self.dim, self.cells
        steps = [range(c + 1) for c in reversed(n)]
        number, lines = {}, ["*Node"]
        for index in itertools.product(*steps):
            place = tuple(reversed(index))
            x = [a + (b - a) * i / c for a, b, i, c in zip(self.lower, self.upper, place, n)]
            x[-1] += self.lift(x[:-1]) * (1. - place[-1] / n[-1])
            number[place] = len(number) + 1
            lines.append(f"{number[place]}, " + ", ".join(repr(v) for v in x))
        lines.append("*Element, type=" + ("CPE4" if dim == 2 else "C3D8"))
        corners = [(0, 0), (1, 0), (1, 1), (0, 1)]
        if dim == 3:
            corners = [(*c, 0) for c in corners] + [(*c, 1) for c in corners]
        surfaces = {}
        faces = {side: QUAD[side][0] for side in QUAD} if dim == 2 else HEX
        ends = {"left": (0, 0), "right": (0, 1), "bottom": (dim - 1, 0), "top": (dim - 1, 1)}
        if dim == 3:
            ends.update(front=(1, 0), back=(1, 1))
        element = 0
        for index in itertools.product(*[range(c) for c in reversed(n)]):
            place = tuple(reversed(index))
            element += 1
            lines.append(f"{element}, " + ", ".join(
                str(number[tuple(p + c for p, c in zip(place, corner))]) for corner in corners))
            for side, (axis, end) in ends.items():
                if place[axis] != (n[axis] - 1) * end:
                    continue
                centre = [a + (b - a) * (i + 0.5) / c
                          for a, b, i, c in zip(self.lower, self.upper, place, n)]
                of = name(centre) if side == cut_face else side
                surfaces.setdefault(of, []).append((element, faces[side]))
        for of, members in surfaces.items():
            lines.append(f"*Surface, type=ELEMENT, name={of}")
            lines += [f"{e}, S{f}" for e, f in members]
        return "\n".join(lines) + "\n", [of for of in surfaces if of not in ends]


def whole(side):
    return lambda x: side


def halves(side, at):
    return lambda x: side + ("a" if x[0] < at else "b")


def thirds(side, at):
    """Three parts that meet in a point."""
    return lambda x: side + ("a" if x[1] > at else "b" if x[0] < at else "c")


def run(snug, directory, scene, ranks=1):
    folder = pathlib.Path(directory)
    (folder / "scene.prm").write_text(scene)
    command = ["mpirun", "-np", str(ranks)] if ranks > 1 else []
    done = subprocess.run([*command, snug, str(folder / "scene.prm"), "--output",
                           str(folder / "out")], capture_output=True, text=True, timeout=300,
                          check=False)
    if done.returncode != 0:
        raise RuntimeError(f"status {done.returncode}: {done.stderr.strip()[-300:]}")
    with open(folder / "out" / "contact-0000.csv", encoding="utf-8") as file:
        rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]
    summary = json.loads((folder / "out" / "summary.json").read_text())
    return summary, sorted(rows, key=lambda row: [round(row[c], 6) for c in "xyz" if c in row])


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
  set Mesh file = punch.inp
  set Young's modulus = 1000
  set Supports = {rollers}
  set Pressure = top: {PRESSURE}
end
"""
    if master == "body":
        text += f"""
subsection Body foundation
  set Mesh = file
  set Mesh file = foundation.inp
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
    for slave, master in ((whole("s"), whole("m")), (case["slave"], case["master_cut"])):
        with tempfile.TemporaryDirectory() as directory:
            text, slaves = punch.text("bottom", slave)
            (pathlib.Path(directory) / "punch.inp").write_text(text)
            masters = []
            if case["master"] == "body":
                text, masters = below.text("top", master)
                (pathlib.Path(directory) / "foundation.inp").write_text(text)
            if case["master"] == "obstacle":
                pairs = [("punch." + s, "floor") for s in slaves]
            else:
                pairs = names_of(case, slaves, masters)
            scene = scene_of(case, ", ".join(f"{s}: {m}" for s, m in pairs), case.get("more", ""))
            results.append(run(snug, directory, scene, ranks))
    (uncut, uncut_rows), (cut, rows) = results
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


def cases(every):
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
    if not every:
        result = result[::7]
    # through the peak of a crowned punch
    for dim, method, master in ((2, "nodal", "obstacle"), (2, "mortar", "body"), (3, "nodal", "body"),
                                (3, "mortar", "body")):
        lift = (lambda x: 0.1 * sum((v - 0.5) ** 2 for v in x))
        result.append({
            "dim": dim, "model": "plane strain" if dim == 2 else "solid", "degree": 1,
            "method": method, "master": master, "slave": halves("s", 0.5),
            "master_cut": halves("m", 0.5), "areas": [], "cells": 8, "below": 8,
            "named": "pairs", "patch": False, "lift": lift,
            "name": f"crowned {dim}D {method} {master}"})
    return result


def main(snug, *more):
    every = "all" in more
    ranks = max([int(m) for m in more if m.isdigit()] + [1])
    wrong = 0
    for case in cases(every):
        try:
            errors = check_case(snug, case, ranks)
        except RuntimeError as error:
            errors = [str(error)]
        print(case["name"], "right" if not errors else "wrong: " + "; ".join(errors[:3]), flush=True)
        wrong += bool(errors)
    print(f"{wrong} wrong")
    return wrong > 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
