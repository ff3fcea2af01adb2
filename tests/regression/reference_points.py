#!/usr/bin/python3
"""Reference points against prescribed displacements, turned frames and differences:
reference_points.py SNUG MPIEXEC."""

import json
import os
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "contrib/python/tests"))
from test_snug import snug  # noqa: E402, begins again with Debian's Python if need be

from differences import assert_gradients  # noqa: E402

TIGHT = {"Solver/Relative tolerance": 1e-11}


def names(dim):
    return ["x", "y", "z", "rx", "ry", "rz"] if dim == 3 else ["x", "y", "rz"]


def quantities(point, dim, *kinds):
    """Return subsections of responses: the components of quantities of a point."""
    result = {}
    for kind in kinds:
        turns = kind in ("rotation", "reaction moment")
        for c in ("xyz" if dim == 3 else "z" if turns else "xy"):
            result[f"Response {kind} {c}"] = {"Quantity": kind, "Reference point": point,
                                              "Component": c}
    return result


def with_responses(scene, responses):
    return {**scene, **responses, "Responses": [name[len("Response "):] for name in responses]}


def punch(dim, force=None, held=None, **point):
    """Return a block on a base, with friction, whose top follows a point beside its middle."""
    corner, size = [.25, .2][:dim - 1] + [1.], [.5, .6][:dim - 1] + [.4]
    scene = {"Dimension": dim, "Bodies": ["block", "base"], "Reference points": ["tool"],
             "Body block": {"Box corner": corner, "Box size": size, "Box cells": [3] * dim,
                            "Young's modulus": 1000},
             "Body base": {"Box cells": [4, 5, 3][:dim - 1] + [3], "Young's modulus": 1000,
                           "Supports": "bottom: " + "xyz"[:dim]},
             "Contact": {"Pairs": "block.bottom: base.top", "Friction": "Coulomb",
                         "Friction coefficient": "0.5"},
             "Reference point tool": {"Point": [.45, .4, 1.5] if dim == 3 else [.45, 1.5],
                                      "Faces": ["block.top"], **point}}
    if force is not None:
        scene["Reference point tool"].update(Force=force[:dim], Moment=force[dim:])
    if held is not None:
        scene["Reference point tool"]["Displacement"] = [
            f"{name} = {value!r}" for name, value in zip(names(dim), held)]
    return scene


FORCE = {2: [1., -20., .6], 3: [1., .5, -20., .4, -.6, .1]}


def evaluate(scene, ranks=1, design=None, gradients=False, **entries):
    with tempfile.TemporaryDirectory() as folder, snug.Model.from_dict(
            scene, set={**TIGHT, "Output directory": folder, **entries}, ranks=ranks) as model:
        return model.evaluate(design, gradients=gradients)


def numbers(result, kinds):
    return [value for name, value in result.values.items() if name.rsplit(" ", 1)[0] in kinds]


