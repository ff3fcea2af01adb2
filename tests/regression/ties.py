#!/usr/bin/python3
"""Tied pairs against bodies in one piece, uniform stress and differences: ties.py SNUG MPIEXEC."""

import json
import os
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "contrib/python/tests"))
from test_snug import snug  # noqa: E402, begins again with Debian's Python if need be

from differences import assert_gradients  # noqa: E402

AXES = "xyz"
TENSION, MODULUS, POISSON = 2., 1000., .3


def block(corner, cells, **entries):
    return {"Box corner": corner, "Box cells": cells, "Young's modulus": MODULUS,
            "Poisson's ratio": POISSON, **entries}


def cantilever(right_cells, gap=0., **contact):
    """Return two tied cubes, held at the left end and loaded across at the right end."""
    return {"Dimension": 3, "Bodies": ["left", "right"],
            "Body left": block([0, 0, 0], [4, 4, 4], Supports="left: xyz"),
            "Body right": block([1 + gap, 0, 0], right_cells, Force="right: 0 0.5 1"),
            "Contact": {"Pairs": "left.right: right.left", "Law": "tied", **contact}}


def stretched(dim, cells):
    """Return 2 x 2 tied squares or cubes in uniaxial tension, which meet at one point or edge."""
    names, bodies = "abcd", {}
    for number, name in enumerate(names):
        i, j = number % 2, number // 2
        supports = (["left: x"] if i == 0 else []) + (["bottom: y", "front: y"][dim - 2:dim - 1]
                                                      if j == 0 else [])
        supports += ["bottom: z"] if dim == 3 else []
        bodies[f"Body {name}"] = block([i, j, 0][:dim], cells[number][:dim],
                                       Supports=", ".join(supports),
                                       **({"Pressure": f"right: {-TENSION}"} if i == 1 else {}))
    up, down = ("top", "bottom") if dim == 2 else ("back", "front")
    return {"Dimension": dim, "Bodies": list(names), **bodies, "Contact": {
        "Law": "tied", "Pairs": f"a.right: b.left, c.right: d.left, a.{up}: c.{down}, b.{up}: d.{down}"}}


def energy(scene, **entries):
    settings = {"Task": "state", "Solver/Relative tolerance": 1e-11, **entries}
    with snug.Model.from_dict(scene, set=settings) as model:
        return model.evaluate()["potential energy"]


