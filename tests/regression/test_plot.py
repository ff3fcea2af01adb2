#!/usr/bin/python3
"""Pictures look at contact: face-on, where it is, off the frame, and unrolled around bores."""

import os
import pathlib
import sys
import tempfile
import types
import unittest

try:
    import numpy as np
except ImportError:  # contrib/plot runs with Debian's Python and its packages, and so does its test
    if os.path.realpath(sys.executable) == os.path.realpath("/usr/bin/python3"):
        raise
    os.execv("/usr/bin/python3", ["/usr/bin/python3", *sys.argv])

PLOT = pathlib.Path(__file__).resolve().parents[2] / "contrib" / "plot"
sys.path.insert(0, str(PLOT.parent / "lib"))
plot = types.ModuleType("plot")
plot.__file__ = str(PLOT)
exec(compile(PLOT.read_text(encoding="utf-8"), str(PLOT), "exec"), plot.__dict__)

import contact_faces  # noqa: E402
import drawing  # noqa: E402
import obstacles  # noqa: E402
import parameters  # noqa: E402
import sections  # noqa: E402
import stress_picture  # noqa: E402
import unrolled  # noqa: E402
import views  # noqa: E402
from states import PlotError  # noqa: E402


def eighth_of_a_sphere(n=24, loaded=0.2):
    """Its side with a pressure around the pole of the z axis."""
    angles = np.linspace(0., np.pi / 2., n)
    polar, around = np.meshgrid(angles, angles, indexing="ij")
    side = contact_faces.Side.__new__(contact_faces.Side)
    side.points = np.stack([np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around),
                            np.cos(polar)], axis=-1).reshape(-1, 3)
    first = np.add.outer(n * np.arange(n - 1), np.arange(n - 1)).ravel()
    side.faces = np.stack([first, first + n, first + n + 1, first + 1], axis=1)
    side.nodes = np.arange(n * n)
    side.pressure = side.values = np.maximum(0., loaded - polar.ravel())
    side.flat = False
    return side


def strip(length=20., width=.2, n=21):
    """A side in the plane of x and z, loaded on a strip along x of a square."""
    x, z = np.meshgrid(np.linspace(0., length, n), np.linspace(-length, length, 2001),
                       indexing="ij")
    side = contact_faces.Side.__new__(contact_faces.Side)
    side.points = np.stack([x, 0. * x, z], axis=-1).reshape(-1, 3)
    first = np.add.outer(2001 * np.arange(n - 1), np.arange(2000)).ravel()
    side.faces = np.stack([first, first + 2001, first + 2002, first + 1], axis=1)
    side.nodes = np.arange(len(side.points))
    side.pressure = side.values = np.maximum(0., width / 2. + 1e-9 - np.abs(z.ravel()))
    side.flat = False
    return side


def side_of(points, faces, pressure):
    side = contact_faces.Side.__new__(contact_faces.Side)
    side.points, side.faces, side.nodes = points, faces, np.unique(faces)
    side.pressure = side.values = pressure
    side.dotted, side.flat = np.zeros(0, dtype=int), faces.shape[1] == 2
    return side


def ring(first, last, n=360, radius=3., loaded=180.):
    """A 2D side about (5, 1) between two angles [degrees], loaded up to an angle from x."""
    angles = np.linspace(first, last, n + 1)
    closed = last - first == 360.
    faces = np.stack([np.arange(n), (np.arange(n) + 1) % (n if closed else n + 1)], axis=1)
    angles = angles[:n] if closed else angles
    around = np.radians(angles)
    points = np.stack([5. + radius * np.cos(around), 1. + radius * np.sin(around), 0. * around], 1)
    return side_of(points, faces, np.maximum(0., loaded - np.abs(unrolled.wrapped(angles))))


def half_pipe(axis, n=90, radius=2., length=7.):
    """Half of a cylinder about an axis, loaded everywhere."""
    angles, places = np.meshgrid(np.radians(np.linspace(20., 200., n + 1)),
                                 np.linspace(1., 1. + length, 4), indexing="ij")
    points = np.zeros((*angles.shape, 3))
    points[..., (axis + 1) % 3] = radius * np.cos(angles)
    points[..., (axis + 2) % 3] = radius * np.sin(angles)
    points[..., axis] = places
    first = np.add.outer(4 * np.arange(n), np.arange(3)).ravel()
    faces = np.stack([first, first + 4, first + 5, first + 1], axis=1)
    return side_of(points.reshape(-1, 3), faces, np.ones(angles.size))


