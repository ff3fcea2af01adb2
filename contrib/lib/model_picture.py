"""Draw the model itself: mesh, contact pairs, supports, loads and obstacles, before any solution."""

import os
import pathlib
import subprocess

from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import to_rgb
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
import numpy as np

import model_loads
from drawing import Panel, Units, compose, frame
from obstacles import EDGE, GREY, draw_obstacles, obstacles_of, widened
from parameters import Parameters, items_of
from runs import built
from sections import area_vectors, bounds_of, is_flat, polygons_of
from states import PlotError, cells_of, points_of, read_states
from views import along_axis, from_angles

BODIES = "#cfe0ee", "#f3e2c3", "#d9ead3", "#e8d6e8", "#f6d5d0", "#dcdcdc"
PAIRS = "#d62728", "#1f77b4", "#2ca02c", "#9467bd", "#ff7f0e", "#17becf"
HELD, MOST = "black", 16  # colour of supports; lines in the list beside the picture


def prepared(path):
    """Return the directory of the pictures and that of the meshes of an output directory, or of a
    model, which `snug --validate` writes."""
    if os.path.isdir(path):
        own = os.path.join(path, "model")
        has_run = os.path.exists(os.path.join(path, "solution.pvd")) or not os.path.isdir(own)
        return path, path if has_run else own
    if not os.path.isfile(path):
        raise PlotError(f"no model or output directory '{path}'")
    directory = os.path.join("output", pathlib.Path(path).stem)
    program = built("SNUG", "snug")
    done = subprocess.run([program, "--validate", path, "--output", directory], text=True,
                          capture_output=True, check=False)
    if done.returncode:
        raise PlotError((done.stderr.strip().splitlines() or [f"{program} failed"])[-1])
    return directory, os.path.join(directory, "model")


class Model:
    """This class has the boundaries of one load case of a model, as they are drawn along a view."""

    def __init__(self, state, parameters, case, view):
        self.state, self.parameters, self.case = state, parameters, case
        self.flat = is_flat(state)
        self.view = along_axis(2) if self.flat else view or from_angles(-60., 25.)
        self.centres = {name: np.array([points_of(body)[polygon].mean(axis=0)
                                        for polygon in polygons_of(body)] if self.flat else
                                       [points_of(body).mean(axis=0)])
                        for name, body in state.bodies.items()}
        low, high = bounds_of(state)
        corners = self.view.project(np.array([[(low, high)[(k >> d) & 1][d] for d in range(3)]
                                              for k in range(8)]))
        self.obstacles, self.written = obstacles_of(parameters, case), []
        # the plane in which obstacles are cut, at the front or in the middle, and the window there
        self.plane = [0, 1] if self.flat else [0, 2]
        places = [0.] if self.flat else np.round([low[1], (low[1] + high[1]) / 2.], 9) + 0.
        windows = [widened(self.obstacles, low[self.plane], high[self.plane], self.plane, place)
                   for place in places]
        at = int(np.argmax([np.prod(end - start) for start, end in windows]))
        self.place, self.section = places[at], windows[at]
        self.layer = .5 if self.flat or at else 45.  # zorder of obstacles
        if self.obstacles:
            ends = np.full((2, 3), self.place)
            ends[:, self.plane] = self.section
            corners = np.concatenate([corners, self.view.project(ends)])
        self.low, self.high = corners.min(axis=0), corners.max(axis=0)
        self.names = {name: self.middle(body) for name, body in state.bodies.items()}
        self.length = .12 * np.linalg.norm(self.high - self.low)  # of arrows

    def middle(self, body):
        """Return the projected point of a body that is next to its centre."""
        places = self.view.project(points_of(body))
        return places[np.argmin(np.linalg.norm(places - places.mean(axis=0), axis=1))]

    def corners(self, name):
        """Return the corners (n, corners, 3) of the faces of a boundary 'body.boundary'."""
        boundary = self.state.boundaries.get(name)
        return points_of(boundary)[cells_of(boundary)] if boundary else np.zeros((0, 2, 3))

    def places(self, name, most):
        """Return some places on a boundary with the outward normals there."""
        corners = self.corners(name)
        corners = corners[spread(corners.mean(axis=1), most)]
        middles = corners.mean(axis=1)
        if not self.flat:
            normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        else:
            steps = corners[:, 1] - corners[:, 0]
            normals = np.stack([steps[:, 1], -steps[:, 0], 0. * steps[:, 0]], axis=1)
            cells = self.centres[name.split(".", 1)[0]]
            for k, middle in enumerate(middles):
                inside = cells[np.argmin(np.linalg.norm(cells - middle, axis=1))]
                normals[k] *= np.sign(normals[k] @ (middle - inside)) or 1.
        lengths = np.linalg.norm(normals, axis=1, keepdims=True)
        return middles, normals / np.maximum(lengths, 1e-300)

    def beside_name(self, body):
        """Return a point of a body left of its middle, as an array (1, 3)."""
        points = points_of(self.state.bodies[body])
        low, high = points.min(axis=0), points.max(axis=0)
        wanted = low + [.25, .6, .6] * (high - low)
        return points[np.argmin(np.linalg.norm(points - wanted, axis=1))][None]

    def pairs(self):
        """Return [(name, boundaries)] of the contact pairs."""
        return [(f"{first}: {second}", [name.strip() for side in (first, second)
                                        for name in side.split("+")])
                for first, second in items_of(self.parameters.section("Contact")["Pairs"])]


