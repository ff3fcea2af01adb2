"""What all pictures share: panels in rows, colours, marks, units, and small files.

Colours are those of one convention: COLOURS, which are sequential, for stress, pressure and depth
from zero on, and CHANGES, which diverge, for signed changes with zero in the middle."""

import collections
import io
import math
import os

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import MaxNLocator
from matplotlib.tri import Triangulation
import numpy as np
from PIL import Image

COLOURS, CHANGES = "viridis", "RdBu_r"
WIDTH, LOW, HEIGHT = 11., 2.2, 3.6  # of a picture; of panels, at least and at most [inches]
LEFT, RIGHT, TOP, BOTTOM, SCALE = .88, .18, .3, .5, .95  # margins of a panel
LEGEND = .26  # height of a legend above a panel
plt.rcParams.update({"font.size": 10., "axes.titlesize": 10., "legend.fontsize": 9.,
                     "axes.formatter.limits": (-3, 5), "axes.formatter.use_mathtext": True})

# A panel: its width over its height, a title of some lines, draw(axis), which returns an image
# if there is one, the label of the colour bar of the image, or "", and the names in its legend,
# which is above the panel, so that it hides no curve.
Panel = collections.namedtuple("Panel", "ratio title draw scale legend", defaults=["", ()])

# What the pictures of a directory share: the model with the load case, Units, summary, options and
# the Obstacles.
Run = collections.namedtuple("Run", "directory title units summary options obstacles")


class Units:
    """This class names units after those of the summary; without any, quantities."""

    def __init__(self, summary):
        units = summary.get("units") or {}
        self.length = units.get("length", "")
        self.stress = units.get("stress", "force/length²")

    def label(self, quantity, unit):
        return f"{quantity} [{unit}]" if unit else quantity

    def place(self, axis):
        return self.label(axis, "degrees" if axis.startswith("angle") else self.length)


def titles(states):
    """Return one title per state; a single state needs none."""
    if len(states) == 1:
        return [""]
    return ["before", f"after iteration {states[-1].time:g}"]


def scales(peaks, given=0.):
    """Return the upper ends of the colours of states with these largest values. States share them
    unless one has less than 0.8 of the largest; a given end raises all to itself."""
    largest = max(peaks)
    shared = min(peaks) >= 0.8 * largest
    return [max(given, largest if shared or given > 0. or peak <= 0. else peak) for peak in peaks]


def size_of(panel, height):
    """Return the width and height of a panel with its margins."""
    lines = panel.title.splitlines()
    widths = [height * panel.ratio] + [.083 * len(line) - .5 for line in lines]
    widths.append(sum(.085 * len(name) + .5 for name in panel.legend) - .5)
    return (LEFT + max(widths) + (SCALE if panel.scale else 0.) + RIGHT,
            TOP / 3 + .2 * len(lines) + .1 + BOTTOM + height + (LEGEND if panel.legend else 0.))


def arrange(groups):
    """Return rows of panels. Panels share a row while they are high enough in it; those of a group
    share one if possible."""
    rows = []
    for group in groups:
        if not rows or height_of(rows[-1] + group) < LOW:
            rows.append([])
        for panel in group:
            if rows[-1] and height_of(rows[-1] + [panel]) < LOW:
                rows.append([])
            rows[-1].append(panel)
    return rows


def height_of(row):
    """Return the height of the panels of a row, so that the row fits into the width."""
    height = HEIGHT
    while height > .5 and sum(size_of(panel, height)[0] for panel in row) > WIDTH:
        height *= .98
    return height


def compose(title, groups, directory, name):
    """Draw groups of panels below a title into a file."""
    rows = arrange(groups)
    heights = [height_of(row) for row in rows]
    tall = [max(size_of(panel, height)[1] for panel in row) for row, height in zip(rows, heights)]
    wide = max(sum(size_of(panel, height)[0] for panel in row)
               for row, height in zip(rows, heights))
    wide = max(wide, min(WIDTH, .085 * len(title) + .4))
    total = sum(tall) + .4
    figure = plt.figure(figsize=(wide, total))
    figure.text(.5, 1. - .25 / total, title, ha="center", va="center", fontsize=11.)
    below = total - .4
    for row, height, of_row in zip(rows, heights, tall):
        x = (wide - sum(size_of(panel, height)[0] for panel in row)) / 2.
        y = below - of_row + BOTTOM
        for panel in row:
            width, drawn = size_of(panel, height)[0], height * panel.ratio
            left = x + LEFT + (width - LEFT - RIGHT - (SCALE if panel.scale else 0.) - drawn) / 2.
            axis = figure.add_axes([left / wide, y / total, drawn / wide, height / total])
            axis.set_title(panel.title, pad=6. + (72. * LEGEND if panel.legend else 0.))
            image = panel.draw(axis)
            if panel.legend:
                axis.legend(ncols=len(panel.legend), loc="lower center", frameon=False,
                            bbox_to_anchor=(.5, 1.), borderaxespad=.2, columnspacing=1.2)
            axis.xaxis.set_major_locator(MaxNLocator(int(np.clip(drawn / .6, 1, 7))))
            axis.yaxis.set_major_locator(MaxNLocator(int(np.clip(height / .5, 1, 6))))
            if panel.scale:
                bar = figure.add_axes([(left + drawn + .1) / wide, y / total, .14 / wide,
                                       height / total])
                figure.colorbar(image, cax=bar, ticks=MaxNLocator(int(np.clip(height / .4, 1, 6))))
                low = height < .08 * len(panel.scale)
                bar.set_ylabel(panel.scale.replace(" [", "\n[") if low else panel.scale,
                               fontsize=np.clip(8. * height, 6., 10.))
            x += width
        below -= of_row
    save(figure, directory, name)


