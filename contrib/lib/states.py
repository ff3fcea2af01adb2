"""Read the states that a run of snug leaves behind (*.pvd, *.vtu)."""

import os
import xml.etree.ElementTree

import numpy as np
import vtkmodules.vtkCommonCore as vtk_base
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import (vtkXMLPUnstructuredGridReader,
                                 vtkXMLUnstructuredGridReader)


class PlotError(Exception):
    """This class is one line that says what is missing."""


def existing(path):
    if not os.path.isfile(path):
        raise PlotError(f"no file '{path}'; did the run finish?")
    return path


def read_states(directory, name):
    """Return the first and the last state of a series as [(time, grid)], one entry if there is
    only one."""
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
    return [(time, read_grid(os.path.join(directory, file)))
            for time, file in shown]


def read_grid(path):
    existing(path)
    reader = (vtkXMLPUnstructuredGridReader() if path.endswith(".pvtu")
              else vtkXMLUnstructuredGridReader())
    reader.SetFileName(path)
    vtk_base.vtkObject.GlobalWarningDisplayOff()
    reader.Update()
    if not reader.GetOutput().GetPointData().HasArray("body"):
        raise PlotError(f"file '{path}' or one of its pieces is damaged")
    return reader.GetOutput()


def points_of(grid):
    if grid.GetNumberOfPoints() == 0:
        return np.zeros((0, 3))
    return vtk_to_numpy(grid.GetPoints().GetData()).astype(float)


def array_of(grid, name):
    return vtk_to_numpy(grid.GetPointData().GetArray(name)).astype(float)


def cells_of(grid):
    """Return the point indices of the cells; all cells have the same number of them."""
    if grid.GetNumberOfCells() == 0:
        return np.zeros((0, 2), dtype=int)
    indices = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    return indices.reshape(grid.GetNumberOfCells(), -1)