class Bores(unittest.TestCase):
    def test_arc_lengths_are_radius_times_angle(self):
        side = ring(-90., 90.)
        bore = unrolled.bore_of([side])
        places, name = side.curve(bore)
        self.assertEqual(name, "angle from x")
        self.assertAlmostEqual(bore.radius, 3.)
        self.assertTrue(np.all(np.diff(places[:, 0]) > 0.) and np.allclose(
            [places.min(), places.max()], [-90., 90.]))
        # chords of half a degree are shorter than their arcs by 3e-6
        arcs = bore.arc() * (places - places.min())
        self.assertTrue(np.allclose(arcs, side.arc_lengths(), rtol=1e-5, atol=1e-5))

    def test_no_face_is_torn_where_the_angle_begins(self):
        for loaded, ends in ((180., (-180., 180.)), (60., (-180., 180.)), (0., (0., 360.))):
            side = ring(0., 360., 120, loaded=loaded)
            places, _ = side.curve(unrolled.bore_of([side]))
            self.assertTrue(np.allclose(np.diff(places, axis=1), 3.))
            self.assertTrue(np.allclose([places.min(), places.max()], ends), places)

    def test_faces_keep_their_areas(self):
        for axis in range(3):
            side = half_pipe(axis)
            bore = unrolled.bore_of([side])
            self.assertEqual((bore.axis, stress_picture.cut_axis(side)), (axis, axis))
            flat = side.unrolled(bore)
            self.assertTrue(np.allclose(np.ptp(flat.points, axis=0), [180., 7., 0.]))
            # chords of two degrees are shorter than their arcs by 5e-5
            self.assertAlmostEqual(
                bore.arc() * np.linalg.norm(flat.normals(), axis=1).sum(),
                np.linalg.norm(side.normals(), axis=1).sum(), delta=1e-3 * 7. * 2. * np.pi)

    def test_other_faces_are_no_bores(self):
        for side in (eighth_of_a_sphere(), strip(), ring(0., 90., loaded=20.)):
            self.assertIsNone(unrolled.bore_of([side]))
        oval = ring(0., 360.)
        oval.points[:, 0] *= 1.2
        self.assertIsNone(unrolled.bore_of([oval]))
        self.assertIsNotNone(unrolled.bore_of([ring(0., 90., loaded=60.)]))


