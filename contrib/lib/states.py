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
from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataReader

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


def children(block):
    """Return the named children of a block."""
    return {block.GetMetaData(k).Get(block.NAME()): block.GetBlock(k)
            for k in range(block.GetNumberOfBlocks())}


def joined(grids):
    """Return one grid with all points and cells."""
    append = vtkAppendFilter()
    for grid in grids:
        append.AddInputData(grid)
    if append.GetNumberOfInputConnections(0) == 0:
        return vtkUnstructuredGrid()
    append.Update()
    return append.GetOutput()


def read_blocks(path):
    """Return the grids of the bodies and of the boundaries of a .vtm file by name."""
    reader = vtkXMLMultiBlockDataReader()
    reader.SetFileName(existing(path))
    vtk_base.vtkObject.GlobalWarningDisplayOff()
    reader.Update()
    damaged = PlotError(f"file '{path}' or one of its pieces is damaged")
    groups = children(reader.GetOutput())
    if not set(groups) <= {"bodies", "boundaries"}:
        raise damaged
    result = {"bodies": {}, "boundaries": {}}
    for group, block in groups.items():
        for name, parts in children(block).items():
            pieces = [parts.GetPiece(k) for k in range(parts.GetNumberOfPieces())]
            if any(piece is None or not piece.GetPointData().HasArray("body")
                   for piece in pieces):
                raise damaged
            if pieces:
                result[group][name] = joined(pieces)
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
    """Return the point indices of the cells; all cells have the same number of them."""
    if grid.GetNumberOfCells() == 0:
        return np.zeros((0, 2), dtype=int)
    indices = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    return indices.reshape(grid.GetNumberOfCells(), -1)
