"""The loads of a model as arrows: forces, pressures, tractions, moments, weights, displacements."""

import re

from matplotlib.lines import Line2D
import numpy as np

from obstacles import evaluated
from parameters import items_of, numbers_of

FORCE, MOVE = "#b2182b", "#762a83"  # colours of loads and of prescribed displacements


def vector(text):
    return numbers_of(text) if text.strip() else np.zeros(3)


def value_of(formula, places):
    """Return a formula at places, 1 where it cannot be evaluated."""
    try:
        return np.array(evaluated(formula, places), dtype=float)
    except ValueError:
        return np.ones(len(places))


def of_body(model, body):
    """Return the (kind, boundary, text) of the loads of a body in the load case."""
    entries = model.parameters.section(f"Body {body}")
    case = model.parameters.case(model.case)
    for kind in ("Force", "Traction", "Pressure", "Moment", "Point force", "Line force",
                 "Displacement"):
        for boundary, text in items_of(entries.get(kind, "")):
            yield kind, f"{body}.{boundary}", text
        for boundary, text in items_of(case.get(kind, "")):
            if boundary.startswith(body + "."):
                yield kind, boundary, text
    if entries.get("Body force"):
        yield "Body force", body, entries["Body force"]
    for gravity in filter(None, (model.parameters.section("").get("Gravity"),
                                 case.get("Gravity"))):
        yield "Gravity", body, gravity


def arrows_of(model, kind, boundary, text):
    """Return the places and the directions of the arrows of a load."""
    if kind in ("Body force", "Gravity"):
        points = model.beside_name(boundary)
        words = text.replace(",", " ").split()
        return points, components(words, points)
    if kind == "Point force":
        force, _, at = text.partition(" at ")
        return vector(at)[None], vector(force)[None]
    middles, normals = model.places(boundary, 5)
    if kind == "Line force":
        ends = re.fullmatch(r"(.*?) from (.*) to (.*)", text)
        force = ends[1] if ends else text.partition(" along ")[0]
        if ends:
            middles = np.linspace(vector(ends[2]), vector(ends[3]), 5)
        return middles, np.tile(vector(force), (len(middles), 1))
    if kind == "Pressure":
        return middles, -normals * value_of(text, middles)[:, None]
    if kind == "Displacement":
        component, _, formula = text.partition("=")
        axis = component.strip()
        along = normals if axis == "normal" else np.tile(
            np.eye(3)["xyz".index(axis)], (len(middles), 1)) if axis in "xyz" else about_axis(
                model.parameters.section(f"Body {boundary.partition('.')[0]}"), axis, middles)
        return middles, along * value_of(formula, middles)[:, None]
    return middles, components(text.split(), middles)


def about_axis(entries, component, places):
    """Return the radial, tangential or axial directions about the axis of a body."""
    axis, point = (vector((entries.get(key) or default).replace(",", " "))
                   for key, default in (("Axis", "0 0 1"), ("Axis point", "0 0 0")))
    axis = axis / np.linalg.norm(axis)
    lever = places - point
    lever = lever - np.outer(lever @ axis, axis)
    radial = lever / np.linalg.norm(lever, axis=1)[:, None]
    return {"radial": radial, "tangential": np.cross(axis, radial),
            "axial": np.tile(axis, (len(places), 1))}[component]


def components(formulas, places):
    result = np.zeros((len(places), 3))
    for k, formula in enumerate(formulas):
        result[:, k] = value_of(formula, places)
    return result


def labels(model):
    return [f"{boundary}: {shortened(f'{kind.lower()} {text}')}" for body in model.state.bodies
            for kind, boundary, text in of_body(model, body)]


def draw_loads(axis, model):
    """Draw all loads with their kinds and values; return the corners of the frame that they need,
    and their lines in the list."""
    lines, ends = [], [model.low, model.high]
    for body in model.state.bodies:
        for kind, boundary, text in of_body(model, body):
            colour = MOVE if kind == "Displacement" else FORCE
            label = shortened(f"{kind.lower()} {text}")
            marker = r"$\circlearrowleft$" if kind == "Moment" else r"$\rightarrow$"
            lines.append(Line2D([], [], color=colour, marker=marker, linestyle="", markersize=9.,
                                label=f"{boundary}: {label}"))
            if kind == "Moment":
                place = model.view.project(model.corners(boundary).mean(axis=(0, 1)))
                axis.plot(*place, marker=marker, color=colour, markersize=16., zorder=70.)
                write(axis, model, place - [0., .8 * model.length], label, colour)
                continue
            arrows = draw_arrows(axis, model, arrows_of(model, kind, boundary, text), colour)
            if arrows:
                names = np.array(list(model.names.values()))
                room = [np.linalg.norm(names - end, axis=1).min() for end in arrows]
                write(axis, model, arrows[int(np.argmax(room))], label, colour)
            ends += arrows
    return ends, lines


def shortened(text, most=36):
    return text if len(text) <= most else text[:most - 2] + ".."


def write(axis, model, place, label, colour):
    """Write the label of a load next to its arrow, towards the middle of the picture, above
    others."""
    apart = model.length * np.array([3., .25])
    while any(np.all(np.abs(place - other) < apart) for other in model.written):
        place = place + [0., .26 * model.length]
    model.written.append(place)
    side = "left" if place[0] < (model.low[0] + model.high[0]) / 2. else "right"
    axis.text(*place, label, color=colour, fontsize=7.5, ha=side, va="bottom", zorder=75.,
              bbox={"boxstyle": "round,pad=.1", "fc": "white", "ec": "none", "alpha": .75})


def draw_arrows(axis, model, arrows, colour):
    """Draw arrows that end at their places if they push, and begin there if they pull; the
    longest of them has the length of the model's arrows. Return their ends."""
    places, directions = arrows
    lengths = np.linalg.norm(directions, axis=1)
    ends = []
    centre = np.mean([model.low, model.high], axis=0)
    for place, direction in zip(places, directions):
        if lengths.max() == 0. or np.linalg.norm(direction) < 1e-3 * lengths.max():
            continue
        start = model.view.project(place)
        step = model.view.project(model.length * direction / lengths.max())
        pushes = step @ (centre - start) >= 0.
        tail, head = (start - step, start) if pushes else (start, start + step)
        axis.annotate("", head, tail, zorder=70., annotation_clip=False,
                      arrowprops={"arrowstyle": "-|>", "color": colour, "shrinkA": 0.,
                                  "shrinkB": 0., "linewidth": 1.3})
        ends += [tail, head]
    return ends
