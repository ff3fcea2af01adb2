"""Pictures of the boundaries of CAD bodies, from the meshes that snug leaves in OUTPUT/cad."""

import collections
import pathlib

import drawing
import matplotlib.pyplot as plt
from matplotlib.collections import LineCollection
from mpl_toolkits.mplot3d.art3d import Poly3DCollection
import numpy as np

TYPES = {8: 2, 9: 3}  # lines and triangles of second order -> corners


def sections_of(text):
    """Return the words of the lines of each section of a .msh file of version 4.1 in text."""
    result, name = collections.defaultdict(list), None
    for line in text.splitlines():
        if line.startswith("$"):
            name = None if line.startswith("$End") else line[1:]
        elif name:
            result[name].append(line.split(maxsplit=2) if name == "PhysicalNames"
                                else line.split())
    return result


def groups_of_entities(lines):
    """Return the physical group of each entity, by dimension and number."""
    counts, lines = [int(word) for word in lines[0]], iter(lines[1:])
    result = {}
    for dim, count in enumerate(counts):
        place = 4 if dim == 0 else 7  # behind the number and the box
        for _ in range(count):
            words = next(lines)
            if int(words[place]) > 0:
                result[dim, int(words[0])] = abs(int(words[place + 1]))
    return result


def read_boundaries(path):
    """Return the dimension of the boundaries and their faces: name -> array of (face, corner,
    coordinate)."""
    sections = sections_of(pathlib.Path(path).read_text(encoding="utf-8"))
    names = {(int(dim), int(number)): name.strip('"')
             for dim, number, name in sections["PhysicalNames"][1:]}
    boundary_dim = max(dim for dim, _ in names) - 1
    groups = groups_of_entities(sections["Entities"])
    points, lines = {}, iter(sections["Nodes"][1:])
    for head in lines:
        numbers = [next(lines)[0] for _ in range(int(head[3]))]
        for number in numbers:
            points[number] = [float(word) for word in next(lines)]
    faces, lines = collections.defaultdict(list), iter(sections["Elements"][1:])
    for head in lines:
        dim, entity, kind, count = (int(word) for word in head)
        for _ in range(count):
            words = next(lines)
            if dim == boundary_dim:
                faces[names[dim, groups[dim, entity]]].append(
                    [points[word] for word in words[1:1 + TYPES[kind]]])
    return boundary_dim, {name: np.array(own) for name, own in faces.items()}


def colours_of(boundaries):
    return dict(zip(boundaries, plt.get_cmap("tab20").colors * len(boundaries)))


def draw_flat(axis, boundaries):
    for (name, faces), colour in zip(boundaries.items(), colours_of(boundaries).values()):
        axis.add_collection(LineCollection(faces[:, :, :2], colors=[colour], linewidths=3.))
        middle = faces.mean(axis=1)
        place = middle[np.argmin(np.linalg.norm(middle - middle.mean(axis=0), axis=1))]
        axis.annotate(name, place[:2], color="black", ha="center", va="center",
                      bbox={"boxstyle": "round", "fc": colour, "alpha": 0.8})
    axis.autoscale()
    axis.set_aspect("equal")


def direction_of(elevation, azimuth):
    up, around = np.radians((elevation, azimuth))
    return np.array([np.cos(up) * np.cos(around), np.cos(up) * np.sin(around), np.sin(up)])


def seen_area(faces, towards):
    """Return the area that the eye sees of faces in the direction towards."""
    normals = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
    return np.maximum(normals @ towards, 0.).sum() / 2


def draw_solid(axis, boundaries, towards, named):
    """Draw the faces that face the eye in the direction towards, and the names of some
    boundaries."""
    polygons, colours = [], []
    for (name, faces), colour in zip(boundaries.items(), colours_of(boundaries).values()):
        normals = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
        facing = normals @ towards / np.linalg.norm(normals, axis=1)
        seen = facing > 0.
        polygons.extend(faces[seen])
        colours.extend((0.55 + 0.45 * facing[seen, None]) * np.array(colour))
        if name in named and seen.any():
            middle = faces[seen].mean(axis=1)
            place = middle[np.argmin(np.linalg.norm(middle - middle.mean(axis=0), axis=1))]
            axis.text(*(place + 0.02 * towards), name, fontsize=8, ha="center", zorder=100,
                      bbox={"boxstyle": "round", "fc": colour, "alpha": 0.8})
    axis.add_collection3d(Poly3DCollection(polygons, facecolors=colours, edgecolors="none"))
    points = np.concatenate([faces.reshape(-1, 3) for faces in boundaries.values()])
    low, high = points.min(axis=0), points.max(axis=0)
    for d, limits in enumerate((axis.set_xlim, axis.set_ylim, axis.set_zlim)):
        limits(low[d], high[d])
    axis.locator_params(nbins=4)
    axis.set_box_aspect(np.maximum(high - low, 1e-3 * (high - low).max()))


def draw_body(path, directory):
    dim, boundaries = read_boundaries(path)
    body = pathlib.Path(path).stem
    if dim == 1:
        figure, axis = plt.subplots(figsize=(7., 6.), layout="constrained")
        draw_flat(axis, boundaries)
    else:
        # Each boundary has its name in the view that shows most of it.
        views = [(25., 35.), (-35., 215.)]
        named = {name: max(views, key=lambda view: seen_area(faces, direction_of(*view)))
                 for name, faces in boundaries.items()}
        figure = plt.figure(figsize=(12., 6.))
        figure.subplots_adjust(left=0., right=1., bottom=.1, top=.88, wspace=0.)
        for place, view in enumerate(views):
            axis = figure.add_subplot(1, 2, place + 1, projection="3d", computed_zorder=True)
            axis.view_init(*view)
            draw_solid(axis, boundaries, direction_of(*view),
                       {name for name, of_name in named.items() if of_name == view})
    figure.suptitle(f"{pathlib.Path(directory).resolve().name}: boundaries of body {body}" +
                    (", from above, and from below and behind" if dim == 2 else ""))
    drawing.save(figure, directory, f"faces-{body}.png")


def draw_faces(directory):
    """Draw faces-BODY.png for each CAD body of an output directory. Return their number."""
    meshes = sorted(pathlib.Path(directory, "cad").glob("*.msh"))
    for mesh in meshes:
        draw_body(mesh, directory)
    return len(meshes)
