#!/usr/bin/python3
"""Pictures look at contact: face-on, where it is, and off the frame."""

import pathlib
import sys
import types
import unittest

PLOT = pathlib.Path(__file__).resolve().parents[2] / "contrib" / "plot"
sys.path.insert(0, str(PLOT.parent / "lib"))

try:
    import numpy as np
    import pressure
    plot = types.ModuleType("plot")
    plot.__file__ = str(PLOT)
    exec(compile(PLOT.read_text(encoding="utf-8"), str(PLOT), "exec"), plot.__dict__)
except (ImportError, SystemExit) as missing:
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

    def test_each_state_is_cut_at_its_own_peak(self):
        before, after, other = (eighth_of_a_sphere(loaded=loaded) for loaded in (.2, .1, .15))
        after.points = np.roll(after.points, 1, axis=1)  # its peak is at the pole of the x axis
        pairs = {0: [before, other], 1: [other, after]}
        original = plot.slave_sides
        plot.slave_sides = lambda states: pairs
        try:
            self.assertEqual(plot.loaded_sides([None, None]), [before, other])
            pairs[0] = [before, after]
            sides = plot.loaded_sides([None, None])
            grid = type("Grid", (), {"GetBounds": lambda self: [0., 1., 0., 1., 0., 1.]})()
            self.assertEqual([round(plot.place_of_cut(grid, side, 0), 9) for side in sides],
                             [0., 1.])
            pairs.clear()
            self.assertEqual(plot.loaded_sides([None, None]), [None, None])
        finally:
            plot.slave_sides = original

    def test_a_lower_last_state_has_its_own_scale_as_well(self):
        def scales(*peaks):
            return [peak for _, _, peak in plot.panels_of(
                ["before", "after"][:len(peaks)], list("ab"), list(peaks))]
        self.assertEqual(scales(10., 2.), [10., 10., 2.])
        self.assertEqual(scales(2., 10.), [10., 10.])
        self.assertEqual(scales(10.), [10.])


if __name__ == "__main__":
    unittest.main()
