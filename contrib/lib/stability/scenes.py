"""Scenes of a few numbers, some of which have answers on paper."""

import itertools
import math

from runs import run_once, scene, section

from cases import Figure


def blocks(upper=None, lower=None, contact=None, solver=None, parts="auto", dim=2, sections=None,
           **entries):
    """Return a unit cube pressed by 1 on another, in 2D squares in plane strain, both with planes
    of symmetry at their left sides (and front); entries of bodies replace these."""
    planes, last = {2: ("left: x", "y"), 3: ("left: x, front: y", "z")}[dim]
    around = {"Box cells": ", ".join(["4"] * dim), "Young's modulus": 1000}
    bodies = {"upper": {**around, "Box corner": "0, 1" if dim == 2 else "0, 0, 1",
                        "Supports": planes, "Pressure": "top: 1", **(upper or {})},
              "lower": {**around, "Supports": f"{planes}, bottom: {last}", **(lower or {})}}
    return scene(bodies, {"Pairs": "upper.bottom: lower.top", **(contact or {})},
                 {"Subdomains": parts}, sections={
                     "Solver": solver or {}, **(sections or {}),
                     "Response top": {"Quantity": "displacement", "Face": "upper.top"}},
                 Dimension=dim, **{"Responses": "top", **entries})


def tetrahedra(height, n=3):
    """Return a Gmsh file of the box 1 x 1 x height, each of its n^3 parts in six tetrahedra, with
    the boundaries bottom, top, left, front and back."""
    def node(*place):
        return 1 + sum(c * (n + 1)**d for d, c in enumerate(place))
    places = list(itertools.product(range(n + 1), repeat=3))
    nodes = [f"{node(*p)} {p[0] / n} {p[1] / n} {p[2] / n * height}" for p in places]
    cells, faces = [], []
    for corner in itertools.product(range(n), repeat=3):
        for axes in itertools.permutations(range(3)):
            path = [corner]
            for axis in axes:
                path.append(tuple(c + (d == axis) for d, c in enumerate(path[-1])))
            if axes in ((0, 2, 1), (1, 0, 2), (2, 1, 0)):  # odd ones are left-handed
                path[2:] = reversed(path[2:])
            cells.append(path)
    sides = {"bottom": (2, 0), "top": (2, n), "left": (0, 0), "front": (1, 0),
             "back": (1, n)}
    for tag, (axis, level) in enumerate(sides.values(), 1):
        for cell, three in itertools.product(cells, itertools.combinations(range(4), 3)):
            if all(cell[i][axis] == level for i in three):
                faces.append((tag, [cell[i] for i in three]))
    elements = [f"2 2 {tag} {tag} " + " ".join(str(node(*p)) for p in face) for tag, face in faces]
    elements += ["4 2 9 9 " + " ".join(str(node(*p)) for p in cell) for cell in cells]
    names = [f'2 {tag} "{name}"' for tag, name in enumerate(sides, 1)] + ['3 9 "all"']
    parts = {"MeshFormat": ["2.2 0 8"], "PhysicalNames": [str(len(names)), *names],
             "Nodes": [str(len(nodes)), *nodes],
             "Elements": [str(len(elements)),
                          *(f"{i} {one}" for i, one in enumerate(elements, 1))]}
    return "".join(f"${name}\n" + "\n".join(lines) + f"\n$End{name}\n"
                   for name, lines in parts.items()).encode()


def even(pressure=1., top=None, bound=1e-5):
    """Return what is asked where the pressure is the same at all nodes and the top sinks by so
    much."""
    def asked(result):
        figures = [Figure(f"{which.__name__} p", which(result.pressures()), pressure, bound)
                   for which in (min, max)]
        if top is not None:
            figures.append(Figure("top", -result.state["responses"]["top"], top, bound))
        return figures
    return asked


def sinks(heights, moduli, ratios, pressure=1., dim=2):
    """Return how far the top of guided blocks sinks under a pressure, free to widen; in plane
    strain in one direction only."""
    return pressure * sum(h / E * (1 - nu**2 if dim == 2 else 1)
                          for h, E, nu in zip(heights, moduli, ratios))


def force(value, bound=1e-5, component=1):
    """Return what is asked of the force of all contacts on the slaves."""
    return lambda result: [Figure("force", result.state["contact_force"][component], value,
                                  bound)]


def nothing_touches(result):
    return [Figure("active contacts", result.state["active_contacts"], 0., 0.)]


def energy(value, bound=1e-5):
    return lambda result: [Figure("energy", result.state["energy"], value, bound)]


def untorn(text, bound=1e-5, names=("energy", "max_pressure")):
    """Return the figures of bodies in one piece each, with another factorization."""
    def asked(result):
        whole = run_once(text + section("Decomposition", {"Subdomains": 2}) +
                    section("Solver", {"Factorization": "MUMPS"})).result
        return [Figure(name, result.state[name], whole.state[name] if whole else math.nan, bound)
                for name in names]
    return asked


def hump(radius, load, cells, **settings):
    """Return a block with a round lower side on another, solved well enough for dense algebra."""
    across = f"{cells[0]}, {cells[1]}"
    lower = {"Box cells": across, "Supports": "bottom: xy", **settings.pop("lower", {})}
    upper = {"Box cells": across, "Curved faces": f"bottom: cylinder z {radius}",
             "Pressure": f"top: {load}", **settings.pop("upper", {})}
    solver = {"Relative tolerance": 1e-9, **settings.pop("solver", {})}
    return blocks(upper, lower, solver=solver, **settings)