class Obstacles(unittest.TestCase):
    BEGIN = "set Dimension = {}\nset Obstacles = tool\nset Load cases = a, b\n"
    ENTRIES = {"Point": "1, 2, 3", "Normal": "0, 0, 1", "Axis": "0, 0, 1", "Radius": "2",
               "Formula": "", "Displacement": "0, 0, 0"}

    def tool(self, case="a", dim=3, **entries):
        """Return the obstacle of a parameters.prm with these entries."""
        text = self.BEGIN.format(dim) + "subsection Obstacle tool\n" + "".join(
            f"  set {name} = {value}\n" for name, value in {**self.ENTRIES, **entries}.items()) + (
                "end\nsubsection Load case b\n  set Position = tool: rotate z 90 about 1 0 0, "
                "shift 0 0 5\nend\n")
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "parameters.prm").write_text(text, encoding="utf-8")
            return obstacles.Obstacle(parameters.Parameters(folder), "tool", case)

    def test_levels_are_distances(self):
        point = np.array([[4., 6., 4.]])  # 3, 4, 1 from the point of the obstacle
        for shape, distance in (("plane", 1.), ("sphere", 26.**.5 - 2.), ("cylinder", 3.),
                                ("hollow sphere", 2. - 26.**.5), ("hollow cylinder", -3.)):
            self.assertAlmostEqual(self.tool(Shape=shape).level(point)[0], distance, msg=shape)
        self.assertAlmostEqual(self.tool(Shape="cylinder", Axis="2, 0, 0").level(point)[0],
                               17.**.5 - 2.)
        self.assertAlmostEqual(self.tool(Shape="plane", Displacement="0, 0, 3").level(point)[0], -2.)

    def test_formulas_are_the_same_shapes(self):
        points = np.random.default_rng(1).normal(size=(50, 3)) * 4.
        for axis in ("0, 0, 1", "0, 0, -1", "1, 2, -2"):
            expected = self.tool(Shape="cylinder", Axis=axis).level(points)
            formula = self.tool(Shape="formula", Axis=axis, Formula="sqrt(x^2 + y^2) - 2")
            self.assertTrue(np.allclose(formula.level(points), expected), axis)
        self.assertTrue(np.allclose(obstacles.evaluated("if(x > 1, 2*x, -1e-1) + pi", points),
                                    np.where(points[:, 0] > 1., 2. * points[:, 0], -.1) + np.pi))
        for formula in ("x.real", "open(x)", "x + w", "x ? 1 : 2", "x +"):
            with self.assertRaises(ValueError, msg=formula):
                obstacles.evaluated(formula, points)

    def test_obstacles_move_with_their_load_case(self):
        # (1 + a, b) turns to (1 - b, a)
        points = np.array([[4., 6., 4.], [0., -2., 1.]])
        moved = np.array([[1. - 6., 3., 9.], [1. + 2., -1., 6.]])
        for shape in ("plane", "sphere", "cylinder"):
            self.assertTrue(np.allclose(self.tool("b", Shape=shape).level(moved),
                                        self.tool("a", Shape=shape).level(points)), shape)

    def test_windows_have_room_where_the_obstacle_is(self):
        floor = self.tool(dim=2, Shape="plane", Point="0, 0", Normal="0, 1", Displacement="0, 0")
        low, high = obstacles.widened([floor], [0., 0.], [2., 1.], [0, 1], 0.)
        self.assertTrue(low[1] < -.1 and high[1] == 1.)


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
        whole = np.zeros(2), np.ones(2)
        (low, high), = eighth_of_a_sphere().window().levels([0, 1], *whole)
        self.assertTrue(np.allclose(low, 0., atol=1e-12))
        self.assertTrue(np.all((high > 0.2) & (high < 0.42)))
        for loaded in (0., 2.):  # nothing, or all of it
            side = eighth_of_a_sphere(loaded=loaded)
            self.assertEqual(side.window().levels([0, 1], *whole), [])
        # far away from it, there is a step in between
        levels = eighth_of_a_sphere().window().levels([0, 1], np.full(2, -100.), np.full(2, 100.))
        self.assertEqual(len(levels), 2)
        sizes = [np.max(high - low) for low, high in levels]
        self.assertTrue(200. > 4. * sizes[0] > 16. * sizes[1])

    def test_long_contacts_are_stretched(self):
        side = strip()
        self.assertEqual(side.normal(), 1)
        (low, high), = side.window().levels([0, 2], np.array([0., -20.]), np.array([20., 20.]))
        self.assertTrue(np.allclose([low[0], high[0]], [0., 20.]))
        self.assertTrue(0.2 < high[1] - low[1] < 0.6)
        ratio, stretch = drawing.proportions(low, high)
        self.assertTrue(ratio <= 4. and stretch > 10.)
        # the cut shows the length of the contact
        self.assertEqual(stress_picture.cut_axis(side), 2)

    def test_a_row_of_nodes_is_as_wide_as_its_faces(self):
        side = strip(width=0.)
        self.assertEqual(np.count_nonzero(side.pressure), 21)
        self.assertTrue(np.allclose(side.window().size, [20., .04, .04]))

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
            state = types.SimpleNamespace(bodies={"body": grid})
            self.assertEqual([round(plot.place_of_cut(state, side, 0), 9) for side in sides],
                             [0., 1.])
            pairs.clear()
            self.assertEqual(plot.loaded_sides([None, None]), [None, None])
        finally:
            plot.slave_sides = original

    def test_a_much_lower_state_has_its_own_scale(self):
        self.assertEqual(drawing.scales([10., 2.]), [10., 2.])
        self.assertEqual(drawing.scales([10., 9.]), [10., 10.])
        self.assertEqual(drawing.scales([10., 0.]), [10., 10.])  # nothing to show
        self.assertEqual(drawing.scales([10.]), [10.])
        self.assertEqual(drawing.scales([10., 2.], 20.), [20., 20.])

    def test_labels_name_the_units_of_the_summary(self):
        units = drawing.Units({"units": {"length": "mm", "force": "N", "stress": "MPa"}})
        self.assertEqual((units.place("x"), units.label("pressure", units.stress)),
                         ("x [mm]", "pressure [MPa]"))
        units = drawing.Units({})
        self.assertEqual((units.place("x"), units.label("pressure", units.stress)),
                         ("x", "pressure [force/length²]"))

    def test_known_answers_are_read_with_their_name(self):
        with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
            file.write("x,Hertz\n-1,0\n0,2.5\n1,0\n")
            file.flush()
            known = plot.read_known(file.name)
        self.assertEqual(known.name, "Hertz")
        self.assertTrue(np.allclose([known.places, known.values], [[-1., 0., 1.], [0., 2.5, 0.]]))

    def test_numbers_have_four_digits_and_no_exponent(self):
        self.assertEqual([drawing.number_text(value) for value in (17764., 1592.8, .0345678, 0.)],
                         ["17760", "1593", "0.03457", "0"])

    def test_panels_share_rows_while_they_are_high_enough(self):
        panel = drawing.Panel(1., "", None)
        self.assertEqual([len(row) for row in drawing.arrange([[panel], [panel]])], [2])
        wide = drawing.Panel(3., "", None)
        self.assertEqual([len(row) for row in drawing.arrange([[wide, wide], [wide]])], [1, 1, 1])
        for row in drawing.arrange(4 * [[panel, wide]]):
            self.assertLessEqual(sum(drawing.size_of(of_row, drawing.height_of(row))[0]
                                     for of_row in row), drawing.WIDTH + 1e-9)


