#!/usr/bin/python3
"""Supports about an axis against torsion, Lame's ring and differences: cylindrical.py SNUG MPIEXEC."""

import json
import math
import os
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "contrib/python/tests"))
from test_snug import snug  # noqa: E402, begins again with Debian's Python if need be

from differences import assert_gradients  # noqa: E402

MODULUS, POISSON, INNER, OUTER, LENGTH, TWIST = 1000., .3, 1., 2., 3., 1e-3
SHEAR = .5 * MODULUS / (1. + POISSON)
RADIUS = "sqrt(x^2 + y^2)"


def tube(cells, entries=(), responses=(), **more):
    """Return a tube about the axis z. Responses are {name: {entry: value}}."""
    body = {"Mesh": "ring", "Inner radius": INNER, "Radius": OUTER, "Length": LENGTH, "Cells": cells,
            "Young's modulus": MODULUS, "Poisson's ratio": POISSON, **dict(entries)}
    return {"Dimension": len(cells), "Bodies": ["tube"], "Body tube": body, **more,
            **({"Responses": list(responses)} if responses else {}),
            **{f"Response {name}": values for name, values in dict(responses).items()}}


def measured(quantity, component, face="tube.bottom", **more):
    return {"Quantity": quantity, "Face": face, "Component": component, **more}


TORQUE = {"torque": measured("reaction moment", "z")}


def twisted(cells, entries=(), responses=(), **more):
    """Return a tube that is held at the bottom and turned at the top."""
    return tube(cells, {"Supports": "bottom: tangential axial",
                        "Displacement": f"top: tangential = {TWIST}*{RADIUS}", **dict(entries)},
                {**TORQUE, **dict(responses)}, **more)


def results(scene, design=None, gradients=False, ranks=1, **settings):
    with snug.Model.from_dict(scene, ranks=ranks,
                              set={"Solver/Relative tolerance": 1e-12, **settings}) as model:
        return model.evaluate(design, gradients=gradients) if design else model.evaluate()


def polar_moment(radius, n):
    """Return that of a regular polygon with n corners at the radius."""
    angle = 2. * math.pi / n
    return n * radius ** 4 * math.sin(angle) * (2. + math.cos(angle)) / 12.


