#!/usr/bin/env python3
"""Friction between curved bodies: curved_friction.py, with the program that SNUG names.

Mirror images that are pressed on each other have no friction, whatever the model, method and
degree. Cattaneo's problem of two cylinders, pressed by prescribed displacements of their flat sides
and then sheared: the half width c of the stick zone over that of the contact a is
sqrt(1 - Q / (mu P)), the shear is that of mu (p(a) - p(c)) at each node, symmetric, and the same
with sides exchanged."""

import itertools
import math
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "contrib/lib"))

from friction_answers import half_width_by_moments, shear_force  # noqa: E402
from runs import scene, solve  # noqa: E402

MU = 0.2


def mirror_images(dim, model, radius, cells):
    """Two boxes whose round or hollow sides meet at height 1."""
    axisymmetric = model == "axisymmetric"
    axis = "xyz"[dim - 1]
    kind = "sphere" if dim == 3 or axisymmetric else "cylinder z"

    def body(height, face, held, press):
        displacement = [f"{held}: {axis} = {press}"]
        displacement += [f"{held}: {c} = 0" for c in "xy"[:dim - 1] if not axisymmetric]
        return {"Box corner": ", ".join(["0" if axisymmetric else "-0.5"] * (dim - 1) + [height]),
                "Box size": ", ".join(["0.5" if axisymmetric else "1"] * (dim - 1) + ["1"]),
                "Box cells": ", ".join([str(cells)] * (dim - 1) + ["3"]),
                "Curved faces": f"{face}: {kind} {radius}", "Young's modulus": "1000",
                "Displacement": ", ".join(displacement)}
    return {"up": body("1", "bottom", "top", "-0.02"), "lo": body("0", "top", "bottom", "0.02")}


def check_mirror_images():
    """Return the errors of all kinds of mirror images."""
    errors = []
    for (dim, model, cells), method, degree, radius in itertools.product(
            ((2, "plane strain", 12), (2, "axisymmetric", 12), (3, "solid", 6)),
            ("nodal", "mortar"), (1, 2), (4, -4)):
        name = f"{model}, degree {degree}, {method}, radius {radius}"
        result = solve(scene(
            mirror_images(dim, model, radius, cells // degree),
            {"Pairs": "up.bottom: lo.top", "Friction": "Coulomb", "Friction coefficient": MU,
             "Method": method},
            sections={"Solver": {"Relative tolerance": "1e-12"}, "Accuracy": {"Estimate": "none"}},
            Dimension=dim, Model=model, Element_degree=degree))
        shear = max(math.hypot(*(p[f"traction_{c}"] for c in "xyz"[:dim])) for p in result.points)
        part = shear / (MU * max(result.pressures()))
        active = sum(p["active"] for p in result.points)
        print(f"{name}: {active:g} contacts, shear {part:.1e} of its limit")
        if not (part < 1e-8 and active >= 3):
            errors.append(f"{name}: shear is {part} of its limit at {active} contacts")
    return errors


def cylinders(radius, size, depth, cells, swapped):
    """Two half cylinders of this radius that meet at height 0, fine around their contact."""
    def body(above, n):
        sign = 1 if above else -1
        return {"Mesh": "disc", "Radius": radius, "Part": "half", "Cells": n,
                **({"Rotate": "z: 180"} if above else {}), "Shift": f"0, {sign * radius}",
                "Refine where": f"{size} - sqrt(x^2 + y^2)", "Local refinements": depth,
                "Young's modulus": 200,
                "Displacement": f"bottom: y = {-sign * 0.0108 * radius}"}
    bodies = {"up": body(True, cells[0]), "lo": body(False, cells[1])}
    bodies["lo"]["Displacement"] += ", bottom: x = 0"
    return scene(
        bodies, {"Pairs": "lo.outer: up.outer" if swapped else "up.outer: lo.outer",
                 "Slave": "first", "Search distance": radius / 8, "Friction": "Coulomb",
                 "Friction coefficient": MU},
        sections={"Load case press": {"Displacement": "up.bottom: x = 0"},
                  "Load case pull": {"Load step": "true",
                                     "Displacement": f"up.bottom: x = {0.0038 * radius}"},
                  "Accuracy": {"Estimate": "none"}},
        Dimension=2, Load_cases="press, pull")


def check_cattaneo(cells, swapped, tolerance):
    """Return the errors of Cattaneo's problem of two cylinders."""
    points = solve(cylinders(8., 1.3, 5, cells, swapped)).cases["pull"]
    pressed, pulled = (math.fsum(abs(of(p)) for p in points)
                       for of in (lambda p: p["force"], shear_force))
    wanted = math.sqrt(1 - pulled / (MU * pressed))
    a = half_width_by_moments(points, lambda p: p["force"])
    c = half_width_by_moments(points, lambda p: MU * p["force"] - abs(shear_force(p)))
    largest = 2 * MU * pressed / (math.pi * a)

    def shear(x):
        return largest * (math.sqrt(max(0., 1 - (x / a)**2)) -
                          wanted * math.sqrt(max(0., 1 - (x / (wanted * a))**2)))
    rms = math.sqrt(math.fsum((abs(p["traction_x"]) - shear(p["x"]))**2 for p in points
                              if abs(p["x"]) < a) / sum(abs(p["x"]) < a for p in points))
    sides = [max(abs(p["traction_x"]) for p in points if p["x"] * side > 0) for side in (-1, 1)]
    ends = [max(abs(p["x"]) for p in points if p["x"] * side > 0 and p["friction"] == "stick")
            for side in (-1, 1)]
    face = 8. * math.pi / 2 / cells[0 if not swapped else 1] / 2**5
    print(f"cells {cells}, swapped {swapped}: c/a {c / a:.4f}, known {wanted:.4f}; shear off by "
          f"{rms / max(sides):.4f} of its maximum {sides}, stick up to {ends}")
    errors = []
    if not abs(c / a - wanted) < 0.02 * wanted:
        errors.append(f"c/a is {c / a} instead of {wanted}")
    if not rms < 0.04 * max(sides):
        errors.append(f"the shear is {rms} off")
    if not abs(sides[0] - sides[1]) < tolerance * sides[0]:
        errors.append(f"the shear on both sides is {sides}")
    if not all(abs(end - wanted * a) < 1.5 * face for end in ends):
        errors.append(f"the contact sticks up to {ends} instead of {wanted * a}")
    return [f"cells {cells}, swapped {swapped}: {error}" for error in errors]


def main():
    errors = check_mirror_images()
    # Matching meshes are symmetric; on others the peak of the shear lies between nodes.
    for cells, swapped, tolerance in (((10, 10), False, 1e-6), ((10, 14), False, 0.02),
                                      ((10, 14), True, 0.02)):
        errors += check_cattaneo(cells, swapped, tolerance)
    for error in errors:
        print("error:", error)
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