class ReferencePoints(unittest.TestCase):
    def assert_close(self, found, expected, tolerance):
        largest = max(abs(value) for value in expected)
        for a, b in zip(found, expected, strict=True):
            self.assertAlmostEqual(a, b, delta=tolerance * largest)

    def test_force_and_displacement(self):
        """The motion under a force needs this force as a reaction, from both ways of holding."""
        for dim in (2, 3):
            for degree in (1, 2):
                with self.subTest(dim=dim, degree=degree):
                    entries = {"Element degree": degree}
                    pushed = evaluate(with_responses(punch(dim, FORCE[dim]), quantities(
                        "tool", dim, "displacement", "rotation")), **entries)
                    motion = numbers(pushed, ("displacement", "rotation"))
                    held = with_responses(punch(dim, held=motion), quantities(
                        "tool", dim, "reaction", "reaction moment"))
                    reaction = numbers(evaluate(held, **entries), ("reaction", "reaction moment"))
                    self.assert_close(reaction, FORCE[dim], 1e-8)

    def test_a_face_with_the_same_displacement(self):
        """Formulas of the rigid motion on the face, without a reference point, give its state."""
        motion = [.002, -.001, -.02, .004, -.006, .003]
        scene = punch(3, held=motion)
        expected = evaluate(scene)["potential energy"]
        (ux, uy, uz, rx, ry, rz), (px, py, pz) = motion, scene["Reference point tool"]["Point"]
        x, y, z = f"(x-{px})", f"(y-{py})", f"(z-{pz})"
        scene["Body block"]["Displacement"] = ", ".join(
            f"top: {name} = {formula}" for name, formula in (
                ("x", f"{ux} + {ry}*{z} - {rz}*{y}"), ("y", f"{uy} + {rz}*{x} - {rx}*{z}"),
                ("z", f"{uz} + {rx}*{y} - {ry}*{x}")))
        del scene["Reference points"], scene["Reference point tool"]
        self.assertAlmostEqual(evaluate(scene)["potential energy"] / expected, 1., delta=1e-10)

    def test_an_obstacle(self):
        """A sphere under a force moves as far as that force needs, and balances it."""
        for dim in (2, 3):
            scene = {"Dimension": dim, "Bodies": ["base"], "Obstacles": ["ball"],
                     "Reference points": ["ram"],
                     "Body base": {"Box cells": [6] * dim, "Young's modulus": 1000,
                                   "Supports": "bottom: " + "xyz"[:dim]},
                     "Obstacle ball": {"Shape": "sphere", "Point": [.45, .55][:dim - 1] + [3.],
                                       "Radius": 2.},
                     "Contact": {"Pairs": "base.top: ball"}}
            up = "xyz"[dim - 1]
            others = [name for name in names(dim) if name != up]
            point = {"Point": [.3, .6][:dim - 1] + [3.], "Obstacles": ["ball"], "Supports": others}
            pushed = evaluate(with_responses(
                {**scene, "Reference point ram": {**point, "Force": [0.] * (dim - 1) + [-3.]}},
                {**quantities("ram", dim, "displacement"), "Response f": {
                    "Quantity": "contact force", "Component": up}}))
            self.assertAlmostEqual(abs(pushed["f"]), 3., delta=1e-9)
            scene["Obstacle ball"]["Displacement"] = [0.] * (dim - 1) + [
                pushed[f"displacement {up}"]]
            del scene["Reference points"]
            moved = evaluate(with_responses(scene, {"Response f": {
                "Quantity": "contact force", "Component": up}}))
            self.assertAlmostEqual(moved["f"] / pushed["f"], 1., delta=1e-8)

    def test_errors_of_an_obstacle(self):
        """The estimates are those of an obstacle with a displacement of its own."""
        errors = []
        for of_obstacle, of_point in (({"Displacement": [0., -.02]}, None),
                                      ({}, {"Obstacles": ["ball"], "Supports": ["x", "rz"],
                                            "Displacement": ["y = -0.02"]})):
            scene = {"Task": "state", "Dimension": 2, "Bodies": ["base"], "Obstacles": ["ball"],
                     "Body base": {"Box cells": [8, 8], "Young's modulus": 1000,
                                   "Supports": "bottom: xy"},
                     "Obstacle ball": {"Shape": "sphere", "Point": [.5, 3.], "Radius": 2.,
                                       **of_obstacle},
                     "Contact": {"Pairs": "base.top: ball"},
                     "Accuracy": {"Estimate": "responses"}}
            if of_point:
                scene.update({"Reference points": ["ram"], "Reference point ram": of_point})
            scene = with_responses(scene, {"Response force": {"Quantity": "contact force"},
                                           "Response peak": {"Quantity": "peak pressure"}})
            with tempfile.TemporaryDirectory() as folder:
                with snug.Model.from_dict(scene, set={"Output directory": folder}) as model:
                    model.write()
                summary = json.loads(pathlib.Path(folder, "summary.json").read_text("utf-8"))
            errors.append(summary["state"]["accuracy"]["responses"])
        self.assertEqual(set(errors[0]), set(errors[1]))
        for name, expected in errors[0].items():
            self.assertAlmostEqual(errors[1][name] / expected, 1., delta=1e-3, msg=name)

    def test_load_cases(self):
        """A load case with a force and one with the displacement that this force causes."""
        scene = with_responses(punch(2), {**quantities("tool", 2, "displacement", "rotation")})
        pushed = evaluate({**scene, "Reference point tool": {
            **scene["Reference point tool"], "Force": [1., -20.], "Moment": [.6]}})
        lift, turn = pushed["displacement y"], pushed["rotation z"]
        scene.update({"Load cases": ["push", "hold"],
                      "Load case push": {"Force": "tool: 1 -20", "Moment": "tool: 0.6"},
                      "Load case hold": {"Force": "tool: 1 0", "Displacement":
                                         f"tool: y = {lift!r}, tool: rz = {turn!r}"}})
        with snug.Model.from_dict(scene, set=TIGHT) as model:
            result = model.evaluate()
        for name, value in pushed.values.items():
            if name != "potential energy":
                for case in ("push", "hold"):
                    self.assertAlmostEqual(result[f"{case}.{name}"] / value, 1., delta=1e-8,
                                           msg=name)

    def test_ranks_and_subdomains(self):
        scene = with_responses(punch(3, FORCE[3]), quantities("tool", 3, "displacement", "rotation"))
        known = evaluate(scene)
        for ranks, subdomains in ((1, 9), (2, 8), (3, 12)):
            found = evaluate(scene, ranks=ranks, **{"Decomposition/Subdomains": subdomains})
            self.assert_close(found.values.values(), known.values.values(), 1e-9)

    def test_gradients(self):
        """Derivatives of motions and reactions of a face and an obstacle, with friction."""
        scene = punch(2, FORCE[2])
        scene.update({"Obstacles": ["ball"], "Reference points": ["tool", "ram"],
                      "Obstacle ball": {"Shape": "sphere", "Point": [.0, 1.5], "Radius": .5},
                      "Reference point ram": {"Point": [0., 1.6], "Obstacles": ["ball"],
                                              "Force": [.1, 0.], "Displacement": ["y = -0.01"]},
                      "Shape": {"Basis": "formula modes", "Bounds": [-.1, .1],
                                "Modes": "0, 0.1*x*y; 0.2*y*x, 0.3*x*x"},
                      "Optimization": {"Objective": "potential energy"}})
        scene["Reference point ram"]["Supports"] = ["rz"]
        scene["Contact"]["Pairs"] += ", base.top: ball"
        responses = quantities("tool", 2, "displacement", "rotation")
        responses.update({"Response push": {"Quantity": "reaction", "Reference point": "ram",
                                            "Component": "y"},
                          "Response turn": {"Quantity": "reaction moment", "Component": "z",
                                            "Reference point": "ram"},
                          "Response way": {"Quantity": "displacement", "Component": "x",
                                           "Reference point": "ram"}})
        with snug.Model.from_dict(with_responses(scene, responses), set=TIGHT) as model:
            assert_gradients(self, model, [.02, -.03], 1e-3)

    def test_nothing_holds_a_point(self):
        scene = punch(2, FORCE[2])
        scene["Contact"]["Friction"] = "none"
        del scene["Contact"]["Friction coefficient"]
        with self.assertRaisesRegex(snug.DesignFailed, "not held against its load along"):
            evaluate(scene)

    def test_wrong_models(self):
        tool, ball = "Reference point tool", {"Obstacles": ["ball"], "Obstacle ball": {
            "Shape": "sphere", "Point": [0., 3.]}}
        faces = {"Faces": ["block.top"]}
        for change, words in (
                ({tool: {}}, "at least one face"),
                ({tool: {"Faces": ["block.up"]}}, "not a boundary"),
                ({tool: {"Faces": ["blok.top"]}}, "no body 'blok'"),
                ({tool: {"Faces": ["block.top", "block.top"]}}, "only once"),
                ({tool: {**faces, "Obstacles": ["ball"]}}, "no obstacle 'ball'"),
                ({tool: {"Faces": ["base.bottom"]}}, "held by supports"),
                ({tool: {**faces, "Supports": ["z"]}}, "components are x, y, rz"),
                ({tool: {**faces, "Supports": ["x", "x"]}}, "held twice"),
                ({tool: {**faces, "Supports": ["x"], "Displacement": ["x = 1"]}}, "held twice"),
                ({tool: {**faces, "Displacement": ["x"]}}, "component = number"),
                ({tool: {**faces, "Displacement": ["x = y"]}}, "component = number"),
                ({tool: {**faces, "Force": [1., 2., 3.]}}, "2 numbers|2 components"),
                ({tool: {**faces, "Moment": [1., 2.]}}, "1 number"),
                ({tool: {**faces, "Point": [1., 2., 3.]}}, "2 "),
                ({"Reference points": ["tool", "other"], "Reference point other": faces},
                 "one point only"),
                ({"Reference points": ["tool", "tool"]}, "twice"),
                ({**ball, tool: {"Obstacles": ["ball"]}, "Obstacle ball": {
                    "Displacement": [0., 1.]}}, "follows 'tool'"),
                ({tool: {"Faces": ["block.bottom"]}, "Reference points": ["tool", "low"],
                  "Reference point low": {"Faces": ["base.top"]}}, "rigid"),
                ({"Contact": {"Pairs": "block.bottom: base.top", "Slave": "first"},
                  tool: {"Faces": ["block.bottom"]}}, "must be finer"),
                ({"Load cases": ["a"], "Load case a": {"Force": "tol: 0 1"}}, "body.boundary"),
                ({"Load cases": ["a"], "Load case a": {"Force": "tool: 0 1 2"}}, "2 components"),
                ({"Load cases": ["a"], "Load case a": {"Displacement": "tool: normal = 1"}},
                 "not a component"),
                ({"Load cases": ["a"], "Load case a": {"Pressure": "tool: 1"}}, "body.boundary"),
                ({"Load cases": ["a"], "Load case a": {"Position": "block: rotate z 3"}},
                 "must not move 'block'"),
                ({**ball, tool: {"Obstacles": ["ball"]}, "Load cases": ["a"], "Contact": {
                    "Pairs": "block.bottom: base.top, base.left: ball"},
                  "Load case a": {"Position": "base: rotate z 3"}}, "must not move 'base'"),
                ({**ball, "Reference points": ["tool", "ball"], "Reference point ball": {
                    "Obstacles": ["ball"]}}, "name of a body or an obstacle"),
                ({"Responses": ["r"], "Response r": {"Quantity": "displacement", "Component": "x",
                                                     "Reference point": "tol"}},
                 "no such reference point"),
                ({"Responses": ["r"], "Response r": {"Quantity": "rotation", "Component": "x",
                                                     "Reference point": "tool"}}, "not a rotation"),
                ({"Responses": ["r"], "Response r": {"Quantity": "reaction", "Component": "x",
                                                     "Reference point": "tool"}}, "no support"),
                ({"Responses": ["r"], "Response r": {
                    "Quantity": "displacement", "Component": "x", "Reference point": "tool",
                    "Face": "block.top"}}, "left out")):
            with self.subTest(words=words), self.assertRaisesRegex(snug.InputError, words), \
                    tempfile.TemporaryDirectory() as folder:
                file = pathlib.Path(folder, "model.json")
                file.write_text(json.dumps({**punch(2), **change}), encoding="utf-8")
                snug.Model(file).close()

    def test_supports_beside_a_face(self):
        """Nodes that supports hold must follow the point all the same."""
        scene = punch(3, held=[0., 0., -.01, 0., 0., 0.])
        scene["Body block"]["Supports"] = "left: x, front: y"
        evaluate(scene)
        scene["Reference point tool"]["Displacement"][0] = "x = 0.002"
        with self.assertRaisesRegex(snug.DesignFailed, "reference point 'tool'"):
            evaluate(scene)

    def test_two_tools_on_the_same_nodes(self):
        """Two planes at one place press like one of them with the sum of their forces."""
        def pressed(**forces):
            scene = {"Dimension": 2, "Bodies": ["pad"], "Obstacles": list(forces),
                     "Reference points": [f"of {name}" for name in forces],
                     "Body pad": {"Box size": [3, 1], "Box cells": [6, 2], "Young's modulus": 1000,
                                  "Supports": "bottom: xy"},
                     "Contact": {"Pairs": ", ".join(f"pad.top: {name}" for name in forces)}}
            for name, force in forces.items():
                scene[f"Obstacle {name}"] = {"Point": [0, 1], "Normal": [0, -1]}
                scene[f"Reference point of {name}"] = {"Point": [1.5, 2], "Obstacles": [name],
                                                       "Supports": ["x", "rz"], "Force": [0, -force]}
            return evaluate(scene)["potential energy"]
        self.assertAlmostEqual(pressed(a=1, b=2) / pressed(one=3), 1., delta=1e-8)


if __name__ == "__main__":
    os.environ["SNUG"] = sys.argv[1]
    os.environ["PATH"] = os.pathsep.join([str(pathlib.Path(sys.argv[2]).parent), os.environ["PATH"]])
    unittest.main(argv=sys.argv[:1])
