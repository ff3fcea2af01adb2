"""Full rings and pins of uneven cells, as files of Gmsh's format 2.2."""

import math
import random

from cases import Case, label, scene
from round_bodies import SAME, lame_figures, nested_pressure, pin_figures

SPREAD = .2  # of the lengths of the cells


def angles(n, seed):
    """n angles around whose distances differ by up to the spread from their mean."""
    source = random.Random(seed)
    steps = [1 + source.uniform(-SPREAD, SPREAD) for _ in range(n)]
    total, sums = sum(steps), [0.]
    for step in steps[:-1]:
        sums.append(sums[-1] + 2 * math.pi * step / total)
    return sums


def mesh(*annuli):
    """Of (name, inner radius, radius, cells around, layers, even): regions of these names
    with boundaries NAME_inner and NAME_outer. even: 1 of an inner circle of equal cells."""
    nodes, elements, names = [], [], []
    for tag, (name, inner, outer, around, layers, even) in enumerate(annuli):
        first = len(nodes) + 1
        turns = angles(around, f"{name} {around}")
        for j in range(layers + 1):
            r, share = inner + (outer - inner) * j / layers, even * (1 - j / layers)
            nodes += [(r * math.cos(t), r * math.sin(t))
                      for t in (share * 2 * math.pi * i / around + (1 - share) * turn
                                for i, turn in enumerate(turns))]
        ring = [[first + around * j + i for i in (*range(around), 0)]
                for j in range(layers + 1)]
        group = 3 * tag + 1
        names += [f'2 {group} "{name}"', f'1 {group + 1} "{name}_inner"',
                  f'1 {group + 2} "{name}_outer"']
        for line, own in ((ring[0], group + 1), (ring[-1], group + 2)):
            elements += [f"1 2 {own} {own} {a} {b}" for a, b in zip(line, line[1:])]
        elements += [f"3 2 {group} {group} {a} {d} {c} {b}"
                     for low, high in zip(ring, ring[1:])
                     for a, b, c, d in zip(low, low[1:], high[1:], high)]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names)),
             *names, "$EndPhysicalNames", "$Nodes", str(len(nodes)),
             *(f"{i} {x!r} {y!r} 0" for i, (x, y) in enumerate(nodes, 1)), "$EndNodes",
             "$Elements", str(len(elements)),
             *(f"{i} {text}" for i, text in enumerate(elements, 1)), "$EndElements", ""]
    return "\n".join(lines).encode()


def of_file(bodies, slave, master, **contact):
    around = {"Mesh": "file", "Mesh file": "mesh.msh"}
    return scene({name: {**around, "Mesh regions": name, **entries}
                  for name, entries in bodies.items()},
                 {"Pairs": f"{slave}: {master}", **contact}, Dimension=2)


def rings(inner, outer, node_bound, ranks=1):
    radii, material = (20, 30, 40), {"Young's modulus": SAME[0][0]}
    text = of_file({"inner": {**material, "Pressure": "inner_inner: 10"},
                    "outer": material},
                   "inner.inner_outer", "outer.outer_inner", Gap=-.01, Interference="true")
    right = nested_pressure("plane strain", radii, SAME, 10, .01)
    return Case("uneven rings", f"{inner}/{outer} " + label(ranks=ranks), text,
                lame_figures(right, radii[1], 1e-2, node_bound), ranks,
                lambda: mesh(("inner", *radii[:2], inner, max(3, inner // 10), 0),
                             ("outer", *radii[1:], outer, max(3, outer // 10), 0)))


def pins(pin, plate, ranks=1):
    """On an uneven bore a force has a moment about the axis, which nothing holds."""
    text = of_file({"pin": {"Young's modulus": 210000, "Force": "pin_inner: 0 -500"},
                    "plate": {"Young's modulus": 210000, "Supports": "plate_outer: xy"}},
                   "pin.pin_outer", "plate.plate_inner")
    return Case("uneven pins", f"{pin}/{plate} " + label(ranks=ranks), text,
                pin_figures("full", 1, .02, 500, 2e-2), ranks,
                lambda: mesh(("pin", 3, 10, pin, pin // 8, 1),
                             ("plate", 10.02, 30, plate, plate // 8, 0)))
