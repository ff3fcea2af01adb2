"""Cut bodies by a plane, and look into the remaining half: polygons and lines with their fields."""

import collections

import numpy as np
import vtkmodules.vtkCommonDataModel as vtk_data
import vtkmodules.vtkFiltersCore as vtk_filters
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersGeneral import vtkClipDataSet

from states import PlotError, array_of, points_of

# Deformed points, polygons of point indices, von Mises stresses, and lines as pairs of points.
Faces = collections.namedtuple("Faces", "points polygons values lines")


def bounds_of(state):
    """Return the lower and the upper corner of all bodies."""
    boxes = np.array([body.GetBounds() for body in state.bodies.values()])
    return boxes[:, ::2].min(axis=0), boxes[:, 1::2].max(axis=0)


def is_flat(state):
    low, high = bounds_of(state)
    return high[2] == low[2]


def plane_at(state, axis, place):
    """Return the plane across an axis, a little nearer to the middle of the bodies, because faces
    of cells may lie at the place."""
    low, high = bounds_of(state)
    if not low[axis] <= place <= high[axis]:
        raise PlotError(f"--cut: the bodies reach from {'xyz'[axis]} = {low[axis]:g} to "
                        f"{high[axis]:g}, and {place:g} is outside")
    origin = (low + high) / 2.
    inwards = 1. if place <= origin[axis] else -1.
    origin[axis] = place + inwards * 1e-4 * (high - low)[axis]
    plane = vtk_data.vtkPlane()
    plane.SetOrigin(origin)
    plane.SetNormal([float(k == axis) for k in range(3)])
    return plane


def cells_at(grid, plane):
    """Return the polygons in which a plane meets solids, or the lines in which it meets faces."""
    cutter = vtk_filters.vtkCutter()
    cutter.SetCutFunction(plane)
    cutter.SetInputData(grid)
    cutter.GenerateTrianglesOff()
    cutter.Update()
    return cutter.GetOutput()


def lists_of(cells):
    """Return the point indices of each cell of a vtkCellArray."""
    ends = vtk_to_numpy(cells.GetOffsetsArray())[1:-1]
    return np.split(vtk_to_numpy(cells.GetConnectivityArray()), ends) \
        if cells.GetNumberOfCells() else []


def polygons_of(dataset):
    """Return the point indices around each polygon. Quadratic triangles list the middles of their
    edges behind their corners."""
    if dataset.IsA("vtkPolyData"):
        return lists_of(dataset.GetPolys())
    return [cell[[0, 3, 1, 4, 2, 5]] if len(cell) == 6 else cell
            for cell in lists_of(dataset.GetCells())]


def deformed(dataset):
    displacement = array_of(dataset, "displacement")
    return points_of(dataset) + displacement.reshape(-1, 3)


def lines_of(dataset):
    """Return the ends of the lines of a cut, or of faces of flat bodies."""
    cells = dataset.GetLines() if dataset.IsA("vtkPolyData") else dataset.GetCells()
    pairs = [list(cell[k:k + 2]) for cell in lists_of(cells) for k in range(len(cell) - 1)]
    return deformed(dataset)[np.array(pairs, dtype=int).reshape(-1, 2)]


def merged(parts):
    """Return several Faces as one."""
    parts = [part for part in parts if len(part.points)]
    if not parts:
        return Faces(np.zeros((0, 3)), [], np.zeros(0), np.zeros((0, 2, 3)))
    first = np.cumsum([0] + [len(part.points) for part in parts])
    return Faces(np.concatenate([part.points for part in parts]),
                 [polygon + start for part, start in zip(parts, first) for polygon in part.polygons],
                 np.concatenate([part.values for part in parts]),
                 np.concatenate([part.lines for part in parts]))


def section(state, plane):
    """Return the Faces in a plane; None: the flat bodies themselves."""
    def met(grid):
        return grid if plane is None else cells_at(grid, plane)
    bodies = [met(body) for body in state.bodies.values()]
    lines = [lines_of(met(side)) for side in state.boundaries.values()]
    result = merged(Faces(deformed(body), polygons_of(body), array_of(body, "von_mises"),
                          np.zeros((0, 2, 3))) for body in bodies)
    return result._replace(lines=np.concatenate([np.zeros((0, 2, 3)), *lines]))


def area_vectors(points, polygons):
    """Return the normals of polygons, with their areas as lengths."""
    counts = np.array([len(polygon) for polygon in polygons])
    corners = np.concatenate(polygons)
    first = np.concatenate([[0], np.cumsum(counts)[:-1]])
    following = np.arange(1, len(corners) + 1)
    following[first + counts - 1] = first
    return np.add.reduceat(np.cross(points[corners], points[corners[following]]), first) / 2.


def halves(state, plane, axis, side, view):
    """Return the Faces of each body on the side of a plane away from the viewer, from far to near:
    what is seen of their boundaries, and the section. side: on which side of it the viewer is."""
    result = []
    for name, body in state.bodies.items():
        parts, lines = [], [np.zeros((0, 2, 3))]
        for of_side, boundary in state.boundaries.items():
            if of_side.startswith(name + "."):
                clip = vtkClipDataSet()
                clip.SetInputData(boundary)
                clip.SetClipFunction(plane)
                clip.SetInsideOut(int(side > 0))
                clip.Update()
                parts.append(seen(clip.GetOutput(), view))
                lines.append(lines_of(cells_at(boundary, plane)))
        cut = cells_at(body, plane)
        parts.append(Faces(deformed(cut), polygons_of(cut), array_of(cut, "von_mises"),
                           np.concatenate(lines)))
        result.append(merged(parts))
    return sorted((part for part in result if part.polygons),
                  key=lambda part: view.depth(part.points.mean(axis=0)))


def seen(grid, view):
    """Return the Faces of a boundary that look towards the viewer, with its edges."""
    points, polygons = deformed(grid), polygons_of(grid)
    if not polygons:
        return merged([])
    front = area_vectors(points, polygons) @ view.towards > 0.
    polygons = [polygon for polygon, is_front in zip(polygons, front) if is_front]
    return Faces(points, polygons, array_of(grid, "von_mises"), outline(points, polygons))


def outline(points, polygons):
    """Return the ends of the edges of one polygon only, without the three at every hanging node."""
    if not polygons:
        return np.zeros((0, 2, 3))
    extent = np.ptp(points, axis=0).max()
    _, number = np.unique(np.round(points / extent, 6), axis=0, return_inverse=True)
    number = number.ravel()
    count, ends = {}, {}
    for polygon in polygons:
        for edge in zip(polygon, np.roll(polygon, -1)):
            key = tuple(sorted(number[list(edge)]))
            count[key] = count.get(key, 0) + 1
            ends[key] = edge
    single = {edge for edge, times in count.items() if times == 1 and edge[0] != edge[1]}
    neighbours = {}
    for a, b in single:
        neighbours.setdefault(a, set()).add(b)
        neighbours.setdefault(b, set()).add(a)
    hanging = {tuple(sorted(edge)) for a, b in single for middle in neighbours[a] & neighbours[b]
               for edge in ((a, b), (a, middle), (middle, b))}
    return points[np.array([ends[edge] for edge in sorted(single - hanging)],
                           dtype=int).reshape(-1, 2)]

