"""Blocks as Abaqus files whose faces are cut into boundaries, and runs of scenes with them."""

import csv
import itertools
import json
import math
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "contrib/lib"))

from runs import execute, execute_in_common, parallel  # noqa: E402

SIDES = {2: {"bottom": 1, "right": 2, "top": 3, "left": 4},
         3: {"bottom": 1, "top": 2, "front": 3, "right": 4, "back": 5, "left": 6}}


class Block:
    """Equal cells of a box as an Abaqus file, those that keep(centre) names. Boundary faces are
    called by their sides, those of cut_face by name(centre)."""

    def __init__(self, lower, upper, cells, lift=lambda x: 0., keep=lambda x: True):
        self.lower, self.upper, self.cells = lower, upper, cells
        self.lift, self.keep = lift, keep
        self.dim = len(cells)

    def point(self, place):
        return [a + (b - a) * i / c
                for a, b, i, c in zip(self.lower, self.upper, place, self.cells)]

    def has(self, place):
        return all(0 <= i < n for i, n in zip(place, self.cells)) and \
            self.keep(self.point([i + 0.5 for i in place]))

    def text(self, name):
        """The file and the names of the faces that are no sides of the box: name(side, centre)."""
        dim = self.dim
        number, lines = {}, ["*Node"]
        for index in itertools.product(*[range(c + 1) for c in reversed(self.cells)]):
            place = tuple(reversed(index))
            number[place] = len(number) + 1
            x = self.point(place)
            x[-1] += self.lift(x[:-1]) * (1. - place[-1] / self.cells[-1])
            lines.append(f"{number[place]}, " + ", ".join(repr(v) for v in x))
        lines.append("*Element, type=" + ("CPE4" if dim == 2 else "C3D8"))
        corners = [(0, 0), (1, 0), (1, 1), (0, 1)]
        if dim == 3:
            corners = [(*c, 0) for c in corners] + [(*c, 1) for c in corners]
        ends = {"left": (0, -1), "right": (0, 1), "bottom": (dim - 1, -1), "top": (dim - 1, 1)}
        if dim == 3:
            ends.update(front=(1, -1), back=(1, 1))
        surfaces = {}
        element = 0
        for index in itertools.product(*[range(c) for c in reversed(self.cells)]):
            place = tuple(reversed(index))
            if not self.has(place):
                continue
            element += 1
            lines.append(f"{element}, " + ", ".join(
                str(number[tuple(p + c for p, c in zip(place, corner))]) for corner in corners))
            for side, (axis, direction) in ends.items():
                beside = [p + (direction if a == axis else 0) for a, p in enumerate(place)]
                if self.has(beside):
                    continue
                centre = self.point([p + 0.5 + (0.5 * direction if a == axis else 0.)
                                     for a, p in enumerate(place)])
                surfaces.setdefault(name(side, centre), []).append((element, SIDES[dim][side]))
        for of, members in surfaces.items():
            lines.append(f"*Surface, type=ELEMENT, name={of}")
            lines += [f"{e}, S{f}" for e, f in members]
        return "\n".join(lines) + "\n", [of for of in surfaces if of not in ends]


def on_face(cut_face, name):
    return lambda side, centre: name(centre) if side == cut_face else side


def whole(side):
    return lambda x: side


def halves(side, at):
    return lambda x: side + ("a" if x[0] < at else "b")


def thirds(side, at):
    """Three parts that meet in a point."""
    return lambda x: side + ("a" if x[1] > at else "b" if x[0] < at else "c")


def sphere(radius, middle):
    """The height of a circle or a sphere, which the program knows again in each part of a face. A
    free form is fitted in each part by itself, to some 1e-6 of the pressures."""
    return lambda x: radius - math.sqrt(radius ** 2 - sum((v - middle) ** 2 for v in x))


def run(snug, directory, scene, ranks=1):
    folder = pathlib.Path(directory)
    (folder / "scene.prm").write_text(scene)
    words = [*parallel(ranks), snug, str(folder / "scene.prm"), "--output", str(folder / "out")]
    status, _, said, *_ = execute(words) if ranks > 1 else execute_in_common(words)
    if status != 0:
        raise RuntimeError(f"status {status}: {said.strip()[-300:]}")
    with open(folder / "out" / "contact-0000.csv", encoding="utf-8") as file:
        rows = [{k: float(v) for k, v in row.items() if k != "friction"}
                for row in csv.DictReader(file)]
    summary = json.loads((folder / "out" / "summary.json").read_text())
    return summary, sorted(rows, key=lambda row: [round(row[c], 6) for c in "xyz" if c in row])