class Ties(unittest.TestCase):
    def test_a_cut_body_is_the_body(self):
        whole = {"Dimension": 3, "Bodies": ["left"], "Body left": block(
            [0, 0, 0], [8, 4, 4], Supports="left: xyz", Force="right: 0 0.5 1",
            **{"Box size": [2, 1, 1]})}
        for degree in (1, 2):
            entries = {"Element degree": degree}
            expected = energy(whole, **entries)
            for method in ("nodal", "mortar"):
                found = energy(cantilever([4, 4, 4], Method=method), **entries)
                self.assertAlmostEqual(found / expected, 1., delta=1e-10)
        # unlike meshes converge: the difference of degree 2 is below that of degree 1
        self.assertAlmostEqual(energy(cantilever([3, 6, 3]), **entries) / expected, 1., delta=1e-3)

    def test_a_gap_turns_with_the_bodies(self):
        """A rotation of one body turns both, without strain, as if the gap were rigid."""
        gap, angle = .1, 1e-3
        for cells in ([4, 4, 4], [3, 6, 3]):
            scene = {**cantilever(cells, gap), "Responses": ["way", "strain"],
                     "Response way": {"Quantity": "displacement", "Face": "right.right",
                                      "Component": "y"},
                     "Response strain": {"Quantity": "strain energy"}}
            scene["Body right"].pop("Force")
            scene["Body left"] = block([0, 0, 0], [4, 4, 4], Displacement=(
                f"left: x = -{angle}*y, left: y = 0, left: z = 0"))
            with snug.Model.from_dict(scene, set={"Solver/Relative tolerance": 1e-11}) as model:
                result = model.evaluate()
            self.assertAlmostEqual(result["way"] / (angle * (2. + gap)), 1., delta=1e-9)
            self.assertLess(result["strain"], 1e-12 * MODULUS * angle ** 2)

    def test_uniform_tension(self):
        cells = [[4, 4, 2], [3, 5, 3], [5, 3, 2], [2, 6, 2]]
        for dim in (2, 3):
            strained = (1. - POISSON ** 2) if dim == 2 else 1.
            expected = -.5 * TENSION ** 2 / MODULUS * strained * 4.
            for degree in (1, 2):
                with self.subTest(dim=dim, degree=degree):
                    found = energy(stretched(dim, cells), **{"Element degree": degree})
                    self.assertAlmostEqual(found / expected, 1., delta=1e-11)

    def test_gradients(self):
        """Derivatives through a tie with a gap beside a contact with friction."""
        scene = {**cantilever([3, 2, 2], .05), "Bodies": ["left", "right", "floor"],
                 "Responses": ["peak", "lift"],
                 "Response peak": {"Quantity": "peak pressure"},
                 "Response lift": {"Quantity": "displacement", "Face": "right.right",
                                   "Component": "z"},
                 "Body floor": block([-1, -1, -1], [3, 3, 2], Supports="bottom: xyz",
                                     **{"Box size": [4, 3, 1]}),
                 "Shape": {"Basis": "formula modes", "Bounds": [-.1, .1],
                           "Modes": "0, 0, 0.1*x*z; 0.1*z*z, 0.2*z*x, 0.3*x*y"},
                 "Optimization": {"Objective": "potential energy"}}
        scene["Body left"] = block([0, 0, 0], [3, 3, 3])
        scene["Body right"]["Force"] = "right: 0 0.5 -20"
        scene["Contact"] = {"Pairs": "left.right: right.left, left.bottom: floor.top",
                            "Friction": "Coulomb", "Friction coefficient": "0.4"}
        scene["Pair left.right: right.left"] = {"Law": "tied"}
        scene["Body left"]["Pressure"] = "top: 60"
        with snug.Model.from_dict(scene, set={"Solver/Relative tolerance": 1e-11}) as model:
            assert_gradients(self, model, [.02, -.03], 1e-4)

    def test_ranks(self):
        with tempfile.TemporaryDirectory() as folder:
            known = None
            for ranks in (1, 3):
                with snug.Model.from_dict(stretched(2, [[4, 4], [3, 5], [5, 3], [2, 6]]), ranks=ranks,
                                          set={"Output directory": folder}) as model:
                    found = model.evaluate()["potential energy"]
                known = known or found
                self.assertAlmostEqual(found / known, 1., delta=1e-9)

    def test_contact_across_the_edge_of_a_tie(self):
        """A block presses on two tied bodies as on one, also where its nodes lie above their edge."""
        for dim, degree in ((2, 1), (2, 2), (3, 1)):
            top = block([.5, 0., 1.][:dim - 1] + [1.], [4] * dim, Pressure="top: 10", Supports=(
                "left: x" if dim == 2 else "left: x, front: y"))
            scene = {"Dimension": dim, "Bodies": ["a", "s"], "Body s": top,
                     "Body a": block([0.] * dim, [8] + [4] * (dim - 1), **{
                         "Box size": [2.] + [1.] * (dim - 1), "Supports": "foot: " + AXES[:dim],
                         "Boundary formulas": "foot: bottom & 1 - x"}),
                     "Contact": {"Pairs": "s.bottom: a.top"}}
            entries = {"Element degree": degree}
            expected = energy(scene, **entries)
            scene.update({"Bodies": ["a", "b", "s"],
                          "Body a": block([0.] * dim, [4] * dim, Supports="bottom: " + AXES[:dim]),
                          "Body b": block([1.] + [0.] * (dim - 1), [4] * dim),
                          "Contact": {"Pairs": "s.bottom: a.top, s.bottom: b.top, a.right: b.left"},
                          "Pair a.right: b.left": {"Law": "tied"}})
            self.assertAlmostEqual(energy(scene, **entries) / expected, 1., delta=1e-9)

    def test_supports_that_part_a_tie(self):
        scene = cantilever([3, 6, 3])
        scene["Body left"]["Displacement"] = "front: y = 0"
        scene["Body right"]["Displacement"] = "front: y = 0"
        self.assertLess(energy(scene), 0.)
        scene["Body right"]["Displacement"] = "front: y = 0.01"
        with self.assertRaisesRegex(snug.DesignFailed, "part the tied pair"):
            energy(scene)

    def test_wrong_models(self):
        tied = "Pair left.right: right.left"
        moved = {"Load cases": ["turned"],
                 "Load case turned": {"Position": "right: rotate z 3"}}
        for change, words in (({tied: {"Friction": "Coulomb", "Friction coefficient": "1"}},
                               "Friction"), ({tied: {"Gap": "0.1"}}, "Gap"),
                              ({tied: {"Interference": True}}, "Interference"),
                              (moved, "moves the bodies differently"),
                              ({"Contact": {"Pairs": "left.right: plane", "Law": "tied"},
                                "Obstacles": ["plane"], "Obstacle plane": {}}, "obstacle"),
                              ({"Responses": ["p"], "Response p": {"Quantity": "peak pressure",
                                                                   "Pair": "left.right: right.left"}},
                               "no contact")):
            with self.assertRaisesRegex(snug.InputError, words), tempfile.TemporaryDirectory() as folder:
                file = pathlib.Path(folder, "model.json")
                file.write_text(json.dumps({**cantilever([4, 4, 4]), **change}), encoding="utf-8")
                snug.Model(file).close()


if __name__ == "__main__":
    os.environ["SNUG"] = sys.argv[1]
    os.environ["PATH"] = os.pathsep.join([str(pathlib.Path(sys.argv[2]).parent), os.environ["PATH"]])
    unittest.main(argv=sys.argv[:1])
