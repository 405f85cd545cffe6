"""VTU files read back by vtk."""

import warnings
from pathlib import Path
from typing import Any

import numpy as np


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
    from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter

    sizes = vtkCellSizeFilter()
    sizes.SetInputData(read_vtk(path))
    sizes.Update()
    array = sizes.GetOutput().GetCellData().GetArray("Volume")
    return np.array([array.GetValue(i) for i in range(array.GetNumberOfTuples())])


def vtk_array(data: Any, name: str) -> Any:
    """One array of point or cell data."""
    array = data.GetArray(name)
    values = [array.GetTuple(i) for i in range(array.GetNumberOfTuples())]
    return np.array(values)[:, 0] if array.GetNumberOfComponents() == 1 else np.array(values)
