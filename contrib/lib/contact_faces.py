"""Draw the pressure, the friction traction and the slip on every slave side."""

import collections
import json
import os

import matplotlib.pyplot as plt
import numpy as np

from drawing import add_scale, paint, panels, save, titles
from states import array_of, cells_of, points_of


# Status of friction in the array of that name.
STICK, SLIP = 2, 3

# An array of the contact faces: its picture, title, unit, and the dotted nodes.
Field = collections.namedtuple("Field", "array label unit picture title dots is_dotted")
FIELDS = [
    Field("pressure", "pressure", "scene's force / length²", "contact-pressure.png",
          "Contact pressure on the slave faces", "nodes in contact",
          lambda grid: array_of(grid, "active") > 0.5),
    Field("traction", "friction traction", "scene's force / length²", "friction-traction.png",
          "Magnitude of the friction traction on the slave faces", "nodes that stick",
          lambda grid: array_of(grid, "friction") == STICK),
    Field("slip", "slip", "scene's length", "slip.png",
          "Magnitude of the slip in the last load step on the slave faces", "nodes that slip",
          lambda grid: array_of(grid, "friction") == SLIP)]


class Side:
    """This class has the faces of one slave side at one state, with a field of FIELDS."""

    def __init__(self, grid, pair, field=FIELDS[0]):
        faces = cells_of(grid)
        number = array_of(grid, "pair")[faces[:, 0]]
        self.faces = faces[number == pair]
        self.nodes = np.unique(self.faces)
        self.points = points_of(grid)
        self.pressure = array_of(grid, "pressure")
        values = array_of(grid, field.array)
        self.values = values if values.ndim == 1 else np.linalg.norm(values, axis=1)
        self.dotted = self.nodes[field.is_dotted(grid)[self.nodes]]
        self.flat = self.faces.shape[1] == 2

    def peak(self):
        return self.values[self.nodes].max()

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

    def peaks(self):
        """Return where the pressure is largest, or as good as that."""
        high = self.values[self.nodes] >= 0.98 * self.peak()
        return self.points[self.nodes[high]]

    def curve(self):
        """Return where to draw the two ends of the faces of a 2D side, and what the
        place is called: the coordinate along it, or its arc length where the
        side turns away from that by more than 45 degrees."""
        along = 1 - self.normal()
        ends = self.points[self.faces]
        steps = ends[:, 1, :2] - ends[:, 0, :2]
        forward = steps[:, along] * np.sign(steps[:, along].sum())
        if np.all(forward > np.abs(steps[:, 1 - along])):
            return ends[:, :, along], f"{'xyz'[along]} (scene's length)"
        return self.arc_lengths(), "length along the face (scene's length)"

    def arc_lengths(self):
        """Return arc lengths of faces that are joined where their ends coincide, from a free end if any."""
        ends = np.round(self.points[self.faces] / np.ptp(
            self.points[self.nodes], axis=0).max(), 9)
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


def slave_sides(states, field=FIELDS[0]):
    """Return for every pair with a slave side of its own its side at all states."""
    pairs = np.unique(array_of(states[0][1], "pair"))
    return {int(pair): [Side(grid, pair, field) for _, grid in states]
            for pair in pairs if pair >= 0}


def names_of(directory, sides):
    """Return the names of the slave sides; a single one needs none."""
    if len(sides) == 1:
        return [""]
    with open(os.path.join(directory, "summary.json")) as file:
        pairs = json.load(file)["state"]["pairs"]
    return [pairs[pair]["name"].split(":")[0] for pair in sides]


