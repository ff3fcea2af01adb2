"""Draw the pressure, the friction traction and the slip on every slave side."""

import collections

import numpy as np

from drawing import (Panel, compose, frame, mark, number_text, outline_window, paint, place_text,
                     proportions, scales, titles)
from sections import cells_at, lists_of
from states import array_of, cells_of, joined, magnitude_of, points_of
from views import AXES, Window, along_axis

# Status of friction in the array of that name.
STICK, SLIP = 2, 3

# An array of the contact faces: its picture, title, unit, and the dotted nodes.
Field = collections.namedtuple("Field", "array label unit picture title dots is_dotted")
FIELDS = [
    Field("pressure", "pressure", "stress", "contact-pressure.png",
          "Contact pressure", "nodes in contact", lambda grid: array_of(grid, "active") > 0.5),
    Field("traction", "friction traction", "stress", "friction-traction.png",
          "Magnitude of the friction traction", "nodes that stick",
          lambda grid: array_of(grid, "friction") == STICK),
    Field("slip", "slip", "length", "slip.png", "Magnitude of the slip in the last load step",
          "nodes that slip", lambda grid: array_of(grid, "friction") == SLIP)]


class Side:
    """This class has the faces of one slave side at one state, with a field of FIELDS."""

    def __init__(self, grid, pair, field=FIELDS[0]):
        faces = cells_of(grid)
        self.grid = grid
        self.faces = faces[array_of(grid, "pair")[faces[:, 0]] == pair]
        self.nodes = np.unique(self.faces)
        self.points = points_of(grid)
        self.pressure = array_of(grid, "pressure")
        self.values = magnitude_of(grid, field.array)
        self.dotted = self.nodes[field.is_dotted(grid)[self.nodes]]
        self.flat = self.faces.shape[1] == 2

    def peak(self):
        return self.values[self.nodes].max()

    def highest(self):
        """Return where the value is largest."""
        return self.points[self.nodes[np.argmax(self.values[self.nodes])]]

    def normal(self):
        """Return the coordinate axis closest to the normal, where a 3D face is loaded if it
        is: 0, 1 or 2."""
        edge = self.points[self.faces[:, 1]] - self.points[self.faces[:, 0]]
        if self.flat:
            return int(np.argmin(np.abs(edge[:, :2]).sum(axis=0)))
        normals = np.cross(edge, self.points[self.faces[:, 2]] -
                           self.points[self.faces[:, 0]])
        force = self.pressure[self.faces].sum(axis=1)
        weight = force if force.any() else np.ones(len(force))
        return int(np.argmax(weight @ np.abs(normals)))

    def direction(self):
        """Return whether the side looks along its normal() axis, 1, or against it, -1."""
        corners = self.points[self.faces]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        return 1. if normals[:, self.normal()].sum() >= 0. else -1.

    def peaks(self):
        """Return where the pressure is largest, or as good as that."""
        high = self.values[self.nodes] >= 0.999 * self.peak()
        return self.points[self.nodes[high]]

    def window(self):
        """Return the Window of the faces with a loaded node, or of all if there are none. A row of
        nodes in contact is thus as wide as its faces."""
        loaded = np.unique(self.faces[(self.pressure[self.faces] > 0.).any(axis=1)])
        return Window(self.points[loaded if len(loaded) else self.nodes], self.normal())

    def curve(self):
        """Return where to draw the two ends of the faces of a 2D side, and what the
        place is called: the coordinate along it, or its arc length where the
        side turns away from that by more than 45 degrees."""
        along = 1 - self.normal()
        ends = self.points[self.faces]
        steps = ends[:, 1, :2] - ends[:, 0, :2]
        forward = steps[:, along] * np.sign(steps[:, along].sum())
        if np.all(forward > np.abs(steps[:, 1 - along])):
            return ends[:, :, along], AXES[along]
        return self.arc_lengths(), "length along the face"

    def arc_lengths(self):
        """Return arc lengths of faces that are joined where their ends coincide, from a free end
        if any."""
        ends = np.round(self.points[self.faces] / np.ptp(
            self.points[self.nodes], axis=0).max(), 6)
        keys = [[tuple(end) for end in face] for face in ends]
        starts = {face[0]: i for i, face in enumerate(keys)}
        stops = {face[1] for face in keys}
        first = [i for i, face in enumerate(keys) if face[0] not in stops]
        result, length, left = np.zeros((len(keys), 2)), 0., set(
            range(len(keys)))
        for begin in first + list(range(len(keys))):
            face = begin
            while face in left:
                left.remove(face)
                step = np.linalg.norm(np.diff(
                    self.points[self.faces[face]], axis=0))
                result[face] = length, length + step
                length += step
                face = starts.get(keys[face][1])
        return result


