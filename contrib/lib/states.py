"""Read the states that a run of snug leaves behind (*.pvd, *.vtm) and what its summary says."""

import collections
import json
import os
import xml.etree.ElementTree

import numpy as np
import vtkmodules.vtkCommonCore as vtk_base
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid
from vtkmodules.vtkFiltersCore import vtkAppendFilter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

# The time, and the grids of {"bodies": {NAME: grid}, "boundaries": {BODY.NAME: grid}}.
State = collections.namedtuple("State", "time bodies boundaries")


class PlotError(Exception):
    """This class is one line that says what is missing."""


def existing(path):
    if not os.path.isfile(path):
        raise PlotError(f"no file '{path}'; did the run finish?")
    return path


def read_states(directory, name):
    """Return the first and the last State of a series, one if there is only one."""
    path = existing(os.path.join(directory, name))
    try:
        entries = [(float(entry.get("timestep")), entry.get("file"))
                   for entry in xml.etree.ElementTree.parse(path)
                   .iter("DataSet")]
    except (xml.etree.ElementTree.ParseError, TypeError, ValueError):
        raise PlotError(f"file '{path}' is damaged") from None
    if not entries:
        raise PlotError(f"file '{path}' lists no states")
    shown = entries[:1] if len(entries) == 1 else [entries[0], entries[-1]]
    return [State(time, *read_blocks(os.path.join(directory, file))) for time, file in shown]


def joined(grids):
    """Return one grid with all points and cells."""
    append = vtkAppendFilter()
    for grid in grids:
        append.AddInputData(grid)
    if append.GetNumberOfInputConnections(0) == 0:
        return vtkUnstructuredGrid()
    append.Update()
    return append.GetOutput()


def read_grid(path):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(existing(path))
    vtk_base.vtkObject.GlobalWarningDisplayOff()
    reader.Update()
    if not reader.GetOutput().GetPointData().HasArray("body"):
        raise PlotError(f"file '{path}' is damaged")
    return reader.GetOutput()


def read_blocks(path):
    """Return the grids of the bodies and of the boundaries of a .vtm file by name. VTK's reader of
    such files takes a damaged piece for the piece before it."""
    result = {"bodies": {}, "boundaries": {}}
    try:
        for group in xml.etree.ElementTree.parse(existing(path)).getroot()[0]:
            for block in group:
                files = [os.path.join(os.path.dirname(path), entry.get("file"))
                         for entry in block.iter("DataSet") if entry.get("file")]
                if files:
                    result[group.get("name")][block.get("name")] = joined(map(read_grid, files))
    except (xml.etree.ElementTree.ParseError, IndexError, KeyError, TypeError):
        raise PlotError(f"file '{path}' is damaged") from None
    return result["bodies"], result["boundaries"]


def summary_of(directory):
    """Return summary.json."""
    path = existing(os.path.join(directory, "summary.json"))
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except ValueError:
        raise PlotError(f"file '{path}' is damaged") from None


def points_of(grid):
    if grid.GetNumberOfPoints() == 0:
        return np.zeros((0, 3))
    return vtk_to_numpy(grid.GetPoints().GetData()).astype(float)


def array_of(grid, name):
    if grid.GetNumberOfPoints() == 0:
        return np.zeros(0)
    return vtk_to_numpy(grid.GetPointData().GetArray(name)).astype(float)


def magnitude_of(grid, name):
    """Return the values of a scalar, or the lengths of the vectors."""
    values = array_of(grid, name)
    return values if values.ndim == 1 else np.linalg.norm(values, axis=1)


def cells_of(grid):
    """Return the point indices of the corners of the cells, equally many of each cell: a quadratic
    triangle, whose middles of edges follow its corners, has its last corner twice."""
    if grid.GetNumberOfCells() == 0:
        return np.zeros((0, 2), dtype=int)
    indices = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    ends = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
    is_triangle = np.diff(ends) == 6
    if not is_triangle.any():
        return indices.reshape(grid.GetNumberOfCells(), -1)
    return indices[ends[:-1, None] + np.where(is_triangle[:, None], [0, 1, 2, 2], [0, 1, 2, 3])]