def draw_contact(directory, states, peak):
    """Draw the first and the last state into a picture for each of FIELDS that the states have.
    Colours of pressures go up to the largest pressure, or to peak if that is larger."""
    for field in FIELDS:
        if not states[0][1].GetPointData().HasArray(field.array):
            continue
        sides = slave_sides(states, field)
        if not sides:
            print(f"plot: no contact faces in '{directory}', no {field.picture}")
            continue
        names = names_of(directory, sides)
        if next(iter(sides.values()))[0].flat:
            draw_curves(directory, states, list(sides.values()), names, field)
        else:
            draw_faces(directory, states, list(sides.values()), names, field,
                       peak if field is FIELDS[0] else 0.)


def window(row, plane):
    """Return the least and largest coordinates in a plane of the faces of a side or, where
    less than half of them is loaded, of that part and its surroundings."""
    places = np.concatenate([side.points[side.nodes] for side in row])[:, plane]
    loaded = np.concatenate([side.pressure[side.nodes] for side in row]) > 0.
    low, high = places.min(axis=0), places.max(axis=0)
    if loaded.any():
        first, last = (places[loaded].min(axis=0), places[loaded].max(axis=0))
        width = (last - first).max()
        if 0. < width < (high - low).max() / 2.:
            low = np.maximum(low, first - width / 2.)
            high = np.minimum(high, last + width / 2.)
    return low, high


def draw_faces(directory, states, sides, names, field, peak):
    peak = max(peak, *(side.peak() for row in sides for side in row))
    planes = [[k for k in range(3) if k != row[-1].normal()] for row in sides]
    windows = [window(row, plane) for row, plane in zip(sides, planes)]
    figure, axes = panels([(high - low)[1] / (high - low)[0]
                           for low, high in windows], len(states))
    for row, name, plane, (low, high), line in zip(sides, names, planes,
                                                   windows, axes):
        margin = 0.03 * (high - low)
        for side, title, axis in zip(row, titles(states), line):
            image = paint(axis, side.points[:, plane], side.faces.tolist(),
                          side.values, peak)
            axis.plot(*side.points[side.dotted][:, plane].T, ".",
                      color="white", markersize=1.5)
            axis.set_xlim(low[0] - margin[0], high[0] + margin[0])
            axis.set_ylim(low[1] - margin[1], high[1] + margin[1])
            axis.set_title(f"{name} {title}\nlargest {side.peak():.4g}"
                           .strip())
            axis.set_xlabel(f"{'xyz'[plane[0]]} (scene's length)")
        line[0].set_ylabel(f"{'xyz'[plane[1]]} (scene's length)")
    figure.suptitle(f"{field.title}; dots: {field.dots}")
    add_scale(figure, axes, image, field.label)
    save(figure, directory, field.picture)


def show_small_contact(axis, places, loaded):
    """Show a loaded part of less than a tenth of a side with its surroundings only."""
    width = np.ptp(loaded) if loaded else 0.
    if 0. < width < np.ptp(places) / 10.:
        axis.set_xlim(max(places.min(), min(loaded) - width),
                      min(places.max(), max(loaded) + width))


def draw_curves(directory, states, sides, names, field):
    figure, axes = plt.subplots(
        len(sides), 1, figsize=(8., 2. + 3. * len(sides)),
        layout="constrained", squeeze=False)
    for row, name, axis in zip(sides, names, axes[:, 0]):
        loaded = []
        for side, title in zip(row, titles(states)):
            places, label = side.curve()
            loaded += list(places[side.pressure[side.faces] > 0.])
            order = np.argsort(places.ravel(), kind="stable")
            axis.plot(places.ravel()[order],
                      side.values[side.faces.ravel()[order]], ".-",
                      markersize=3, label=title)
        axis.set_xlabel(label)
        axis.set_ylabel(f"{field.label}\n({field.unit})")
        # a uniform pressure is off the frame, too
        axis.set_ylim(0., 1.15 * max(side.peak() for side in row) or 1.)
        show_small_contact(axis, places, loaded)
        axis.set_title(name)
        axis.grid(True, alpha=0.3)
        if len(states) > 1:
            axis.legend()
    figure.suptitle(field.title)
    save(figure, directory, field.picture)