class Cylindrical(unittest.TestCase):
    def test_torsion(self):
        """Cross-sections that remain plane have the torque of the polygon; otherwise the torque
        converges to that of the circle, by the square of the cells at degree 1."""
        held = {"Supports": "bottom: tangential, inner: radial axial, outer: radial axial"}
        n = 12
        moment = polar_moment(OUTER, n) - polar_moment(INNER, n)
        found = results(twisted([n, 1, 3], held))["torque"]
        self.assertAlmostEqual(found / (-SHEAR * moment * TWIST / LENGTH), 1., delta=1e-9)
        exact = -SHEAR * .5 * math.pi * (OUTER ** 4 - INNER ** 4) * TWIST / LENGTH
        for degree, least, bound in ((1, 3.7, .02), (2, 12., 1e-5)):
            errors = [abs(results(twisted([n, n // 8, 2]), **{"Element degree": degree})["torque"] /
                          exact - 1.) for n in (16, 32)]
            self.assertGreater(errors[0], least * errors[1])
            self.assertLess(errors[1], bound)

    def test_ring_under_pressure(self):
        pressure = 5.
        exact = (pressure * INNER * (1. + POISSON) / MODULUS *
                 ((1. - 2. * POISSON) * INNER ** 2 + OUTER ** 2) / (OUTER ** 2 - INNER ** 2))
        response = {"widening": measured("displacement", "radial", "tube.inner")}
        load = {"Pressure": f"inner: {pressure}"}
        for dim, supports in ((2, "inner: tangential"),
                              (3, "inner: tangential, bottom: axial, top: axial")):
            errors = [abs(results(tube([n, n // 4, 1][:dim], {**load, "Supports": supports}, response))
                          ["widening"] / exact - 1.) for n in (16, 32)]
            self.assertGreater(errors[0], 3.7 * errors[1])
            self.assertLess(errors[1], .02)

    def test_springs(self):
        """A rigid turn of a polygon on tangential springs: the springs have the energy
        1/2 k int (turn r)^2 dA over its faces."""
        n, k = 12, 7.
        chord, height = 2. * OUTER * math.sin(math.pi / n), OUTER * math.cos(math.pi / n)
        scene = tube([n, 1, 1], {"Young's modulus": 1e12, "Supports": "inner: radial axial",
                                 "Displacement": f"inner: tangential = {TWIST}*{RADIUS}",
                                 "Springs": f"outer: tangential = {k}"})
        expected = .5 * k * TWIST ** 2 * n * chord * (height ** 2 + chord ** 2 / 12.) * LENGTH
        # of two Gauss points along the chord; they integrate the direction at their places
        self.assertAlmostEqual(results(scene)["potential energy"] / expected, 1., delta=1e-6)

    def test_turned_models(self):
        """The axis turns and moves with the body."""
        scene = twisted([8, 2, 2], {"Supports": "bottom: tangential axial, outer: radial"})
        energy = results(scene)["potential energy"]
        c, s = math.cos(math.radians(20.)), math.sin(math.radians(20.))
        body = scene["Body tube"]
        body.update({"Rotate": "z: 30, x: 20", "Shift": [3., -2., 5.], "Axis": [0., -2. * s, 2. * c],
                     "Axis point": [3., -2. - s, 5. + c]})
        y, z = "(y + 2)", "(z - 5)"
        body["Displacement"] = (f"top: tangential = {TWIST}*sqrt((x - 3)^2 + ({c!r}*{y} + "
                                f"{s!r}*{z})^2)")
        self.assertAlmostEqual(results(scene)["potential energy"] / energy, 1., delta=1e-9)

    def test_edges(self):
        """At the edges of a quarter, planes of symmetry may be held in three ways. A direction that
        is held already is left out, and another value there is an error."""
        pressed = {"Part": "quarter", "Pressure": "inner: 3"}
        others = "bottom: tangential axial, top: axial"
        energies = [results(tube([6, 2, 2], {**pressed, "Supports": f"{planes}, {others}"}))
                    ["potential energy"] for planes in (
                        "start: normal, end: normal", "start: y, end: x", "start: tangential, end: x",
                        "start: tangential, end: tangential normal")]
        for energy in energies:
            self.assertAlmostEqual(energy / energies[0], 1., delta=1e-9)
        scene = tube([6, 2, 2], {**pressed, "Supports": "start: normal, end: x, bottom: axial",
                                 "Displacement": "bottom: tangential = 0.01"})
        with self.assertRaisesRegex(snug.InputError, "prescribe different displacements"):
            results(scene)

    def gradient_scene(self, dim=3):
        """Return a twisted tube whose held nodes, loads and springs move in all directions. Nodes
        of the contact face are held as well."""
        if dim == 2:
            return tube([8, 2], {"Supports": "inner: tangential", "Pressure": "outer: 1 + x",
                                 "Axis point": [.1, .2], "Springs": "outer: radial = 20 + x"},
                        {"widening": measured("displacement", "radial", "tube.outer"),
                         "grip": measured("reaction", "tangential", "tube.inner")},
                        Shape={"Basis": "formula modes", "Bounds": [-.1, .1],
                               "Modes": "-0.3*y, 0.3*x; 0.2*x*y, 0.1*y; 0.1*x*x, 0.2"})
        return twisted(
            [6, 2, 2], {"Supports": "bottom: tangential normal, inner: radial", "Axis": [.1, 0., 1.],
                        "Axis point": [.05, 0., 0.], "Pressure": "outer: 1 + x",
                        "Springs": "outer: tangential = 20*z, outer: axial = 30"},
            {"grip": measured("reaction", "tangential"), "push": measured("reaction", "radial", "tube.inner"),
             "lift": measured("reaction", "axial"), "turn": measured("displacement", "tangential", "tube.outer"),
             "widening": measured("displacement", "radial", "tube.outer"),
             "rise": measured("displacement", "axial", "tube.outer"),
             "strain": {"Quantity": "strain energy"}},
            Obstacles=["lid"], Contact={"Pairs": "tube.top: lid", "Interference": True},
            **{"Obstacle lid": {"Point": [0., 0., LENGTH - .1], "Normal": [.01, 0., -1.]}},
            Shape={"Basis": "formula modes", "Bounds": [-.1, .1],
                   "Modes": "-0.3*y*z, 0.3*x*z, 0.1*x; 0.3*x + 0.1*y*z, 0.2*y, 0.1*z*y; "
                            "0.1*x*x, 0.2*z, 0.1*y"})

    def test_gradients(self):
        for dim, method in ((3, "adjoint"), (3, "direct"), (3, "energy"), (2, "adjoint")):
            scene = self.gradient_scene(dim)
            settings = {"Solver/Relative tolerance": 1e-13, "Gradient/Method": method}
            if method == "energy":
                settings["Optimization/Objective"] = "potential energy"
            with snug.Model.from_dict(scene, set=settings) as model:
                assert_gradients(self, model, [.03, -.02, .05], 1e-3)

    def test_ranks(self):
        settings = {"Solver/Relative tolerance": 1e-14, "Decomposition/Subdomains": 6}
        values = [results(self.gradient_scene(), [.03, -.02, .05], ranks=ranks, **settings)
                  for ranks in (1, 2, 3)]
        for name in ("potential energy", "torque", "grip", "turn"):
            for value in values:
                self.assertAlmostEqual(value[name] / values[0][name], 1., delta=1e-12, msg=name)

    def test_wrong_models(self):
        ring, solid = {"Supports": "inner: xy"}, {"Supports": "bottom: xyz"}
        plane = [8, 2]
        for scene, words in (
                (tube(plane, {"Supports": "inner: axial"}), "'axial' is not a component"),
                (tube([8, 2, 2], {"Supports": "bottom: radiall"}), r"'radiall' is not a component "
                 r"\(x, y, z, normal, radial, tangential, axial\)"),
                (tube([8, 2, 2], {"Displacement": "bottom: tangent = 1"}), "'tangent' is not"),
                (tube(plane, {**ring, "Axis": [0., 1.]}), "must be empty for Dimension = 2"),
                (tube([8, 2, 2], {**solid, "Axis": [0., 0., 0.]}), "must not be zero"),
                (tube([8, 2, 2], {**solid, "Axis": [0., 1.]}), "must have 3 numbers"),
                (tube([8, 2, 2], {**solid, "Axis point": [0., 1.]}), "must have 3 numbers"),
                ({"Dimension": 2, "Model": "axisymmetric", "Bodies": ["block"],
                  "Body block": {"Box cells": [2, 2], "Supports": "bottom: y, left: radial"}},
                 "'Model' = 'axisymmetric': does not allow the radial and tangential components of "
                 "'block'"),
                (tube([8, 2, 2], {"Supports": "bottom: tangential", "Axis point": [INNER, 0., 0.]}),
                 r"'Body tube/Supports' of 'tube.bottom': the node \(1 0 0\) on the axis has no "
                 "radial and tangential components"),
                (tube(plane, ring, {"u": measured("displacement", "axial", "tube.inner")}),
                 "must be normal, x, y, radial or tangential for Dimension = 2"),
                (tube([8, 2, 2], solid, {"u": {"Quantity": "displacement", "Point": [0., 1.5, 1.],
                                               "Component": "radial"}}), "must be x, y or z"),
                (tube([8, 2, 2], solid, {"m": measured("reaction moment", "axial")}),
                 "must be x, y or z, the axis")):
            with self.assertRaisesRegex(snug.InputError, words) as caught:
                results(scene)
            self.assertNotIn("\n", str(caught.exception).strip())


if __name__ == "__main__":
    os.environ["SNUG"] = sys.argv[1]
    os.environ["PATH"] = os.pathsep.join([str(pathlib.Path(sys.argv[2]).parent), os.environ["PATH"]])
    unittest.main(argv=sys.argv[:1])
