#!/usr/bin/env python3
"""Write gear-teeth.msh: two spur gears, three teeth of each on a full rim, in contact.

usage: prm/meshes/gear-teeth.py [--size MM] [FILE]

Involute gears of module 4 mm with 20 and 30 teeth and a pressure angle of 20 degrees about the
points (0, 0) and (100, 0), in the format 2.2 of Gmsh with quadrilaterals of second order.
Their working flanks touch at the pitch point (40, 0). All nodes of the flanks lie on the
involute, above the base circle, or on a radial line below it. Groups: cells pinion and wheel,
lines pinion_flanks and wheel_flanks (the working flanks of the three teeth), pinion_bore and
wheel_bore, pinion_tips and wheel_tips. --size is that of the cells along the flanks (0.3).
"""

import argparse
import math
import pathlib

MODULE, ALPHA, TEETH = 4., math.radians(20), {"pinion": 20, "wheel": 30}
DEDENDUM, ADDENDUM, BORE = 1.25, 1., .45  # in modules, and as a part of the root circle
FIRST, ROLL = .07, .035  # roll angle of the first cell of a flank, largest step of the next ones
ACROSS = 7       # cells across a tooth, growing from the working flank
GROWTH = 1.4
GAP = 4          # cells of the root between two teeth
REST = 30        # cells around the rim without teeth
NAMES = [("pinion", "wheel"),
         ("pinion_flanks", "pinion_tips", "pinion_bore",
          "wheel_flanks", "wheel_tips", "wheel_bore")]


def with_middles(values):
    """Return the values and the middles between them."""
    middles = [(a + b) / 2 for a, b in zip(values, values[1:])]
    return [value for pair in zip(values, middles) for value in pair] + values[-1:]


def geometric(n, growth):
    """Return 0 to 1 in n steps, each that many times the one before."""
    sizes = [growth**i for i in range(n)]
    return [sum(sizes[:i]) / sum(sizes) for i in range(n + 1)]


class Mesh:
    """This class collects nodes, which adjacent blocks share, and elements."""

    def __init__(self):
        self.nodes, self.elements = {}, []

    def node(self, x, y):
        key = f"{x:.7f} {y:.7f} 0".replace("-0.0000000", "0.0000000")
        return self.nodes.setdefault(key, len(self.nodes) + 1)

    def element(self, kind, name, nodes):
        dimension = 2 if kind == 10 else 1
        group = NAMES[2 - dimension].index(name) + 1
        self.elements.append(f"{kind} 2 {group} {group} {' '.join(map(str, nodes))}")

    def block(self, name, columns, rows, point, lines):
        """Add the cells of a grid with points(column, row), and named lines of its sides."""
        columns, rows = with_middles(columns), with_middles(rows)
        n = [[self.node(*point(column, row)) for row in rows] for column in reversed(columns)]
        for i in range(0, len(columns) - 1, 2):
            for j in range(0, len(rows) - 1, 2):
                self.element(10, name, (
                    n[i][j], n[i + 2][j], n[i + 2][j + 2], n[i][j + 2], n[i + 1][j],
                    n[i + 2][j + 1], n[i + 1][j + 2], n[i][j + 1], n[i + 1][j + 1]))
        sides = {"bottom": [line[0] for line in n], "top": [line[-1] for line in n],
                 "left": n[-1], "right": n[0]}
        for side, line_name in lines.items():
            side = sides[side]
            for i in range(0, len(side) - 1, 2):
                self.element(8, line_name, (side[i], side[i + 2], side[i + 1]))

    def write(self, path):
        names = [f'{2 - i} {j + 1} "{name}"' for i in (1, 0) for j, name in enumerate(NAMES[i])]
        sections = {"MeshFormat": ["2.2 0 8"], "PhysicalNames": [len(names), *names],
                    "Nodes": [len(self.nodes), *(f"{i} {key}" for key, i in self.nodes.items())],
                    "Elements": [len(self.elements),
                                 *(f"{i + 1} {one}" for i, one in enumerate(self.elements))]}
        path.write_text("".join(f"${name}\n" + "".join(f"{line}\n" for line in lines) +
                                f"$End{name}\n" for name, lines in sections.items()),
                        encoding="utf-8")


def lengths(last, base, size):
    """Return lengths along an involute from the base circle to a roll angle: behind the first
    cell steps of about a size, or of the roll angle ROLL if that is less."""
    rolls = [FIRST]
    while rolls[-1] < last:
        rolls.append(rolls[-1] + min(ROLL, size / (base * rolls[-1])))
    factor = (last - FIRST) / (rolls[-1] - FIRST)
    return [0., *(base * (FIRST + factor * (roll - FIRST))**2 / 2 for roll in rolls)]


def gear(mesh, name, size):
    """Add a gear whose working flanks face the positive direction of the angle; the middle one
    has its pitch point at the angle 0. The wheel is turned by 180 degrees."""
    z = TEETH[name]
    pitch = MODULE * z / 2
    base, root, tip = pitch * math.cos(ALPHA), pitch - DEDENDUM * MODULE, pitch + ADDENDUM * MODULE
    at_pitch = math.tan(ALPHA) - ALPHA
    place = (0., 1.) if name == "pinion" else (sum(TEETH.values()) * MODULE / 2, -1.)

    def polar(radius, angle):
        return (place[0] + place[1] * radius * math.cos(angle),
                place[1] * radius * math.sin(angle))

    def tooth(s):  # radius and half of the angle of a tooth, s along the flank from the base
        roll = math.sqrt(max(2 * s / base, 0.))
        return (base * math.hypot(1, roll) + min(s, 0.),
                math.pi / (2 * z) + at_pitch - (roll - math.atan(roll)))

    n = round((base - root) / (1.7 * size))
    rows = [(root - base) * (1 - i / n) for i in range(n)] + lengths(
        math.sqrt((tip / base)**2 - 1), base, size)
    across = [1 - t for t in reversed(geometric(ACROSS, GROWTH))]
    rim = [root * (1 - (1 - BORE) * t) for t in reversed(geometric(8, 1.3))]
    step, widest = 2 * math.pi / z, tooth(0.)[1]
    for k in (-1, 0, 1):
        centre = k * step - math.pi / (2 * z)
        mesh.block(name, across, rows,
                   lambda t, s, c=centre: polar(tooth(s)[0], c + (2 * t - 1) * tooth(s)[1]),
                   {"right": f"{name}_flanks", "top": f"{name}_tips"})
        around = [centre + (2 * t - 1) * widest for t in across]
        around += [around[-1] + (step - 2 * widest) * (i + 1) / GAP for i in range(GAP)]
        mesh.block(name, around, rim, lambda a, r: polar(r, a), {"bottom": f"{name}_bore"})
    turn = (z - 3) * step
    rest = [around[-1] + turn * (u - .6 * math.sin(2 * math.pi * u) / (2 * math.pi))
            for u in (i / REST for i in range(REST + 1))]
    mesh.block(name, rest, rim, lambda a, r: polar(r, a), {"bottom": f"{name}_bore"})


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("--size", type=float, default=.3)
    parser.add_argument("file", nargs="?", type=pathlib.Path,
                        default=pathlib.Path(__file__).with_suffix(".msh"))
    options = parser.parse_args()
    mesh = Mesh()
    for name in TEETH:
        gear(mesh, name, options.size)
    mesh.write(options.file)


if __name__ == "__main__":
    main()
