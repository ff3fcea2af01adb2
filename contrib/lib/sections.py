"""Cut bodies by a plane: polygons with their fields."""

import numpy as np
import vtkmodules.vtkCommonCore as vtk_base
import vtkmodules.vtkCommonDataModel as vtk_data
import vtkmodules.vtkFiltersCore as vtk_filters
from vtkmodules.util.numpy_support import numpy_to_vtk

from states import array_of, cells_of, points_of


def bodies_of(grid):
    """Return the grid of each body, with one point per node instead of one per cell.
    Copies of a node agree in their last bit: they are written from one."""
    points = points_of(grid)
    body = array_of(grid, "body")
    cells = cells_of(grid)
    result = []
    for number in np.unique(body):
        own = cells[body[cells[:, 0]] == number]
        _, first, place = np.unique(points[own.ravel()], axis=0,
                                    return_index=True, return_inverse=True)
        part = vtk_data.vtkUnstructuredGrid()
        nodes = vtk_base.vtkPoints()
        nodes.SetDataTypeToDouble()
        source = own.ravel()[first]
        nodes.SetData(numpy_to_vtk(points[source], deep=True))
        part.SetPoints(nodes)
        connectivity = vtk_data.vtkCellArray()
        connectivity.SetData(own.shape[1], numpy_to_vtk(
            place.ravel().astype(np.int64), deep=True,
            array_type=vtk_base.VTK_ID_TYPE))
        part.SetCells(grid.GetCellType(0), connectivity)
        for name in ("von_mises", "displacement"):
            data = numpy_to_vtk(array_of(grid, name)[source], deep=True)
            data.SetName(name)
            part.GetPointData().AddArray(data)
        result.append(part)
    return result


def cut(grid, axis, place):
    """Return the bodies in the plane across axis at the coordinate place; with axis None the
    bodies themselves, which are flat. Points keep their fields."""
    if axis is None:
        return bodies_of(grid)
    bounds = np.reshape(grid.GetBounds(), (3, 2))
    extent = np.ptp(bounds, axis=1).max()
    plane = vtk_data.vtkPlane()
    # a little towards the middle, as faces of cells may lie there
    origin = bounds.mean(axis=1)
    inwards = 1. if place <= origin[axis] else -1.
    origin[axis] = place + inwards * 1e-4 * np.ptp(bounds[axis])
    plane.SetOrigin(origin)
    plane.SetNormal([float(k == axis) for k in range(3)])
    sections = []
    for body in bodies_of(grid):
        cutter = vtk_filters.vtkCutter()
        cutter.SetCutFunction(plane)
        cutter.SetInputData(body)
        cutter.GenerateTrianglesOff()
        # edges of coarse and fine cells meet the plane in the same place, but
        # for the single precision of the file
        cleaner = vtk_filters.vtkCleanPolyData()
        cleaner.SetInputConnection(cutter.GetOutputPort())
        cleaner.ToleranceIsAbsoluteOn()
        cleaner.SetAbsoluteTolerance(1e-5 * extent)
        cleaner.Update()
        if cleaner.GetOutput().GetNumberOfCells():
            sections.append(cleaner.GetOutput())
    return sections


def polygons_of(dataset):
    """Return the corner indices of the two-dimensional cells, in order around them."""
    polygons = []
    for index in range(dataset.GetNumberOfCells()):
        cell = dataset.GetCell(index)  # valid until the next call
        if cell.GetCellDimension() == 2:
            polygons.append([cell.GetPointId(k)
                             for k in range(cell.GetNumberOfPoints())])
    return polygons


def outline(polygons):
    """Return point pairs of the edges on the boundary of the bodies: those of one polygon only, without the three at every hanging node."""
    count = {}
    for polygon in polygons:
        for edge in zip(polygon, polygon[1:] + polygon[:1]):
            edge = tuple(sorted(edge))
            count[edge] = count.get(edge, 0) + 1
    single = {edge for edge, times in count.items() if times == 1}
    neighbours = {}
    for a, b in single:
        neighbours.setdefault(a, set()).add(b)
        neighbours.setdefault(b, set()).add(a)
    hanging = set()
    for a, b in single:
        for middle in neighbours[a] & neighbours[b]:
            hanging |= {(a, b), tuple(sorted((a, middle))),
                        tuple(sorted((middle, b)))}
    return sorted(single - hanging)
