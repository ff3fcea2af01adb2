"""Scenes, gradients, curves and legends of all charts."""

import math

import drawing  # noqa: F401  first: it chooses pictures without a display
import matplotlib.pyplot as plt

from runs import read_csv, solve, write_csv

HERTZ_2D = "tests/scenes/hertz-2d-small.prm"
HERTZ_3D = "tests/scenes/hertz-3d-small.prm"
BLOCKS = "tests/scenes/two-blocks-2d.prm"
BEAM = "tests/scenes/beam.prm"

# The compliance has no gradient without a solve: all methods have something to do.
COMPLIANCE = {"Optimization/Objective": "compliance"}

# Below this an error is rounding; logarithmic axes have no zero.
FLOOR = 1e-16

MARKERS = "osD^v<>Px*"

# Whether charts are drawn from the numbers of an earlier measurement (contrib/chart --draw).
drawn_again = False


def numbers(path, measure):
    """Return the rows of a file: those that measure() returns, which are written into it, or those
    of an earlier measurement."""
    if drawn_again:
        return read_csv(path)
    rows = measure()
    write_csv(path, rows)
    return rows


def tolerance(value):
    return {"Solver/Relative tolerance": value}


def cells(n, *bodies, dim=3):
    return {f"Body {body}/Box cells": ", ".join([str(n)] * dim) for body in bodies}


def heights(n):
    """Return the entries of n x n Bezier heights."""
    return {"Shape/Control points": f"{n}, {n}"}


def gradient(scene, entries, method, ranks=1):
    """Return the Result of a gradient of the objective by one method."""
    return solve(scene, {"Task": "sensitivity", "Gradient/Compare": "false",
                         "Gradient/Method": method, **entries}, ranks)


def compared(scene, entries):
    """Return {method: row of the summary} of all methods side by side."""
    found = solve(scene, {"Task": "sensitivity", "Gradient/Compare": "true", **entries})
    return {row["method"]: row for row in found.summary["gradient"]["methods"]}


def error(values, reference):
    """Return |values - reference| / |reference|."""
    return math.dist(values, reference) / math.hypot(*reference)


def by(rows, key):
    """Return {value of key: its rows}, in the order of the rows."""
    groups = {}
    for row in rows:
        groups.setdefault(row[key], []).append(row)
    return groups


def curves(axis, rows, key, x, y, order=None):
    """Draw one logarithmic curve per value of key that has any y; its place among all, or in
    the order, chooses the colour."""
    groups = by(rows, key)
    for name, group in groups.items():
        index = (order or list(groups)).index(name)
        if any(row[y] > 0. for row in group):
            axis.loglog([row[x] for row in group], [max(row[y], FLOOR) for row in group],
                        MARKERS[index] + "-", color=f"C{index}", label=name, markersize=4,
                        linewidth=1.)
    axis.set_xlabel(x)
    axis.grid(True, alpha=0.3)


def panels(columns, height=4.5):
    """Return a figure and its axes in one row."""
    figure, axes = plt.subplots(1, columns, figsize=(5. * columns + 2.5, height),
                                layout="constrained", squeeze=False)
    return figure, axes[0]


def add_legend(axis, *entries):
    """Add the legend of an axis, or given handles and labels, right of the axis."""
    axis.legend(*entries, loc="center left", bbox_to_anchor=(1.02, 0.5), fontsize="small")


def legend_below(figure, axes, columns, height):
    """Add one legend of all curves of some axes, with this height as part of the figure."""
    labels = {label: handle for axis in axes
              for handle, label in zip(*axis.get_legend_handles_labels())}
    figure.get_layout_engine().set(rect=(0, height, 1, 1 - height))
    figure.legend(labels.values(), labels.keys(), loc="lower center", ncols=columns,
                  fontsize="small")
