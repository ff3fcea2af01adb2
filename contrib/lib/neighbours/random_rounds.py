"""Full round contact on random meshes: pins in plates and rings in rings."""

import functools
import math
import random

from runs import run_once, scene

from cases import Case, Figure, warned
from round_bodies import nested_pressure

KINDS = [(kind, method) for method in ("auto", "mortar", "nodal") for kind in ("pin", "rings")]
ALLOWED = .02  # errors of the pressure, but for nodal contact
GEOMETRIES = 10  # of pins, each with a fine run
FINE = 200


@functools.lru_cache(maxsize=None)
def parts(kind, geometry):
    """Return radii, materials, model, gap and load of a geometry."""
    draw = random.Random(f"{kind} {geometry}")
    hole = draw.uniform(5, 15)
    # thick inner rings would carry the load alone: no contact pressure to speak of
    inner = hole * (draw.uniform(.2, .7) if kind == "pin" else draw.uniform(.5, .8))
    outer = hole * draw.uniform(1.5, 3)
    materials = [(round(1000 * 3**draw.uniform(0, 1)), round(draw.uniform(0, .4), 3))
                 for _ in range(2)]
    model = draw.choice(("plane strain", "plane stress"))
    if kind == "pin":
        gap = draw.choice((0, 1e-3 * hole * draw.uniform(.1, 2)))
        load = 500 * draw.uniform(.2, 1)
    else:
        gap = draw.choice((0, -1e-3 * hole * draw.uniform(.1, 1)))
        load = 10 * draw.uniform(.1, 1)
    return (inner, hole, outer), materials, model, gap, load


def text_of(kind, geometry, cells, turn, method, subdomains):
    """Return the parameter file of two rings, the outer one turned."""
    radii, materials, model, gap, load = parts(kind, geometry)
    bodies = {}
    for i, name in enumerate(("inner", "outer")):
        across = cells[i] * (radii[i + 1] - radii[i]) / math.pi / (radii[i + 1] + radii[i])
        bodies[name] = {"Mesh": "ring", "Inner radius": radii[i], "Radius": radii[i + 1],
                        "Cells": f"{cells[i]}, {max(2, round(across))}",
                        "Young's modulus": materials[i][0],
                        "Poisson's ratio": materials[i][1], "Rotate": f"z: {i * turn}"}
    if kind == "pin":
        bodies["inner"]["Force"] = f"inner: 0 {-load}"
        bodies["outer"]["Supports"] = "outer: xy"
    else:
        bodies["inner"]["Pressure"] = f"inner: {load}"
    return scene(bodies, {"Pairs": "inner.outer: outer.inner", "Method": method, "Gap": gap,
                          "Interference": "true"}, {"Subdomains": subdomains},
                 Dimension=2, Model=model)


def right_pressure(kind, geometry):
    """Return Lamé's pressure between rings; of pins the largest on fine meshes that match."""
    radii, materials, model, gap, load = parts(kind, geometry)
    if kind == "rings":
        return nested_pressure(model, radii, materials, load, -gap)
    fine = run_once(text_of("pin", geometry, (FINE, FINE), 0, "nodal", "auto"), ranks=2).result
    return max(fine.pressures()) if fine else math.nan


def random_round(number, quick):
    """Return the Case that is drawn with a number as seed."""
    kind, method = KINDS[number % len(KINDS)]
    draw = random.Random(number)
    cells = [draw.randint(40, 60 if quick else 200) for _ in range(2)]
    if draw.random() < .15:
        cells[1] = cells[0]
    turn = draw.choice((0, draw.uniform(0, 90)))
    subdomains, ranks = draw.randint(1, 30), draw.randint(1, 4)
    # the bodies of a geometry, of which pins have few
    geometry = number % GEOMETRIES if kind == "pin" else -number
    unlike = method == "nodal" and not (cells[0] == cells[1] and turn == 0)

    def asked(result):
        right, bound = right_pressure(kind, geometry), math.inf if method == "nodal" else ALLOWED
        which = (max,) if kind == "pin" else (min, max)
        return [*(Figure(f"{one.__name__} p", one(result.pressures()), right, bound)
                  for one in which), warned(result)._replace(right=float(unlike))]
    return Case(f"random {kind}", f"{number}: {cells[0]}/{cells[1]} {method}, turned {turn:.4g}, "
                f"subdomains {subdomains}, ranks {ranks}",
                text_of(kind, geometry, cells, turn, method, subdomains), asked, ranks)