class Views(unittest.TestCase):
    def test_views_are_orthonormal_and_right_handed(self):
        for text in ("x", "-x", "y", "-y", "z", "-z", "-60,25", "30, -90"):
            view = views.read_view(text)
            axes = np.array([view.right * (-1. if view.flipped else 1.), view.up, view.towards])
            self.assertTrue(np.allclose(axes @ axes.T, np.eye(3), atol=1e-12), text)
            self.assertAlmostEqual(np.linalg.det(axes), 1., msg=text)
        self.assertTrue(np.allclose(views.read_view("-90,0").towards, [0., -1., 0.]))

    def test_without_a_sign_coordinates_grow_to_the_right(self):
        for axis in range(3):
            self.assertFalse(views.along_axis(axis).flipped)

    def test_the_cut_is_seen_from_its_side(self):
        for axis in range(3):
            for sign in (-1., 1.):
                self.assertGreater(sign * views.oblique(axis, sign).towards[axis], .5)

    def test_wrong_options_give_one_line(self):
        here = str(PLOT.parent)
        for arguments in (["--view", "w", here], ["--view", "1", here], ["--view", "0,91", here],
                          ["--view", "nan,0", here], ["--view", "-60,25,3", here],
                          ["--cut", "y", here], ["--cut", "w=1", here], ["--cut", "y=a", here],
                          ["--cut", "y=inf", here], ["--cut", "", here], ["--peak", "0", here],
                          ["--peak", "-1", here], ["--peak", "big", here],
                          ["--known", "/nowhere", here], ["--known", str(PLOT), here], ["--cut"],
                          ["--known-shape", "/nowhere", here],
                          ["--vieww", "x", here], [here, here], [], [here + "/nowhere"]):
            with self.assertRaises(PlotError, msg=arguments) as caught:
                plot.read_options(arguments)
            self.assertEqual(len(str(caught.exception).splitlines()), 1)
        self.assertEqual(plot.read_options(["--cut", " z = -1e-3", here]).cut, (2, -1e-3))
        self.assertTrue(np.allclose(plot.read_options(["--view", "-90,0", here]).view.towards,
                                    [0., -1., 0.]))


class Sections(unittest.TestCase):
    def test_polygons_are_split_at_their_centres(self):
        points = np.array([[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.], [2., 0., 0.]])
        where, triangles, values = drawing.triangles_of(points, [[0, 1, 2, 3], [1, 4, 2]],
                                                        points[:, 0])
        self.assertTrue(np.allclose(where[:, 0], values))  # means of linear values are exact
        a, b, c = (where[triangles[:, k]] for k in range(3))
        self.assertAlmostEqual(np.cross(b - a, c - a)[:, 2].sum() / 2., 1.5)
        self.assertTrue(np.allclose(sections.area_vectors(points, [[0, 1, 2, 3], [1, 4, 2]]),
                                    [[0., 0., 1.], [0., 0., .5]]))

    def test_hanging_nodes_are_no_outline(self):
        points = np.array([[0., 0., 0.], [1., 0., 0.], [1., .5, 0.], [1., 1., 0.], [0., 1., 0.],
                           [2., 0., 0.], [2., .5, 0.], [2., 1., 0.]])
        lines = sections.outline(points, [[0, 1, 3, 4], [1, 5, 6, 2], [2, 6, 7, 3]])
        lengths = np.linalg.norm(lines[:, 1] - lines[:, 0], axis=1)
        self.assertAlmostEqual(lengths.sum(), 6.)


if __name__ == "__main__":
    unittest.main()
