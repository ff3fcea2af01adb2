"""Draw the shaped faces in the reference geometry and in the design, and the change between them,
from profile.csv."""

import csv
import os

import numpy as np
from matplotlib.tri import LinearTriInterpolator, Triangulation

from drawing import (CHANGES, COLOURS, Panel, compose, frame, number_text, proportions, scales,
                     stretched_by)
from states import PlotError, existing
from unrolled import fitted
from views import AXES, along_axis

# A piece has a drop to draw if no normal is inclined by more than 60 degrees to their mean.
LEAST_COSINE = 0.5
TITLES = "before", "after"


class Piece:
    """This class has the rows of one connected piece of a shaped face."""

    def __init__(self, rows):
        def column(name):
            return np.array([float(row[name] or "nan") for row in rows])

        axes = [axis for axis in AXES if axis in rows[0]]
        self.name = rows[0]["face"]
        self.points = np.transpose([column("reference_" + axis) for axis in axes])
        self.move, self.drops = column("move"), [column("reference_drop"), column("drop")]
        self.arc_length = column("arc_length") if "arc_length" in rows[0] else None
        normals = np.transpose([column("normal_" + axis) for axis in axes])
        mean = normals.mean(axis=0)
        self.is_flat = np.min(normals @ mean) > LEAST_COSINE * np.linalg.norm(mean) and \
            bool(np.all(np.isfinite(self.drops)))
        self.normal = int(np.argmax(np.abs(mean)))
        self.bore = None if self.is_flat else self.fitted_bore(normals)

    def has_moved(self):
        return np.abs(self.move).max() > 1e-12 * np.ptp(self.points, axis=0).max()

    def fitted_bore(self, normals):
        """Return the Bore that the piece is, with its points in three dimensions, or None."""
        if self.arc_length is not None:
            self.points = np.pad(self.points, ((0, 0), (0, 1)))
        bore = fitted(self.points, normals if self.arc_length is None else None)
        if bore:
            bore.place(self.points, np.zeros(len(self.points)))
        return bore


