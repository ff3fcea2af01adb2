#!/usr/bin/python3
"""Pictures look at contact: face-on, where it is, and off the frame."""

import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "contrib" / "lib"))

try:
    import numpy as np
    import pressure
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(0)


def eighth_of_a_sphere(n=24, loaded=0.2):
    """Its side with a pressure around the pole of the z axis."""
    angles = np.linspace(0., np.pi / 2., n)
    polar, around = np.meshgrid(angles, angles, indexing="ij")
    side = pressure.Side.__new__(pressure.Side)
    side.points = np.stack([np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around),
                            np.cos(polar)], axis=-1).reshape(-1, 3)
    first = np.add.outer(n * np.arange(n - 1), np.arange(n - 1)).ravel()
    side.faces = np.stack([first, first + n, first + n + 1, first + 1], axis=1)
    side.nodes = np.arange(n * n)
    side.pressure = np.maximum(0., loaded - polar.ravel())
    side.flat = False
    return side


class Plot(unittest.TestCase):
    def test_faces_are_seen_face_on(self):
        for turn in range(3):
            side = eighth_of_a_sphere()
            side.points = np.roll(side.points, turn, axis=1)
            self.assertEqual(side.normal(), (2 + turn) % 3)

    def test_a_side_without_pressure_has_a_normal(self):
        side = eighth_of_a_sphere(loaded=0.)
        side.points[:, 2] *= 1e-3
        self.assertEqual(side.normal(), 2)

    def test_the_window_shows_the_contact(self):
        low, high = pressure.window([eighth_of_a_sphere()], [0, 1])
        self.assertTrue(np.allclose(low, 0., atol=1e-12))
        self.assertTrue(np.all((high > 0.2) & (high < 0.4)))
        for loaded in (0., 2.):  # nothing, or all of it
            low, high = pressure.window([eighth_of_a_sphere(loaded=loaded)], [0, 1])
            self.assertTrue(np.allclose(high, 1.))

    def test_the_cut_goes_through_the_peak(self):
        self.assertTrue(np.allclose(eighth_of_a_sphere().peaks(), [0., 0., 1.], atol=1e-12))


if __name__ == "__main__":
    unittest.main()
