"""The scenes of the charts: files of the repository and what is set in them."""

HERTZ_2D = "tests/scenes/hertz-2d-small.prm"
HERTZ_3D = "tests/scenes/hertz-3d-small.prm"
BLOCKS = "tests/scenes/two-blocks-2d.prm"
BEAM = "tests/scenes/beam.prm"
PUNCH = "prm/hertz-3d-16.prm"

# The line contact with nine heights under the cylinder.
HEIGHTS_2D = {"Shape/Basis": "Bezier patch", "Shape/Face": "plane.top",
              "Shape/Control points": "9", "Shape/Direction": "0, 1",
              "Shape/Bounds": "-0.25, 0.25"}

# The compliance has no gradient without a solve: all methods have something to do.
COMPLIANCE = {"Optimization/Objective": "compliance"}


def tolerance(value):
    return {"Solver/Relative tolerance": value}


def cells(n, *bodies, dim=3):
    return {f"Body {body}/Box cells": ", ".join([str(n)] * dim)
            for body in bodies}


def heights(n):
    """n x n Bezier heights."""
    return {"Shape/Control points": f"{n}, {n}"}