# Places, values and the name of the places of one curve; loaded: where there is pressure.
Curve = collections.namedtuple("Curve", "places values name loaded")


def along_flat(side):
    """Return the Curve of a 2D side."""
    places, name = side.curve()
    order = np.argsort(places.ravel(), kind="stable")
    nodes = side.faces.ravel()[order]
    return Curve(places.ravel()[order], side.values[nodes], name, side.pressure[nodes] > 0.)


def along_cut(side, field, axis, plane, pair):
    """Return the Curve of a 3D side in a plane across an axis, along the other axis of the
    side."""
    cut = cells_at(side.grid, plane)
    used = np.unique(np.concatenate([*lists_of(cut.GetLines()), np.zeros(0, dtype=int)]))
    if len(used) == 0:
        return None
    used = used[np.abs(array_of(cut, "pair")[used] - pair) < 1e-6]
    along = next(k for k in range(3) if k not in (axis, side.normal()))
    order = used[np.argsort(points_of(cut)[used, along], kind="stable")]
    return Curve(points_of(cut)[order, along], magnitude_of(cut, field.array)[order],
                 AXES[along], array_of(cut, "pressure")[order] > 0.)


def slave_sides(states, field=FIELDS[0]):
    """Return for every pair with a slave side of its own its side at all states."""
    grids = [joined(state.boundaries.values()) for state in states]
    if grids[0].GetNumberOfCells() == 0:
        return {}
    pairs = np.unique(array_of(grids[0], "pair"))
    return {int(pair): [Side(grid, pair, field) for grid in grids] for pair in pairs if pair >= 0}


def names_of(summary, sides):
    """Return the names of the slave sides; a single one needs none."""
    if len(sides) == 1:
        return [""]
    pairs = summary["state"]["pairs"]
    return [pairs[pair]["name"].split(":")[0] for pair in sides]


def draw_contact(directory, states, summary, units, options, planes):
    """Draw the first and the last state into a picture for each of FIELDS that the states have.
    planes: (axis, place, vtkPlane) of the cuts of the states, None for flat bodies."""
    for field in FIELDS:
        if not any(side.GetPointData().HasArray(field.array)
                   for side in states[0].boundaries.values()):
            continue
        sides = slave_sides(states, field)
        if not sides:
            print(f"plot: no contact faces in '{directory}', no {field.picture}")
            continue
        label = units.label(field.label, getattr(units, field.unit))
        groups = []
        loaded = max(sides, key=lambda pair: max(side.peak() for side in sides[pair]))
        for (pair, row), name in zip(sides.items(), names_of(summary, sides)):
            heads = [", ".join(filter(None, words)) for words in
                     zip(len(states) * [name], titles(states))]
            if row[0].flat:
                curves = [along_flat(side) for side in row]
            else:
                groups += face_groups(row, heads, field, label, units, options)
                curves = [along_cut(side, field, axis, plane, pair)
                          for side, (axis, _, plane) in zip(row, planes)]
            known = options.known if pair == loaded and field is FIELDS[0] else None
            if all(curve is not None and len(curve.places) for curve in curves):
                groups.append(curve_panels(curves, name, titles(states), label, units, known,
                                           None if row[0].flat else planes))
        dots = "" if row[0].flat else f"; dots: {field.dots}"
        compose(field.title + dots, groups, directory, field.picture)


def face_groups(row, heads, field, label, units, options):
    """Return the panels of a 3D side: of each state the whole and, where it is small, the
    contact."""
    ends = scales([side.peak() for side in row],
                  options.peak if field is FIELDS[0] else 0.)
    return [face_group(side, head, end, label, units, options.view)
            for side, head, end in zip(row, heads, ends)]


