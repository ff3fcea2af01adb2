#!/usr/bin/env python3
"""The program gmsh reads profile.step, and its points lie on the design: step_profile.py SNUG. Its
text names the unit of the scene.

The tread of prm/step-roller.prm on a coarse mesh has control points at given heights. The design is
evaluated without Snug, from control-points.csv."""

import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "contrib" / "lib"))

from step_profile import Crown, face_names, step_nodes, step_points, step_text, step_unit, step_volume  # noqa: E402

COARSE = ["Task=sensitivity", "Gradient/Compare=false", "Body rim/Element size=8",
          "Body rim/Face sizes=tread: 4", "Body rim/Local refinements=0",
          "Shape/Initial=0, -0.003, -0.011, -0.025, -0.044, -0.068, -0.087, -0.098"]


def run(scene, settings, output, ranks=1):
    words = [SNUG, ROOT / scene, "--output", output,
             *(word for one in settings for word in ("--set", one))]
    if ranks > 1:
        words = [MPIEXEC, "-n", str(ranks), *words]
    done = subprocess.run(words, capture_output=True, text=True, check=False, timeout=120)
    if done.returncode != 0:
        raise AssertionError(done.stderr)
    return done.stdout


def summary(output):
    return json.loads((pathlib.Path(output) / "summary.json").read_text(encoding="utf-8"))


class Profile(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.output = pathlib.Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def test_points_of_the_file_lie_on_the_design(self):
        log = run("prm/step-roller.prm", COARSE, self.output)
        step = self.output / "profile.step"
        self.assertEqual(face_names(step), ["rim.tread"])
        written, = summary(self.output)["profile"]
        self.assertLessEqual(written["deviation"], written["asked"])
        # The crown is constant around the axis: a curve that is revolved.
        self.assertIn("profile.step: face rim.tread, revolved B-spline", log)
        self.assertEqual(written["kind"], "revolved curve")
        self.assertLess(len(written["spans"]), 2)
        self.assertIn("SURFACE_OF_REVOLUTION", step_text(step))
        crown = Crown(self.output, 50, -50, 14)
        nodes = step_nodes(step, 1)
        self.assertGreater(len(nodes), 200)
        # The design is that of the samples, whose polynomials of degree 4 deviate from the splines
        # by less than 1e-5 mm on cells of 3 mm.
        self.assertLess(crown.deviation(nodes), 2 * written["asked"] + 1e-5)
        # The border of the tread: its width, and 0.28 radian of the moved circle.
        self.assertAlmostEqual(max(x for x, _, _ in nodes), 14, places=4)
        self.assertAlmostEqual(min(x for x, _, _ in nodes), 0, places=4)

    def test_ranks_write_the_same_face(self):
        faces = []
        for ranks in (1, 2):
            run("prm/step-roller.prm", [*COARSE, "Output/Profile deviation=1e-4"], self.output, ranks)
            faces.append(summary(self.output)["profile"])
        self.assertEqual(faces[0][0]["spans"], faces[1][0]["spans"])
        self.assertLessEqual(faces[0][0]["deviation"], faces[0][0]["asked"])
        self.assertAlmostEqual(faces[0][0]["asked"], faces[1][0]["asked"], places=12)

    def test_the_solid_has_the_moved_faces(self):
        log = run("prm/step-roller.prm", [*COARSE, "Shape/Face=rim.tread + rim.shoulder"], self.output)
        step = self.output / "rim.step"
        self.assertIn("rim.step: solid of 7 faces, 2 of them moved", log)
        self.assertEqual(face_names(step), ["rim." + name for name in (
            "bore", "side", "shoulder", "tread", "left", "front", "cut")])
        asked = max(face["asked"] for face in summary(self.output)["profile"])
        crown = Crown(self.output, 50, -50, 20)
        # Points of the file within the borders of the moved faces.
        nodes = [(x, y, z) for x, y, z in step_nodes(step, 1) if math.hypot(y, z + 50) > 49.5 and
                 0.1 < x < 19.9 and 0.01 < math.atan2(y, z + 50) < 0.27]
        self.assertGreater(len(nodes), 200)
        self.assertLess(crown.deviation(nodes), 2 * asked + 1e-5)
        n = 2000
        section = sum(((50 + crown.height(20 * (k + 0.5) / n))**2 - 36**2) / 2 * 20 / n
                      for k in range(n))
        area = 0.28 * 50 * 20
        self.assertAlmostEqual(step_volume(step), 0.28 * section, delta=(2 * asked + 1e-5) * area)

    def test_a_face_beside_a_held_edge_stays(self):
        # The shoulder continues the cylinder of the tread, whose edge does not move.
        held = "Shape/Initial=-0.03, -0.02, -0.01, -0.005, 0, 0, 0, 0"
        log = run("prm/step-roller.prm", [*COARSE, held], self.output)
        self.assertIn("rim.step: solid of 7 faces, 1 of them moved", log)
        crown = Crown(self.output, 50, -50, 14)
        section = sum(((50 + crown.height(14 * (k + 0.5) / 2000))**2 - 36**2) / 2 * 14 / 2000
                      for k in range(2000)) + 6 * (50**2 - 36**2) / 2
        asked = summary(self.output)["profile"][0]["asked"]
        self.assertAlmostEqual(step_volume(self.output / "rim.step"), 0.28 * section,
                               delta=(2 * asked + 1e-5) * 0.28 * 50 * 14)

    def test_a_face_beside_a_moved_edge_prevents_the_solid(self):
        log = run("prm/step-roller.prm", COARSE, self.output)
        self.assertIn("rim.step is not written: the design moves an edge off the face rim.shoulder", log)
        self.assertFalse((self.output / "rim.step").exists())

    def test_sections_are_swept(self):
        scene = "tests/scenes/ground-profile.prm"
        step = self.output / "profile.step"
        for unit, size in (("mm", 1.), ("m", 1e3), ("in", 25.4), ("um", 1e-3)):
            run(scene, ["Task=sensitivity", "Gradient/Compare=false", "Thickness=0.5", f"Units={unit}, N"],
                self.output)
            self.assertEqual(step_unit(step), size)
            # Control points of x, and both ends of z, in the unit of the scene
            points = step_points(step)
            self.assertEqual([max(x[axis] for x in points) for axis in (0, 2)], [1, 0.5])
            nodes = step_nodes(step, 0.2 * size)
            for axis, lower, upper in ((0, 0, 1), (1, 1, 1), (2, 0, 0.5)):
                self.assertAlmostEqual(min(x[axis] for x in nodes) / size, lower, places=7)
                self.assertAlmostEqual(max(x[axis] for x in nodes) / size, upper, places=7)
        run(scene, ["Task=sensitivity", "Output/Profile deviation=0"], self.output)
        self.assertFalse(step.exists())


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("snug")
    parser.add_argument("--mpiexec", default="mpiexec")
    arguments = parser.parse_args()
    SNUG, MPIEXEC = arguments.snug, arguments.mpiexec
    unittest.main(argv=[sys.argv[0]])