def spread(points, most):
    """Return the numbers of some points that are far from each other."""
    if len(points) <= most:
        return np.arange(len(points))
    chosen = [int(np.argmin(np.linalg.norm(points - points.mean(axis=0), axis=1)))]
    while len(chosen) < most:
        distances = np.linalg.norm(points[:, None] - points[chosen], axis=2).min(axis=1)
        chosen.append(int(np.argmax(distances)))
    return np.array(chosen)


def draw_triad(axis, model):
    """Draw the directions of the axes of bodies in space at the lower left corner."""
    origin = model.low.copy()
    for name, unit in zip("xyz", np.eye(3)):
        tip = origin + .7 * model.length * model.view.project(unit)
        axis.annotate("", tip, origin, annotation_clip=False, zorder=90.,
                      arrowprops={"arrowstyle": "->", "color": "0.3", "shrinkA": 0.,
                                  "shrinkB": 0.})
        axis.text(*(1.3 * tip - .3 * origin), name, fontsize=8., ha="center", va="center",
                  zorder=90.)


def draw_bodies(axis, model):
    """Draw the cells of flat bodies, or what is seen of the boundaries of bodies in space."""
    polygons, colours, depths = [], [], []
    for number, (name, body) in enumerate(model.state.bodies.items()):
        colour = np.array(to_rgb(BODIES[number % len(BODIES)]))
        parts = [body] if model.flat else [grid for of, grid in model.state.boundaries.items()
                                           if of.startswith(name + ".")]
        for part in parts:
            points, cells = points_of(part), polygons_of(part)
            if not cells:
                continue
            shade = np.ones(len(cells))
            if not model.flat:
                areas = area_vectors(points, cells)
                shade = areas @ model.view.towards / np.linalg.norm(areas, axis=1)
            for cell, light in zip(cells, shade):
                if light > 0.:
                    polygons.append(model.view.project(points[cell]))
                    colours.append(colour * (.75 + .25 * light))
                    depths.append(model.view.depth(points[cell].mean(axis=0)))
    order = np.argsort(depths, kind="stable")
    lines = float(np.clip(25. / np.sqrt(len(polygons) + 1), .08, .5))
    axis.add_collection(PolyCollection([polygons[k] for k in order], zorder=1.,
                                       facecolors=[colours[k] for k in order],
                                       edgecolors="0.45", linewidths=lines))


def draw_boundary(axis, model, name, colour, zorder):
    """Draw a boundary: of flat bodies a line, else its faces, also those behind others."""
    corners = model.view.project(model.corners(name))
    if len(corners) == 0:
        return
    if model.flat:
        axis.add_collection(LineCollection(corners, colors=[colour], linewidths=3., zorder=zorder,
                                           capstyle="round"))
    else:
        axis.add_collection(PolyCollection(corners, facecolors=[colour], edgecolors="none",
                                           alpha=.35, zorder=zorder))


def draw_supports(axis, model, most):
    """Draw supports and springs; return their lines in the list."""
    handles = []
    for body in model.state.bodies:
        entries = model.parameters.section(f"Body {body}")
        for kind, marker in (("Supports", "^"), ("Springs", "P")):
            for boundary, held in items_of(entries.get(kind, "")):
                name = f"{body}.{boundary}"
                middles, normals = model.places(name, most)
                first = held.split(" ")[0]
                shown = "s" if kind == "Supports" and len(first) >= 2 and \
                    set(first) <= set("xyz") else marker
                if not model.flat:
                    draw_boundary(axis, model, name, HELD, 2.)
                places = model.view.project(middles + .1 * model.length * normals)
                axis.plot(*places.T, shown, color=HELD, markersize=5., zorder=60.)
                what = "held" if kind == "Supports" else "springs"
                handles.append(Line2D([], [], color=HELD, marker=shown, linestyle="",
                                      label=f"{name}: {what} {held}"))
        for boundary, text in items_of(entries.get("Point supports", "")):
            held, _, at = text.partition(" at ")
            place = model.view.project(model_loads.vector(at))
            axis.plot(*place, "D", color=HELD, markersize=6., zorder=60.)
            handles.append(Line2D([], [], color=HELD, marker="D", linestyle="",
                                  label=f"{body}.{boundary}: point held {held}"))
    return handles