def face_group(side, head, end, label, units, chosen):
    normal = side.normal()
    view = chosen or along_axis(normal)
    places = view.project(side.points[side.nodes])
    whole = places.min(axis=0), places.max(axis=0)
    plane = [k for k in range(3) if k != normal]
    parts = [whole] + ([] if chosen else side.window().levels(plane, *whole))
    text = f"× maximum {number_text(side.peak())} at " + place_text(
        AXES, side.highest(), np.ptp(side.points[side.nodes], axis=0).max())
    panels = []
    for level, part in enumerate(parts):
        ratio, stretch = proportions(*part, 4. if level else 10.)
        title = f"{head}\n{text}".strip() if level == 0 else \
            "at the contact" if level == len(parts) - 1 else "around the contact"
        if abs(stretch - 1.) > .05:
            title += f", stretched {max(stretch, 1. / stretch):.3g} times"
        outlined = (parts[level + 1], plane) if level + 1 < len(parts) else None
        panels.append(Panel(
            ratio, title, lambda axis, part=part, stretch=stretch, outlined=outlined: draw_face(
                axis, side, view, part, end, units, stretch != 1., outlined)))
    panels[-1] = panels[-1]._replace(scale=label)
    return panels


def draw_face(axis, side, view, part, end, units, stretched, outlined):
    """Draw a part of a side, with dots, or with the outline of a (window, plane)."""
    image = paint(axis, view, side.points, side.faces, side.values, (0., end))
    frame(axis, view, *part, units, stretched)
    if outlined:
        outline_window(axis, view, *outlined, side.highest()[side.normal()])
    else:
        axis.plot(*view.project(side.points[side.dotted]).T, ".", color="white", markersize=2.)
    mark(axis, view.project(side.highest()))
    return image


def limits_of(curves):
    """Return the part of the places to show: all, or the loaded part and its surroundings if it
    is less than half of them."""
    places = np.concatenate([curve.places for curve in curves])
    loaded = places[np.concatenate([curve.loaded for curve in curves])]
    low, high = places.min(), places.max()
    if len(loaded) and 0. < np.ptp(loaded) < (high - low) / 2.:
        width = np.ptp(loaded) / 2.
        low, high = max(low, loaded.min() - width), min(high, loaded.max() + width)
    return low, high


def curve_panels(curves, name, heads, label, units, known, planes):
    """Return the panels of the curves of all states; a last state that is much lower has another
    one of its own."""
    cuts = [f"{AXES[axis]} = {round(place, 12) + 0.:.4g}" for axis, place, _ in planes or []]
    if len(set(cuts)) > 1:
        cuts = [f"{when} at {cut}" for when, cut in zip(("before", "after"), cuts)]
    title = ", ".join(filter(None, (name, *dict.fromkeys(cuts))))
    peaks = [curve.values.max() for curve in curves]
    panels = [Panel(1.5 if planes else 2., title, lambda axis: draw_curves(
        axis, curves, heads, label, units, known))]
    if len(curves) > 1 and 0. < peaks[-1] < 0.5 * max(peaks):
        panels.append(Panel(2.2, "after, on its own scale", lambda axis: draw_curves(
            axis, curves[-1:], heads[-1:], label, units, known, "C1")))
    return [panel._replace(ratio=1.5) for panel in panels] if len(panels) > 1 else panels


def draw_curves(axis, curves, heads, label, units, known, colour=None):
    low, high = limits_of(curves)
    has_legend = known or any(heads)
    for number, (curve, head) in enumerate(zip(curves, heads)):
        of_curve = colour or f"C{number}"
        axis.plot(curve.places, curve.values, ".-", markersize=4, color=of_curve,
                  label=head or "Snug")
        top = np.argmax(curve.values)
        axis.plot(curve.places[top], curve.values[top], "x", color=of_curve, markersize=8.,
                  markeredgewidth=2.)
        axis.annotate(number_text(curve.values[top]), (curve.places[top], curve.values[top]), (0., 6.),
                      textcoords="offset points", color=of_curve, ha="center")
    margin = .04 * (high - low)
    axis.set_xlim(low - margin, high + margin)
    largest = max(curve.values.max() for curve in curves)
    if known:
        axis.plot(known.places, known.values, "k--", linewidth=1.2, label=known.name)
        inside = known.values[(known.places >= low) & (known.places <= high)]
        largest = max(largest, min(inside.max(initial=0.), 1.3 * largest))
    axis.set_ylim(0., (1.35 if has_legend else 1.18) * largest or 1.)
    axis.set_xlabel(units.place(curves[0].name))
    axis.set_ylabel(label)
    axis.grid(True, alpha=0.3)
    if has_legend:
        axis.legend(ncols=2, loc="upper right")