def read_pieces(path):
    rows = {}
    try:
        with open(path, newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                rows.setdefault(int(row["piece"]), []).append(row)
        return [Piece(of_piece) for of_piece in rows.values()]
    except (KeyError, TypeError, ValueError):
        raise PlotError(f"file '{path}' is damaged") from None


def draw_heights(axis, places, drops, place, units, known):
    for drop, head in zip(drops, TITLES):
        axis.plot(places, -drop, ".-", markersize=3, label=head)
    if known:
        axis.plot(known.places, known.values, "k--", linewidth=1.2, label=known.name)
        axis.set_xlim(places.min(), places.max())
    finish(axis, place, units.label("height", units.length))


def draw_change(axis, places, change, place, label):
    axis.axhline(0., color="grey", linewidth=.8)
    axis.plot(places, change, ".-", markersize=3, color="C2")
    finish(axis, place, label)


def finish(axis, place, label):
    axis.set_xlabel(place)
    axis.set_ylabel(label)
    axis.grid(True, alpha=0.3)


def heights_panel(name, places, place, drops, units, known):
    return Panel(1.4, f"{name}, height against the highest point",
                 lambda axis: draw_heights(axis, places, drops, place, units, known),
                 legend=TITLES + ((known.name,) if known else ()))


def curve_group(piece, units, known):
    """Return the panels of a 2D piece: the heights of both shapes, unless the piece turns too far,
    and the change, which of a bore is over the angle."""
    place, change = units.place("length along the face"), units.label("change", units.length)
    places, move = piece.arc_length, piece.move
    if piece.bore:
        places, place = piece.bore.angles(piece.points), units.place(piece.bore.name)
        order = np.argsort(places, kind="stable")
        places, move = places[order], move[order]
    panels = [heights_panel(piece.name, places, place, piece.drops, units, known)] \
        if piece.is_flat else []
    return panels + [Panel(1.4 if panels else 2., f"{piece.name}, change along the normal",
                           lambda axis: draw_change(axis, places, move, place, change))]


def draw_map(axis, view, places, values, ends, colours, units, stretched):
    first, last = ends
    image = axis.tripcolor(Triangulation(*places.T), values, shading="gouraud", cmap=colours,
                           vmin=first, vmax=last if last > first else first + 1.)
    frame(axis, view, places.min(axis=0), places.max(axis=0), units, stretched)
    return image


def change_text(move):
    return f"change along the normal\nfrom {number_text(move.min())} to {number_text(move.max())}"


def change_panel(piece, units):
    """Return the map of the change of a bore, unrolled over the angle."""
    bore = piece.bore
    view = bore.view()
    places = np.column_stack([bore.angles(piece.points), piece.points[:, bore.axis]])
    ratio, stretch = proportions(*(corner * [bore.arc(), 1.] for corner in
                                   (places.min(axis=0), places.max(axis=0))))
    title = f"{piece.name}, {change_text(piece.move)}" + stretched_by(view.names, stretch)
    bound = np.abs(piece.move).max()
    return Panel(ratio, title, lambda axis: draw_map(
        axis, view, places, piece.move, (-bound, bound), CHANGES, units, True),
        units.label("change", units.length))


def map_panels(piece, units):
    """Return the maps of both shapes and of the change, seen along the mean normal."""
    view = along_axis(piece.normal)
    places = view.project(piece.points)
    low, high = places.min(axis=0), places.max(axis=0)
    ratio, stretch = proportions(low, high)
    depth, change = units.label("depth", units.length), units.label("change", units.length)
    bound = np.abs(piece.move).max()
    ends = scales([drop.max() for drop in piece.drops])
    drawn = [(f"{piece.name}, {head}\nup to {number_text(drop.max())} below the highest point", drop,
              (0., end), COLOURS, depth)
             for drop, head, end in zip(piece.drops, TITLES, ends)]
    drawn.append((change_text(piece.move), piece.move, (-bound, bound), CHANGES, change))
    return [Panel(ratio, title + stretched_by(view.names, stretch),
                  lambda axis, values=values, of=of, colours=colours: draw_map(
                      axis, view, places, values, of, colours, units, stretch != 1.), label)
            for title, values, of, colours, label in drawn]


def middle_panel(piece, units, known):
    """Return the panel of the heights along the longer direction of a 3D piece, in its middle, or
    through the highest point if it is not flat before."""
    view = along_axis(piece.normal)
    places = view.project(piece.points)
    low, high = places.min(axis=0), places.max(axis=0)
    along = int(np.argmax(high - low))
    bent = np.ptp(piece.drops[0]) > 1e-6 * np.ptp(places, axis=0).max()
    through = places[np.argmin(piece.drops[0])] if bent else (low + high) / 2.
    line = np.tile(through, (101, 1))
    line[:, along] = np.linspace(low[along], high[along], 101)
    mesh = Triangulation(places[:, 0], places[:, 1])
    drops = [LinearTriInterpolator(mesh, drop)(line[:, 0], line[:, 1]) for drop in piece.drops]
    name = f"{piece.name}, {view.names[1 - along]} = {line[0, 1 - along]:.4g}"
    return heights_panel(name, line[:, along], units.place(view.names[along]), drops, units, known)


def draw_profile(directory, model, units, known):
    """Draw shape.png; faces that do not move, and those of 3D bodies that turn too far and are no
    bores, are left out."""
    groups = []
    pieces = read_pieces(existing(os.path.join(directory, "profile.csv")))
    for piece in [piece for piece in pieces if piece.has_moved()] or pieces:
        if piece.arc_length is not None:
            groups.append(curve_group(piece, units, known))
        elif piece.bore:
            groups.append([change_panel(piece, units)])
        elif piece.is_flat:
            maps = map_panels(piece, units)
            groups += [maps[:2], [maps[2], middle_panel(piece, units, known)]]
    if groups:
        compose(f"{model}: shaped faces without load, before and after the optimization", groups,
                directory, "shape.png")
