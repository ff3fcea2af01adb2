"""What all pictures of a run share: panels side by side, colours, titles."""

import os

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import MaxNLocator
import numpy as np

COLOURS = "viridis"


def titles(states):
    """Return one title per state; a single state needs none."""
    if len(states) == 1:
        return [""]
    return [f"before (iteration {states[0][0]:g})",
            f"after (iteration {states[-1][0]:g})"]


def panels(aspects, columns):
    """Return a figure and its axes: one row per aspect (height over width of what is
    drawn), so many columns; the panels of a row share their coordinates. A
    single row of wide panels is drawn as a column of them."""
    stacked = len(aspects) == 1 and aspects[0] < 0.4
    width = 9. if stacked else float(np.clip(9. / min(aspects), 3., 5.5))
    least = 2. if stacked or len(aspects) > 1 else 3.
    heights = [float(np.clip(width * aspect, least, 9.)) for aspect in aspects]
    if stacked:
        heights, columns = columns * heights, 1
    figure, axes = plt.subplots(
        len(heights), columns, layout="constrained", squeeze=False,
        sharex="all" if stacked else "row", sharey="all" if stacked else "row",
        height_ratios=heights,
        figsize=(width * columns + 1.5, sum(heights) + len(heights)))
    if stacked:
        axes = axes.T
    for axis in axes.ravel():
        axis.use_sticky_edges = False
        axis.margins(0.03)
        axis.set_aspect("equal")
    return figure, axes


def paint(axis, points, polygons, values, peak):
    """Draw values, linear on the triangles between the edges of the polygons
    and their centres; colours from 0 to peak."""
    used, place = np.unique(np.concatenate(polygons), return_inverse=True)
    points, values = points[used], values[used]
    ends = np.cumsum([len(polygon) for polygon in polygons])[:-1]
    polygons = [part.tolist() for part in np.split(place.ravel(), ends)]
    centres = [points[polygon].mean(axis=0) for polygon in polygons]
    means = [values[polygon].mean() for polygon in polygons]
    triangles = [(a, b, len(points) + k)
                 for k, polygon in enumerate(polygons)
                 for a, b in zip(polygon, polygon[1:] + polygon[:1])]
    where = np.concatenate([points, centres])
    return axis.tricontourf(where[:, 0], where[:, 1], triangles,
                            np.concatenate([values, means]), cmap=COLOURS,
                            levels=np.linspace(0., 1.001 * peak or 1., 65),
                            extend="neither")


def add_scale(figure, axes, image, quantity):
    figure.colorbar(image, ax=axes, ticks=MaxNLocator(),
                    label=f"{quantity} (scene's force / length²)")


def save(figure, directory, name):
    path = os.path.join(directory, name)
    figure.savefig(path, dpi=150)
    plt.close(figure)
    print(path)
