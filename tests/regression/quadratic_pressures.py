#!/usr/bin/env python3
"""Pressures on faces of quadratic tetrahedra: quadratic_pressures.py, with the program that SNUG
names.

Uniform pressure between bodies of tetrahedra, on meshes that match or do not, is exact. The pressure
of a rigid cylinder on tetrahedra between two planes is that of a fine mesh of squares in plane
strain: it has no zeros and no peaks at corners or middles of edges. Pressures on hexahedra of degree
2 do not alternate between corners and middles of edges."""

import bisect
import pathlib
import sys

LIB = pathlib.Path(__file__).resolve().parents[2] / "contrib/lib"
sys.path[:0] = [str(LIB), str(LIB / "neighbours"), str(LIB / "stability")]

from expectations import Expectations  # noqa: E402
from runs import RunError, run, scene  # noqa: E402
from scenes import tetrahedra  # noqa: E402

TETRAHEDRA = {"Mesh": "file", "File": "mesh.msh", "Young's modulus": 1000}
AROUND = {"Accuracy": {"Estimate": "none"}}


def result(text, n=3):
    """Return the Result of a scene beside the mesh of tetrahedra."""
    done = run(text, mesh=tetrahedra(1, n))
    if done.result is None:
        raise RunError(f"status {done.status}, {done.message}")
    return done.result


def pressed(upper=None, lower=None, contact=None):
    """Return two blocks of tetrahedra under a pressure of 10; entries replace these."""
    planes = "left: x, front: y"
    return scene(
        {"up": {**TETRAHEDRA, "Supports": planes, "Pressure": "top: 10", "Shift": "0, 0, 1",
                **(upper or {})},
         "lo": {**TETRAHEDRA, "Supports": planes + ", bottom: z", **(lower or {})}},
        {"Pairs": "up.bottom: lo.top", **(contact or {})},
        sections={"Solver": {"Relative tolerance": 1e-11}, **AROUND}, Dimension=3)


# Turned by 90 degrees, the diagonals of the faces cross those of the other side.
TURNED = {"Rotate": "z: 90", "Shift": "1, 0, 1", "Supports": "left: y, front: x"}
EVEN = {"meshes that match": pressed(),
        "the same, mortar": pressed(contact={"Method": "mortar"}),
        "crossing diagonals": pressed(TURNED),
        "a finer side": pressed({"Refinements": 1}),
        "a side refined in part": pressed({"Refine where": ".4 - x", "Local refinements": 1}),
        "quadratic hexahedra": pressed(lower={"Mesh": "box", "File": "", "Box cells": "4, 4, 4"})}


def on_cylinder(dim, body, **entries):
    """Return a block that is pressed on a rigid cylinder, in plane strain."""
    last = "xyz"[dim - 1]
    planes = "left: x, front: y, back: y" if dim == 3 else "left: x"
    place = {"Point": ", ".join(["0"] * (dim - 1) + ["-4"])}
    if dim == 3:
        place["Axis"] = "0, 1, 0"
    return scene({"block": {"Young's modulus": 1000, "Supports": planes,
                            "Displacement": f"top: {last} = -.025", **body}},
                 {"Pairs": "block.bottom: cylinder"},
                 obstacles={"cylinder": {"Shape": "sphere" if dim == 2 else "cylinder",
                                         "Radius": 4, **place}},
                 sections=AROUND, Dimension=dim, **entries)


def profile(found):
    """Return the places x and the pressures of the nodes with rows, ascending in x."""
    rows = sorted((row["x"], row["pressure"]) for row in found.points)
    return [x for x, _ in rows], [p for _, p in rows]


def main():
    expect = Expectations()
    for name, text in EVEN.items():
        pressures = result(text, 2 if "in part" in name else 3).pressures()
        error = max(abs(p / 10 - 1) for p in pressures)
        expect(f"even pressure, {name}: {len(pressures)} rows, error {error:.1e}", error < 1e-8)
    places, right = profile(result(on_cylinder(2, {"Mesh": "box", "Box cells": "128, 128"})))
    end = max(x for x, p in zip(places, right) if p > 0.)
    errors = []
    for x, p in zip(*profile(result(on_cylinder(3, TETRAHEDRA), 8))):
        if x < .8 * end:
            k = min(max(bisect.bisect(places, x), 1), len(places) - 1)
            part = (x - places[k - 1]) / (places[k] - places[k - 1])
            errors.append(p / (right[k - 1] * (1 - part) + right[k] * part) - 1)
    rms = (sum(error**2 for error in errors) / len(errors))**.5
    expect(f"cylinder, {len(errors)} nodes within .8 of {end:.3f}: error {100 * rms:.1f} % rms, "
           f"{100 * min(errors):.1f} to {100 * max(errors):.1f} %",
           rms < .06 and min(errors) > -.2 and max(errors) < .2)
    for dim, cells in ((2, "8, 8"), (3, "12, 2, 12")):
        text = on_cylinder(dim, {"Mesh": "box", "Box cells": cells}, Element_degree=2)
        error = max(profile(result(text))[1]) / max(right) - 1
        expect(f"cylinder, degree 2, {cells} cells: largest pressure {100 * error:.2f} % off",
               abs(error) < .003)
    return expect.status()


if __name__ == "__main__":
    sys.exit(main())