def draw_model(axis, model, window, units):
    """Draw a load case, or a (low, high) window of it; return the lines of the list."""
    draw_bodies(axis, model)
    found = []
    for number, (name, boundaries) in enumerate(model.pairs()):
        colour = PAIRS[number % len(PAIRS)]
        for boundary in boundaries:
            draw_boundary(axis, model, boundary, colour, 40.)
        found.append(Patch(color=colour, alpha=1. if model.flat else .5, label=f"contact {name}"))
    draw_obstacles(axis, model.obstacles, model.view, *(window or model.section), model.plane,
                   model.place, model.layer)
    where = "" if model.flat else f", cut at y = {model.place:.4g}"
    found += [Patch(facecolor=GREY, edgecolor=EDGE, label=f"obstacle {obstacle.name}{where}")
              for obstacle in model.obstacles]
    if window:
        frame(axis, model.view, *window, units)
        return found
    found += draw_supports(axis, model, 6)
    corners, lines = model_loads.draw_loads(axis, model)
    write_names(axis, model)
    if not model.flat:
        draw_triad(axis, model)
        corners.append(model.low - .4 * model.length)
    frame(axis, model.view, np.min(corners, axis=0), np.max(corners, axis=0), units)
    return found + lines


def write_names(axis, model):
    """Write the names of the bodies."""
    for name, place in model.names.items():
        axis.text(*place, name, ha="center", va="center", fontsize=9., style="italic",
                  zorder=80.,
                  bbox={"boxstyle": "round,pad=.15", "fc": "white", "ec": "none", "alpha": .7})


def draw_list(axis, found):
    """Draw the list of what is drawn beside it."""
    axis.set_axis_off()
    more = [Patch(alpha=0., label=f"and {len(found) - MOST} more")] if len(found) > MOST else []
    axis.legend(handles=found[:MOST] + more, loc="center",
                frameon=False, fontsize=8.)


def window_of(model):
    """Return the (low, high) window of the contact pairs of flat bodies if it is small."""
    corners = [model.corners(name)[..., :2].reshape(-1, 2)
               for _, boundaries in model.pairs() for name in boundaries]
    corners = np.concatenate(corners + [np.zeros((0, 2))])
    if not model.flat or len(corners) == 0:
        return None
    middle = (corners.min(axis=0) + corners.max(axis=0)) / 2.
    half = np.full(2, .7 * np.ptp(corners, axis=0).max())
    return (middle - half, middle + half) \
        if 2. * half.max() < .25 * (model.high - model.low).max() else None


def group_of(model, title, units):
    """Return the panels of a load case: the whole, the contact if it is small, and the list."""
    found, window = [], window_of(model)
    ratio = np.divide(*(model.high - model.low + 2. * model.length))
    panels = [Panel(float(np.clip(ratio, .4, 1.2 if window else 2.5)), title, lambda axis: found.extend(
        draw_model(axis, model, None, units)))]
    if window:
        panels.append(Panel(1., "at the contact", lambda axis: draw_model(
            axis, model, window, units) and None))
    longest = max(map(len, [f"contact {name}" for name, _ in model.pairs()] + [32 * " "] +
                      model_loads.labels(model)))
    # the blank title makes room for the list, whose letters are smaller
    return panels + [Panel(.5, " " * (3 * longest // 4 + 12), lambda axis: draw_list(axis, found))]


def draw_models(path, view):
    """Draw model.png of a model or an output directory: the first and the last load case."""
    directory, source = prepared(path)
    parameters = Parameters(source)
    names = parameters.names("Load cases")
    cases = [names[0], names[-1]] if len(names) > 1 else [""]
    units = Units({"units": dict(zip(("length", "force"), parameters.names("Units")))})
    groups = []
    for case in cases:
        state = read_states(os.path.join(source, case), "solution.pvd")[0]
        if is_flat(state) and view:
            raise PlotError("--view is for bodies in space, but these are flat")
        model = Model(state, parameters, case, view)
        name = parameters.case_name(case)
        groups.append(group_of(model, f"load case {name}" if name else "", units))
    hidden = "" if groups and model.flat else ", contact faces seen through the bodies"
    compose(f"{pathlib.Path(path).resolve().stem}: model{hidden}", groups, directory, "model.png")
