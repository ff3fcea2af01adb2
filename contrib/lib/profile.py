"""Draw the shaped faces in the reference geometry and in the design, from profile.csv."""

import csv
import os

import matplotlib.pyplot as plt
from matplotlib.ticker import MaxNLocator
import numpy as np

from drawing import COLOURS, panels, save
from states import PlotError, existing

# A piece has a drop to draw if no normal is inclined by more than 60 degrees to their mean.
LEAST_COSINE = 0.5
TITLES = "reference", "design"


class Piece:
    """This class has the rows of one connected piece of a shaped face."""

    def __init__(self, rows):
        def column(name):
            return np.array([float(row[name] or "nan") for row in rows])

        axes = [axis for axis in "xyz" if axis in rows[0]]
        self.name = rows[0]["face"]
        self.points = np.transpose([column("reference_" + axis) for axis in axes])
        self.move, self.drops = column("move"), [column("reference_drop"), column("drop")]
        self.arc_length = column("arc_length") if "arc_length" in rows[0] else None
        normals = np.transpose([column("normal_" + axis) for axis in axes])
        mean = normals.mean(axis=0)
        self.is_flat = np.min(normals @ mean) > LEAST_COSINE * np.linalg.norm(mean)
        self.plane = [i for i in range(len(axes)) if i != np.argmax(np.abs(mean))]


def read_pieces(path):
    rows = {}
    try:
        with open(path, newline="") as file:
            for row in csv.DictReader(file):
                rows.setdefault(int(row["piece"]), []).append(row)
        return [Piece(of_piece) for of_piece in rows.values()]
    except (KeyError, TypeError, ValueError):
        raise PlotError(f"file '{path}' is damaged") from None


def draw_curves(pieces):
    """Draw the drops over the arc length; of pieces that turn too far, the displacement."""
    figure, axes = plt.subplots(len(pieces), 1, squeeze=False, layout="constrained",
                                figsize=(8., 1. + 3. * len(pieces)))
    for axis, piece in zip(axes[:, 0], pieces):
        if piece.is_flat:
            for drop, label in zip(piece.drops, TITLES):
                axis.plot(piece.arc_length, -drop, label=label)
            axis.legend()
            axis.set_ylabel("height below the\nhighest point (scene's length)")
        else:
            axis.plot(piece.arc_length, piece.move)
            axis.set_ylabel("displacement along\nthe normal (scene's length)")
        axis.set_title(piece.name)
        axis.grid(True, alpha=0.3)
    axes[-1, 0].set_xlabel("length along the face (scene's length)")
    return figure


def draw_maps(pieces):
    """Draw the drops of both shapes side by side, seen along the mean normal."""
    views = [piece.points[:, piece.plane] for piece in pieces]
    figure, axes = panels([np.ptp(view[:, 1]) / np.ptp(view[:, 0]) for view in views], 2)
    for row, (piece, view) in enumerate(zip(pieces, views)):
        of_piece = axes[row] if axes.shape[1] == 2 else axes[:, 0]
        levels = np.linspace(0., 1.001 * np.max(piece.drops) or 1., 65)
        for axis, drop, title in zip(of_piece, piece.drops, TITLES):
            image = axis.tricontourf(view[:, 0], view[:, 1], drop, levels=levels, cmap=COLOURS)
            axis.set_title(f"{piece.name}, {title}\nlargest {drop.max():.4g}")
            axis.set_xlabel(f"{'xyz'[piece.plane[0]]} (scene's length)")
            axis.set_ylabel(f"{'xyz'[piece.plane[1]]} (scene's length)")
        figure.colorbar(image, ax=of_piece, ticks=MaxNLocator(),
                        label="depth below the highest point (scene's length)")
    return figure


def draw_profile(directory):
    """Draw shape.png; faces of 3D bodies that turn too far are left out."""
    pieces = read_pieces(existing(os.path.join(directory, "profile.csv")))
    if pieces and pieces[0].arc_length is not None:
        figure = draw_curves(pieces)
    else:
        pieces = [piece for piece in pieces if piece.is_flat]
        if not pieces:
            return
        figure = draw_maps(pieces)
    figure.suptitle("Shaped faces without load")
    save(figure, directory, "shape.png")
