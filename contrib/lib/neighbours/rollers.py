"""Cylinders, spheres and a roller on a block: contacts that are small and curved."""

import math

from runs import run_once

from cases import Case, Figure, contact_scene, label, warned

BETWEEN = {"Pairs": "upper.outer: lower.outer"}


def near(radius, axes="xy"):
    """Return the region within so far of the origin, in which cells are refined."""
    return f"{radius} - sqrt({' + '.join(f'{x}^2' for x in axes)})"


def two_round(mesh, part, region, cells, levels, radii, materials):
    """Return the entries of two round bodies that are refined in a region."""
    return {name: {"Mesh": mesh, "Radius": radii[index], "Part": part, "Cells": cells[index],
                   "Refine where": region, "Local refinements": levels[index],
                   **materials[index]} for index, name in enumerate(("upper", "lower"))}


def cylinders(cells=(4, 4), levels=(5, 5), radii=(10, 13), model="plane strain",
              materials=((30000, .25), (29120, .3)), load=1600, **settings):
    """Return the lower quarter of a cylinder on the upper one of another, right halves."""
    bodies = two_round("disc", "quarter", near(2.5), cells, levels, radii, [
        {"Young's modulus": E, "Poisson's ratio": nu} for E, nu in materials])
    bodies["upper"].update({"Rotate": "z: -90", "Shift": f"0, {radii[0]}",
                            "Supports": "bottom: x", "Force": f"left: 0 {-load}"})
    bodies["lower"].update({"Shift": f"0, {-radii[1]}", "Supports": "left: x, bottom: y"})
    return contact_scene(bodies, BETWEEN | {"Search distance": 3}, Dimension=2, Model=model,
                       **settings)


SOFT = 2 * [{"Young's modulus": 20000}]


def spheres(cells=(4, 4), levels=(3, 3), radii=(50, 50), **settings):
    """Return two spheres as sections, pressed together by 4."""
    bodies = two_round("disc", "quarter", near(20), cells, levels, radii, SOFT)
    bodies["upper"].update({"Rotate": "z: -90", "Shift": f"0, {radii[0]}",
                            "Supports": "bottom: x", "Displacement": "left: y = -2"})
    bodies["lower"].update({"Shift": f"0, {-radii[1]}", "Supports": "left: x",
                            "Displacement": "bottom: y = 2"})
    return contact_scene(bodies, BETWEEN | {"Search distance": 20}, Dimension=2,
                       Model="axisymmetric", **settings)


def solid_spheres(cells=(4, 4), levels=(2, 2), radii=(50, 50), **settings):
    """Return the same spheres, an eighth of each."""
    bodies = two_round("sphere", "eighth", near(20, "xyz"), cells, levels, radii, SOFT)
    bodies["upper"].update({"Rotate": "x: -90", "Shift": f"0, 0, {radii[0]}",
                            "Supports": "left: x, bottom: y",
                            "Displacement": "front: z = -2"})
    bodies["lower"].update({"Shift": f"0, 0, {-radii[1]}", "Supports": "left: x, front: y",
                            "Displacement": "bottom: z = 2"})
    return contact_scene(bodies, BETWEEN | {"Search distance": 20}, Dimension=3, **settings)


def roller(cells=(8, 40), levels=(3, 3), **settings):
    """Return a quarter of a roller of steel on a block of aluminium, 35 kN per mm in all."""
    around = {"Refine where": near(12)}
    return contact_scene(
        {"roller": {"Mesh": "disc", "Radius": 50, "Part": "quarter", "Cells": cells[0],
                    "Rotate": "z: -90", "Shift": "0, 50", **around,
                    "Local refinements": levels[0], "Supports": "bottom: x",
                    "Young's modulus": 210000, "Force": "left: 0 -17500"},
         "block": {"Box corner": "0, -200", "Box size": "200, 200",
                   "Box cells": f"{cells[1]}, {cells[1]}", **around,
                   "Local refinements": levels[1], "Young's modulus": 70000,
                   "Supports": "left: x, bottom: y"}},
        {"Pairs": "roller.outer: block.top", "Search distance": 10}, Dimension=2, **settings)


# What tells a problem, not its mesh.
PROBLEM = ("radii", "model", "materials", "load")
# The finest meshes; nodes at equal distances on both sides.
FINEST = {cylinders: {"levels": (6, 6)}, spheres: {"levels": (5, 5)},
          solid_spheres: {"levels": (3, 3)}, roller: {"levels": (5, 5)}}


def rollers(make, *, ranks=1, finer=False, **settings):
    """Return the case that the largest pressure is within 1 % of that of the finest matching run;
    within 10 % and with a warning of nodal rows on unlike meshes, or of a finer side made the
    slave."""
    problem = {name: value for name, value in settings.items() if name in PROBLEM}
    forced = ("is nodal, but" if settings.get("method") == "nodal" and "cells" in settings
              else "times finer" if settings.get("slave") == "first" and finer else None)

    def asked(result):
        finest = run_once(make(**FINEST[make], **problem)).result
        right = finest.state["max_pressure"] if finest else math.nan
        return [Figure("largest p", result.state["max_pressure"], right,
                       1e-1 if forced else 1e-2),
                *([warned(result, forced)] if forced else [])]
    return Case("rollers", f"{make.__name__.replace('_', ' ')} " + label(
        {**settings, "ranks": ranks}), make(**settings), asked, ranks)


ROLLERS = [
    rollers(cylinders, cells=(4, 5)),
    rollers(spheres, degree=2, ranks=2),
    rollers(cylinders, ranks=2),
    rollers(cylinders, model="plane stress", ranks=2),
    rollers(cylinders, cells=(5, 4), model="plane stress"),
    rollers(cylinders, cells=(4, 5), levels=(5, 4)),
    rollers(cylinders, cells=(4, 5), levels=(5, 4), slave="first", finer=True),
    rollers(cylinders, cells=(6, 4), degree=2, levels=(4, 4), ranks=3),
    rollers(cylinders, cells=(5, 6), method="mortar", subdomains=3),
    rollers(cylinders, cells=(5, 6), radii=(8, 20), ranks=4),
    rollers(cylinders, cells=(5, 4), materials=((210000, .3), (3000, .4)), load=400),
    rollers(cylinders, cells=(5, 4), method="nodal"),
    rollers(spheres, levels=(4, 4)),
    rollers(spheres, cells=(4, 5), levels=(4, 4), ranks=2),
    rollers(spheres, cells=(5, 4), levels=(4, 4), method="mortar", slave="first",
            subdomains=4),
    rollers(spheres, cells=(4, 5), degree=2, levels=(2, 3)),
    rollers(spheres, cells=(5, 6), levels=(4, 4), radii=(40, 80), ranks=3),
    rollers(solid_spheres, cells=(4, 5), ranks=2),
    rollers(solid_spheres, cells=(5, 4), method="mortar", subdomains=20, ranks=4),
    rollers(roller, levels=(4, 4)),
    rollers(roller, cells=(9, 35), levels=(4, 4), ranks=2),
    rollers(roller, cells=(8, 30), levels=(4, 4), method="mortar", slave="first"),
    rollers(roller, cells=(8, 25), degree=2, ranks=3),
]
