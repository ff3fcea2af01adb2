"""Rigid obstacles in pictures, from the parameters of a run: as they are where the bodies are cut."""

import re

import numpy as np

from parameters import numbers_of

GREY, EDGE = "0.82", "0.35"
FUNCTIONS = {name: getattr(np, name) for name in
             ("sin", "cos", "tan", "sinh", "cosh", "tanh", "exp", "log", "log10", "sqrt", "abs")}
FUNCTIONS.update({"asin": np.arcsin, "acos": np.arccos, "atan": np.arctan, "atan2": np.arctan2,
                  "ln": np.log, "min": np.minimum, "max": np.maximum, "where": np.where,
                  "pow": np.power, "pi": np.pi, "_pi": np.pi, "_e": np.e})


def evaluated(formula, points):
    """Return the values of a formula of x, y, z; raise ValueError if it has unknown parts."""
    text = re.sub(r"\bif\s*\(", "where(", formula.replace("^", "**"))
    x, y, z = np.moveaxis(points, -1, 0)
    names = {**FUNCTIONS, "x": x, "y": y, "z": z}
    words = re.findall(r"[A-Za-z_]\w*", re.sub(r"\d+\.?\d*[eE][+-]?\d+", "", text))
    if not set(words) <= set(names) or re.search(r"[^\w\s.+\-*/(),<>=]", text):
        raise ValueError(f"formula '{formula}' has parts that are not drawn")
    try:
        return np.broadcast_to(eval(text, {"__builtins__": {}}, names), x.shape)
    except (SyntaxError, TypeError) as error:
        raise ValueError(f"formula '{formula}': {error}") from None


def turned(axis, dim):
    """Return the rotation that maps the last axis to an axis in the plane of both, as the program
    does (level_set.cc)."""
    axis = axis / np.linalg.norm(axis)
    last = np.eye(3)[dim - 1]
    both = last + axis
    if np.linalg.norm(both) > 1e-8:
        return (np.eye(3) - np.outer(both, both) / (1. + axis[dim - 1]) +
                2. * np.outer(axis, last))
    return np.diag([-1. if k in (0, dim - 1) else 1. for k in range(3)])


class Obstacle:
    """This class is a rigid obstacle in a load case, at its place after its displacement."""

    def __init__(self, parameters, name, case):
        self.name, self.dim = name, int(parameters.section("")["Dimension"])
        self.entries = parameters.section(f"Obstacle {name}")
        self.origin = numbers_of(self.entries["Point"]) + numbers_of(self.entries["Displacement"])
        self.back = np.linalg.inv(parameters.position(case, name))

    def level(self, points):
        """Return a number at each point of an array (.., 3) that is negative inside."""
        points = points @ self.back[:3, :3].T + self.back[:3, 3] - self.origin
        shape = self.entries["Shape"]
        if shape == "plane":
            return points @ numbers_of(self.entries["Normal"])
        if shape == "formula":
            return evaluated(self.entries["Formula"],
                             points @ turned(numbers_of(self.entries["Axis"]), self.dim))
        if "cylinder" in shape and self.dim == 3:
            axis = numbers_of(self.entries["Axis"])
            axis /= np.linalg.norm(axis)
            points = points - (points @ axis)[..., None] * axis
        sign = -1. if shape.startswith("hollow") else 1.
        return sign * (np.linalg.norm(points, axis=-1) - float(self.entries["Radius"]))


def obstacles_of(parameters, case=""):
    """Return the Obstacles of a load case that can be drawn, and tell which cannot."""
    result = []
    for name in parameters.names("Obstacles"):
        obstacle = Obstacle(parameters, name, case)
        try:
            obstacle.level(np.zeros((1, 3)))
            result.append(obstacle)
        except ValueError as error:
            print(f"plot: obstacle {name} is not drawn: {error}")
    return result


def grid_between(low, high, plane, place, count=240):
    """Return points (count, count, 3) of a window in the plane of two axes, at a place along the
    third one."""
    grid = np.full((count, count, 3), float(place))
    grid[..., plane[0]], grid[..., plane[1]] = np.meshgrid(
        *(np.linspace(low[k], high[k], count) for k in range(2)), indexing="ij")
    return grid


def widened(obstacles, low, high, plane, place):
    """Return a window with more room on the sides where an obstacle is."""
    low, high = np.array(low, dtype=float), np.array(high, dtype=float)
    room = .12 * (high - low).max()
    inside = np.zeros((60, 60), dtype=bool)
    for obstacle in obstacles:
        inside |= obstacle.level(grid_between(low - room, high + room, plane, place, 60)) < 0.
    share = room / (high - low + 2. * room) * 60
    for k in range(2):
        strip, limits = max(1, int(share[k])), np.moveaxis(inside, k, 0)
        if limits[:strip].any():
            low[k] -= room
        if limits[-strip:].any():
            high[k] += room
    return low, high


def draw_obstacles(axis, obstacles, view, low, high, plane, place, zorder=.5):
    """Draw what a window in the plane of two axes has of the obstacles, with their names."""
    margin = .1 * (high - low).max()  # at least that of frame()
    grid = grid_between(low - margin, high + margin, plane, place)
    x, y = np.moveaxis(view.project(grid), -1, 0)
    within = np.all((grid[..., plane] >= low) & (grid[..., plane] <= high), axis=-1)
    beside = np.linalg.norm(grid[..., plane] - (low + high) / 2., axis=-1)
    for obstacle in obstacles:
        level = obstacle.level(grid)
        inside = level < 0.
        if not inside.any():
            continue
        axis.contourf(x, y, level, [level.min() - 1., 0.], colors=[GREY], zorder=zorder)
        axis.contour(x, y, level, [0.], colors=EDGE, linewidths=1.2, zorder=zorder)
        if (inside & within).any():
            # the name is deep inside and near the middle of the window
            at = np.unravel_index(np.argmax(np.where(
                inside & within, np.minimum(-level, room(within, grid, plane)) - .02 * beside,
                -np.inf)), inside.shape)
            axis.text(x[at], y[at], obstacle.name, ha="center", va="center", fontsize=8.,
                      color="0.2", zorder=95.)


def room(within, grid, plane):
    """Return how far points of a grid are from the border of the window within it."""
    places = grid[..., plane]
    low, high = places[within].min(axis=0), places[within].max(axis=0)
    return np.minimum(places - low, high - places).min(axis=-1)