def finish(axis, columns=3):
    """Add a grid, and a legend above the axis, where it hides no curve."""
    axis.grid(alpha=.3)
    axis.legend(ncols=columns, loc="lower center", frameon=False, bbox_to_anchor=(.5, 1.))


def triangles_of(points, polygons, values):
    """Return points, triangles and values: polygons are split by their centres."""
    counts = np.array([len(polygon) for polygon in polygons])
    corners = np.concatenate([np.asarray(polygon) for polygon in polygons])
    first = np.concatenate([[0], np.cumsum(counts)[:-1]])
    following = np.arange(1, len(corners) + 1)
    following[first + counts - 1] = first
    centre = np.repeat(np.arange(len(counts)), counts) + len(points)
    weights = 1. / counts
    means = np.add.reduceat(values[corners], first) * weights
    centres = np.add.reduceat(points[corners], first) * weights[:, None]
    return (np.concatenate([points, centres]),
            np.transpose([corners, corners[following], centre]),
            np.concatenate([values, means]))


def paint(axis, view, points, polygons, values, ends, colours=COLOURS):
    """Draw values of points in space, linear on the polygons, seen along a view: what is nearer is
    drawn over what is farther. ends: the values of the first and the last colour."""
    if len(polygons) == 0:
        polygons, points, values = [[0, 0, 0]], np.zeros((1, 3)), np.zeros(1)
    where, triangles, shown = triangles_of(points, polygons, values)
    order = np.argsort(view.depth(where[triangles].mean(axis=1)), kind="stable")
    place = view.project(where)
    first, last = ends
    return axis.tripcolor(Triangulation(place[:, 0], place[:, 1], triangles[order]), shown,
                          shading="gouraud", cmap=colours, vmin=first,
                          vmax=last if last > first else first + 1.)


def frame(axis, view, low, high, units, stretched=False):
    """Show the window between two corners in the plane of a view; stretched: it fills its panel
    whatever its proportions."""
    margin = 0.03 * np.maximum(high - low, 0.05 * (high - low).max())
    axis.set_xlim(low[0] - margin[0], high[0] + margin[0])
    axis.set_ylim(low[1] - margin[1], high[1] + margin[1])
    axis.set_aspect("auto" if stretched else "equal")
    if view.names is None:
        axis.set_axis_off()
        return
    axis.set_xlabel(units.place(view.names[0]))
    axis.set_ylabel(units.place(view.names[1]), labelpad=1.)
    if view.flipped:
        axis.invert_xaxis()


def proportions(low, high, longest=4.):
    """Return the ratio of the panel of a window and how many times it is stretched upwards, 1 if
    it is not, because it is not longer than this number of its widths."""
    width, height = np.maximum(high - low, 1e-300)
    ratio = width / height
    if 1. / longest <= ratio <= longest:
        return ratio, 1.
    shown = min(max(ratio, 0.5), 2.5)
    return shown, ratio / shown


def stretched_by(names, stretch):
    """Return ', y stretched 20 times', or nothing if a panel is to scale."""
    if abs(stretch - 1.) <= .05:
        return ""
    return f", {names[int(stretch > 1.)]} stretched {max(stretch, 1. / stretch):.3g} times"


def write_beside(axis, place, text, colour):
    """Write the value of a peak above its place, so that the text is within the frame."""
    low, high = axis.get_xlim()
    share = (place[0] - low) / (high - low)
    side = "left" if share < .08 else "right" if share > .92 else "center"
    axis.annotate(text, place, (0., 6.), textcoords="offset points", color=colour, ha=side)


def mark(axis, place):
    """Mark a peak."""
    axis.plot(*place, "x", color="white", markersize=9., markeredgewidth=3.5, zorder=100.)
    axis.plot(*place, "x", color="crimson", markersize=8., markeredgewidth=1.8, zorder=101.)


def outline_window(axis, view, window, plane, place):
    """Draw the box of a window in the plane of two axes, at the place along the third one."""
    across = 3 - sum(plane)
    low, high = window
    corners = np.zeros((5, 3))
    corners[:, plane[0]] = np.take([low[0], high[0]], [0, 1, 1, 0, 0])
    corners[:, plane[1]] = np.take([low[1], high[1]], [0, 0, 1, 1, 0])
    corners[:, across] = place
    axis.plot(*view.project(corners).T, color="white", linewidth=2., zorder=90.)
    axis.plot(*view.project(corners).T, color="black", linewidth=1., linestyle="--", zorder=91.)


def number_text(value):
    """Return a number with four digits, without an exponent unless it is long."""
    if 1e4 <= abs(value) < 1e7:
        return f"{round(value, 3 - math.floor(math.log10(abs(value)))):.0f}"
    return f"{value:.4g}"


def place_text(names, point, extent):
    """Return 'x = 0.5, y = 1' with digits for places within an extent."""
    digits = max(0, 3 - math.floor(math.log10(extent))) if extent > 0. else 3
    return ", ".join(f"{name} = {float(f'{value:.{digits}f}') + 0.:g}"
                     for name, value in zip(names, point))


def save(figure, directory, name):
    """Write a picture with a palette of 256 colours, which is a third of the size."""
    path = os.path.join(directory, name)
    memory = io.BytesIO()
    figure.savefig(memory, dpi=110)
    plt.close(figure)
    memory.seek(0)
    picture = Image.open(memory).convert("RGB")
    picture.quantize(256, method=Image.Quantize.MAXCOVERAGE,
                     dither=Image.Dither.NONE).save(path, optimize=True)
    print(path)
