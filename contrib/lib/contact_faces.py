"""Draw the pressure, the friction traction and the slip on every slave side."""

import collections
import copy

import numpy as np

from drawing import (Panel, compose, frame, mark, number_text, outline_window, paint, place_text,
                     proportions, scales, stretched_by, titles, write_beside)
from sections import cells_at, lists_of
from states import array_of, cells_of, joined, magnitude_of, points_of
from unrolled import bore_of
from views import AXES, Window, along_axis

# Status of friction in the array of that name.
STICK, SLIP = 2, 3

# An array of the contact faces: its picture, title, unit, and the dotted nodes.
Field = collections.namedtuple("Field", "array label unit picture title dots is_dotted")
FIELDS = [
    Field("pressure", "pressure", "stress", "contact-pressure.png",
          "contact pressure", "nodes in contact", lambda grid: array_of(grid, "active") > 0.5),
    Field("traction", "friction traction", "stress", "friction-traction.png",
          "magnitude of the friction traction", "nodes that stick",
          lambda grid: array_of(grid, "friction") == STICK),
    Field("slip", "slip", "length", "slip.png", "magnitude of the slip in the last load step",
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
        if self.flat:
            edge = self.points[self.faces[:, 1]] - self.points[self.faces[:, 0]]
            return int(np.argmin(np.abs(edge[:, :2]).sum(axis=0)))
        force = self.pressure[self.faces].sum(axis=1)
        weight = force if force.any() else np.ones(len(force))
        return int(np.argmax(weight @ np.abs(self.normals())))

    def normals(self):
        """Return the normals of 3D faces, with twice their areas as lengths."""
        first, second, third = (self.points[self.faces[:, k]] for k in range(3))
        return np.cross(second - first, third - first)

    def unrolled(self, bore):
        """Return the side in the plane of the angle and the place along the axis of a bore."""
        corners = self.points[self.faces]
        side, nodes = copy.copy(self), self.faces.ravel()
        side.points = np.stack([bore.of_faces(corners), corners[..., bore.axis],
                                0. * corners[..., 0]], axis=-1).reshape(-1, 3)
        side.nodes = np.arange(len(nodes))
        side.faces = side.nodes.reshape(self.faces.shape)
        side.values, side.pressure = self.values[nodes], self.pressure[nodes]
        side.dotted = np.flatnonzero(np.isin(nodes, self.dotted))
        return side

    def peaks(self):
        """Return where the pressure is largest, or as good as that."""
        high = self.values[self.nodes] >= 0.999 * self.peak()
        return self.points[self.nodes[high]]

    def window(self):
        """Return the Window of the faces with a loaded node, or of all if there are none. A row of
        nodes in contact is thus as wide as its faces."""
        loaded = np.unique(self.faces[(self.pressure[self.faces] > 0.).any(axis=1)])
        return Window(self.points[loaded if len(loaded) else self.nodes], self.normal())

    def curve(self, bore=None):
        """Return where to draw the two ends of the faces of a 2D side, and what the
        place is called: the angle about a bore, the coordinate along it, or its arc length where
        the side turns away from that by more than 45 degrees."""
        if bore:
            return bore.of_faces(self.points[self.faces]), bore.name
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


def along_flat(side, bore):
    """Return the Curve of a 2D side."""
    places, name = side.curve(bore)
    order = np.argsort(places.ravel(), kind="stable")
    nodes = side.faces.ravel()[order]
    return Curve(places.ravel()[order], side.values[nodes], name, side.pressure[nodes] > 0.)


def along_cut(side, field, axis, plane, pair, bore):
    """Return the Curve of a 3D side in a plane across an axis, along the other axis of the
    side, or over the angle about a bore."""
    cut = cells_at(side.grid, plane)
    used = np.unique(np.concatenate([*lists_of(cut.GetLines()), np.zeros(0, dtype=int)]))
    if len(used) == 0:
        return None
    used = used[np.abs(array_of(cut, "pair")[used] - pair) < 1e-6]
    along = next(k for k in range(3) if k not in (axis, side.normal()))
    name, places = AXES[along], points_of(cut)[:, along]
    if bore and axis == bore.axis:
        name, places = bore.name, bore.angles(points_of(cut))
    order = used[np.argsort(places[used], kind="stable")]
    return Curve(places[order], magnitude_of(cut, field.array)[order], name,
                 array_of(cut, "pressure")[order] > 0.)


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


def draw_contact(run, states, planes):
    """Draw the first and the last state into a picture for each of FIELDS that the states have.
    planes: (axis, place, vtkPlane) of the cuts of the states, None for flat bodies."""
    for field in FIELDS:
        if not any(side.GetPointData().HasArray(field.array)
                   for side in states[0].boundaries.values()):
            continue
        sides = slave_sides(states, field)
        if not sides:
            print(f"plot: no contact faces in '{run.directory}', no {field.picture}")
            continue
        groups = []
        loaded = max(sides, key=lambda pair: max(side.peak() for side in sides[pair]))
        for (pair, row), name in zip(sides.items(), names_of(run.summary, sides)):
            known = run.options.known if pair == loaded and field is FIELDS[0] else None
            groups += groups_of(run, field, pair, row, name, states, planes, known)
        dots = "" if all(row[0].flat for row in sides.values()) else f"; dots: {field.dots}"
        compose(f"{run.title}: {field.title}{dots}", groups, run.directory, field.picture)


def groups_of(run, field, pair, row, name, states, planes, known):
    """Return the panels of a pair: the faces of bodies in space, and the curves."""
    label = run.units.label(field.label, getattr(run.units, field.unit))
    bore, groups = bore_of(row), []
    if row[0].flat:
        curves = [along_flat(side, bore) for side in row]
    else:
        heads = [", ".join(filter(None, words)) for words in zip(len(row) * [name], titles(states))]
        ends = scales([side.peak() for side in row],
                      run.options.peak if field is FIELDS[0] else 0.)
        groups = [face_group(side, head, end, label, run, bore)
                  for side, head, end in zip(row, heads, ends)]
        curves = [along_cut(side, field, axis, plane, pair, bore)
                  for side, (axis, _, plane) in zip(row, planes)]
    if all(curve is not None and len(curve.places) for curve in curves):
        groups.append(curve_panels(curves, name, titles(states), label, run.units, known,
                                   None if row[0].flat else planes))
    return groups


def face_group(side, head, end, label, run, bore):
    """Return the panels of a 3D side: the whole and, where it is small, the contact."""
    peak, extent = side.highest(), np.ptp(side.points[side.nodes], axis=0).max()
    text = f"{head}\n× maximum {number_text(side.peak())} at {place_text(AXES, peak, extent)}"
    chosen, scale = run.options.view, 1.
    if bore and not chosen:
        side, view, scale = side.unrolled(bore), bore.view(), np.array([bore.arc(), 1.])
        text += f"\nunrolled about {AXES[bore.axis]} at radius {number_text(bore.radius)}"
    normal = side.normal()
    if not bore or chosen:
        view = chosen or along_axis(normal)
    places = view.project(side.points[side.nodes])
    whole = places.min(axis=0), places.max(axis=0)
    plane = [k for k in range(3) if k != normal]
    parts = [whole] + ([] if chosen else side.window().levels(plane, *whole))
    panels = []
    for level, part in enumerate(parts):
        ratio, stretch = proportions(*(corner * scale for corner in part), 4. if level else 10.)
        title = text.strip() if level == 0 else \
            "at the contact" if level == len(parts) - 1 else "around the contact"
        if view.names:
            title += stretched_by(view.names, stretch)
        outlined = (parts[level + 1], plane) if level + 1 < len(parts) else None
        fills = stretch != 1. or bool(bore)
        panels.append(Panel(ratio, title, lambda axis, part=part, outlined=outlined, fills=fills:
                            draw_face(axis, side, view, part, end, run.units, fills, outlined)))
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


def names_in(curves, heads, known):
    """Return the names in the legend of curves, none if there is one curve only."""
    return [head or "Snug" for head in heads] + ([known.name] if known else []) \
        if known or len(curves) > 1 else []


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
        axis, curves, heads, label, units, known), legend=names_in(curves, heads, known))]
    if len(curves) > 1 and 0. < peaks[-1] < 0.5 * max(peaks):
        panels.append(Panel(1.5, "after, on its own scale", lambda axis: draw_curves(
            axis, curves[-1:], heads[-1:], label, units, known, "C1"),
            legend=names_in(curves[-1:], heads[-1:], known)))
    return [panel._replace(ratio=1.5) for panel in panels] if len(panels) > 1 else panels


def draw_curves(axis, curves, heads, label, units, known, colour=None):
    low, high = limits_of(curves)
    margin = .04 * (high - low)
    axis.set_xlim(low - margin, high + margin)
    for number, (curve, head) in enumerate(zip(curves, heads)):
        of_curve = colour or f"C{number}"
        axis.plot(curve.places, curve.values, ".-", markersize=4, color=of_curve,
                  label=head or "Snug")
        top = np.argmax(curve.values)
        axis.plot(curve.places[top], curve.values[top], "x", color=of_curve, markersize=8.,
                  markeredgewidth=2.)
        write_beside(axis, (curve.places[top], curve.values[top]),
                     number_text(curve.values[top]), of_curve)
    largest = max(curve.values.max() for curve in curves)
    if known:
        axis.plot(known.places, known.values, "k--", linewidth=1.2, label=known.name)
        inside = known.values[(known.places >= low) & (known.places <= high)]
        largest = max(largest, min(inside.max(initial=0.), 1.3 * largest))
    axis.set_ylim(0., 1.18 * largest or 1.)
    axis.set_xlabel(units.place(curves[0].name))
    axis.set_ylabel(label)
    axis.grid(True, alpha=0.3)
