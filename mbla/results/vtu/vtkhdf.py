"""Meshes in VTKHDF, the HDF5 format of ParaView: several unstructured grids in one file, each with its steps in time.

The layout is that of VTK's own specification, version 2.5 where a grid has polyhedra, else 2.1
(https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format). The file is a partitioned data set collection;
cells and their data stand in it once, corners once for each step.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.results.hdf5.result_file import PlainFile

Arrays = dict[str, np.typing.NDArray[Any]]

CELL_TYPES = {"vertex": 1, "polygon": 7, "tetra": 10, "hexahedron": 12, "wedge": 13, "polyhedron": 42}
"""numbers of VTK for the cells that are written"""
PLAIN, WITH_POLYHEDRA = (2, 1), (2, 5)
"""versions of the format that the files need"""


@dataclass(frozen=True)
class Faces:
    """Faces of polyhedra, all cells of a grid being polyhedra.

    corners    : vertices of all faces
    starts     : (n_faces + 1,) first corner of each
    cell_start : (n_cells + 1,) first face of each cell; faces are numbered through
    """

    corners: IntArray
    starts: IntArray
    cell_start: IntArray


@dataclass(frozen=True)
class Grid:
    """An unstructured grid that moves.

    points    : (n_steps, n_points, 3)
    types     : (n_cells,) numbers of VTK
    corners   : points of all cells
    starts    : (n_cells + 1,) first corner of each
    cell_data : (n_cells, ...) arrays by name
    faces     : of polyhedra
    units     : of the arrays by name; empty for plain numbers
    """

    name: str
    points: FloatArray
    types: IntArray
    corners: IntArray
    starts: IntArray
    cell_data: Arrays
    faces: Faces | None = None
    units: Mapping[str, str] = field(default_factory=dict)


def vtkhdf_content(grids: Sequence[Grid], times: Sequence[float], notes: Mapping[str, Any]) -> PlainFile:
    """The file as arrays and attributes by path.

    times : of the steps, as many as each grid has
    notes : single numbers and texts, as attributes of the root; readers of VTK do not look there, and those of
            collections leave out field data
    """
    version = WITH_POLYHEDRA if any(grid.faces is not None for grid in grids) else PLAIN
    head = {"Version": np.array(version, dtype=np.int64)}
    arrays: Arrays = {}
    attributes: dict[str, dict[str, Any]] = {
        "/": dict(notes),
        "VTKHDF": {**head, "Type": "PartitionedDataSetCollection"},
    }
    for row, grid in enumerate(grids):
        root = f"VTKHDF/{grid.name}"
        content = _geometry(grid) | _data(grid)
        arrays |= {f"{root}/{path}": array for path, array in content.items()}
        arrays[f"{root}/Steps/Values"] = np.array(times, dtype=np.float64)
        attributes[root] = {**head, "Type": "UnstructuredGrid", "Index": np.int64(row)}
        attributes[f"{root}/Steps"] = {"NSteps": np.int64(len(times))}
        for name, unit in grid.units.items():
            attributes[f"{root}/CellData/{name}"] = {"units": unit or "1"}
        attributes[f"{root}/PointData/displacement"] = {"units": grid.units.get("displacement", "1")}
    links = {f"VTKHDF/Assembly/{grid.name}/{grid.name}": f"/VTKHDF/{grid.name}" for grid in grids}
    return PlainFile(arrays, attributes, links)


def _geometry(grid: Grid) -> Arrays:
    """Cells once, points of every step one after the other."""
    n_steps, n_points, _ = grid.points.shape
    one, none = np.zeros(n_steps, dtype=np.int64), np.zeros((n_steps, 1), dtype=np.int64)
    content: Arrays = {
        "NumberOfPoints": np.array([n_points]),
        "NumberOfCells": np.array([len(grid.types)]),
        "NumberOfConnectivityIds": np.array([len(grid.corners)]),
        "Points": grid.points.reshape(-1, 3),
        "Types": grid.types.astype(np.uint8),
        "Connectivity": grid.corners,
        "Offsets": grid.starts,
        "Steps/NumberOfParts": one + 1,
        "Steps/PartOffsets": one,
        "Steps/PointOffsets": n_points * np.arange(n_steps),
        "Steps/CellOffsets": none,
        "Steps/ConnectivityIdOffsets": none,
    }
    faces = grid.faces
    if faces is None:
        return content
    n_faces = len(faces.starts) - 1
    return content | {
        "NumberOfFaces": np.array([n_faces]),
        "NumberOfFaceConnectivityIds": np.array([len(faces.corners)]),
        "NumberOfPolyhedronToFaceIds": np.array([n_faces]),
        "FaceConnectivity": faces.corners,
        "FaceOffsets": faces.starts,
        "PolyhedronToFaces": np.arange(n_faces),
        "PolyhedronOffsets": faces.cell_start,
        "Steps/FaceConnectivityOffsets": one,
        "Steps/FaceOffsetsOffsets": one,
        "Steps/PolyhedronToFaceIdOffsets": one,
    }


def _data(grid: Grid) -> Arrays:
    """Displacements of every step, data of cells once; their offsets."""
    n_steps, n_points, _ = grid.points.shape
    zero = np.zeros(n_steps, dtype=np.int64)
    content: Arrays = {
        "PointData/displacement": (grid.points - grid.points[0]).reshape(-1, 3),
        "Steps/PointDataOffsets/displacement": n_points * np.arange(n_steps),
    }
    for name, array in grid.cell_data.items():
        content |= {f"CellData/{name}": array, f"Steps/CellDataOffsets/{name}": zero}
    return content
