"""VTU files read back by vtk."""

import warnings
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

WEDGE = 13
"""number of the cell type"""


def read_vtk(path: Path) -> Any:
    """The grid as vtk reads it; its reader must not complain."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", category=DeprecationWarning, module="vtk.*")
        from vtkmodules.vtkCommonCore import vtkObject
        from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

        vtkObject.GlobalWarningDisplayOff()
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(path))
        complaints = []
        reader.AddObserver("ErrorEvent", lambda *_: complaints.append("error"))  # type: ignore[arg-type]
        reader.Update()
        assert not complaints
        return reader.GetOutput()


def vtk_volumes(path: Path) -> Any:
    """Signed-by-orientation volume of every cell, as vtk sums it from the cell's own faces or nodes."""
    return grid_volumes(read_vtk(path))


def grid_volumes(grid: Any) -> Any:
    """The same of a grid that was read."""
    from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter

    sizes = vtkCellSizeFilter()
    sizes.SetInputData(grid)
    sizes.Update()
    array = sizes.GetOutput().GetCellData().GetArray("Volume")
    volumes = np.array([array.GetValue(i) for i in range(array.GetNumberOfTuples())])
    if vtk_version() < (9, 7):  # wedges had the other sign until then
        wedges = [grid.GetCellType(i) == WEDGE for i in range(len(volumes))]
        volumes[wedges] *= -1
    return volumes


def vtk_version() -> tuple[int, ...]:
    """Of the vtk that is installed, its first two numbers."""
    return tuple(map(int, version("vtk").split(".")[:2]))


def vtk_array(data: Any, name: str) -> Any:
    """One array of point or cell data."""
    array = data.GetArray(name)
    values = [array.GetTuple(i) for i in range(array.GetNumberOfTuples())]
    return np.array(values)[:, 0] if array.GetNumberOfComponents() == 1 else np.array(values)
