"""The formats that meshio reads and writes (only importer of meshio).

Volume cells are blocks, one each; files without any hold surfaces, whose closed parts are the blocks.
"""

from __future__ import annotations

import contextlib
import io
import logging
import zlib
from collections.abc import Iterator, Mapping, Sequence
from functools import cache, partial
from itertools import chain
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np

from mbla.arrays import FloatArray, IntArray, starts
from mbla.errors import FileError, Notice
from mbla.model.geometry.geometry import Geometry, GeometryFileError, cells_left_out, check_rows, unused_points
from mbla.model.geometry.meshio_guards import (
    CELLS,
    VARIABLE,
    announced_in_vtu,
    checked_cells,
    refuse_other_count,
    refuse_other_faces,
    refuse_other_sections,
)
from mbla.model.geometry.surfaces import VOLUME_CELLS
from mbla.model.geometry.welding import own_vertices, surfaces_by_label
from mbla.model.solids.polyhedra import Polyhedra, join_polyhedra, polyhedra_from_cells

SURFACE_CELLS = {"triangle": 3, "VTK_LAGRANGE_TRIANGLE": 3, "quad": 4, "VTK_LAGRANGE_QUADRILATERAL": 4, "polygon": 0}
"""number of corners; 0 where it is that of the cell"""
WORDS = {"vtu": "VTU", "gmsh": "Gmsh .msh"}
WITHOUT_DIMENSION = {"wedge12": 3, "wedge15": 3, "pyramid13": 3, "hexahedron24": 3, "penta_prism": 3, "hexa_prism": 3}
WITHOUT_DIMENSION |= {"quad6": 2, "triangle7": 2}
"""cells that meshio's readers know and its mesh does not, for want of a number of dimensions"""
COMPRESSION = 1
"""level of zlib in VTU files, which meshio cannot be told: coordinates and forces hardly get smaller by a higher one
(0.4 % of an animation frame of 10,000 blocks), and writing takes twice as long at its 6"""


BYTES_OF_A_POINT, MOST_PACKED = 24, 50
"""of three coordinates; and how many times its size a packed file may hold, which of blocks is some ten times"""


def read_vtu(path: Path) -> Geometry:
    """Volume cells, or closed parts of surfaces, of a VTU file.

    Raises
    ------
    GeometryFileError
        for malformed files, and those that announce far more than their size can hold
    """
    points, cells = announced_in_vtu(path)
    if points * BYTES_OF_A_POINT > MOST_PACKED * path.stat().st_size:
        words = f"announces {points:,} points, far more than its size can hold: damaged or packed; export it anew"
        raise GeometryFileError("geometry-too-large", words)
    geometry, mesh = _read(str(path), "vtu")
    refuse_other_count("VTU", "point", points, len(mesh.points))
    refuse_other_count("VTU", "cell", cells, sum(len(block.data) for block in mesh.cells))
    return geometry


def read_msh(path: Path) -> Geometry:
    """Volume cells, or closed parts of surfaces, of a Gmsh file.

    Raises
    ------
    GeometryFileError
        for malformed files
    """
    refuse_other_sections(path)  # before room is made for what they announce
    geometry, _ = _read(str(path), "gmsh")
    return geometry


def _read(path: str, file_format: str) -> tuple[Geometry, Any]:
    """What the file holds, and the same as meshio gives it."""
    mesh, remarks = _mesh(path, file_format)
    points = _points(mesh)
    volumes = [
        block for block in mesh.cells if _shape(block.type) in VOLUME_CELLS or block.type.startswith("polyhedron")
    ]
    surfaces = [block for block in mesh.cells if _shape(block.type) in SURFACE_CELLS]
    used = volumes or surfaces
    others = [block for block in mesh.cells if not any(block is other for other in used) and block.type != "vertex"]
    left_out = (block.type for block in others for _ in range(len(block.data)))  # single points are not worth a word
    notices = [*remarks, *cells_left_out(left_out, bool(volumes)), *unused_points(len(points), _rows_of(mesh))]
    if volumes:
        cells = join_polyhedra([_volume_cells(points, block) for block in volumes])
        return Geometry(cells, tuple(notices), _physical_groups(mesh, volumes), cells=True), mesh
    faces = list(chain.from_iterable(_surface_cells(block) for block in surfaces))
    check_rows(np.fromiter(chain.from_iterable(faces), dtype=np.int64), len(points))
    names = _physical_groups(mesh, surfaces)
    surface, present = surfaces_by_label(points, faces, names or ("",) * len(faces))
    return Geometry(surface, tuple(notices), tuple(present) if names else ()), mesh


def _rows_of(mesh: Any) -> IntArray:
    """Rows of points that any cell names, whatever its type."""
    rows = [np.ravel(each) for block in mesh.cells for cell in block.data for each in _parts(block, cell)]
    return np.concatenate([np.empty(0, dtype=np.int64), *rows]).astype(np.int64)


def _parts(block: Any, cell: Any) -> Sequence[Any]:
    """Faces of a polyhedron; another cell as it is."""
    return list(cell) if block.type.startswith("polyhedron") else [cell]


def _physical_groups(mesh: Any, used: Sequence[Any]) -> tuple[str, ...]:
    """Name of the physical group of each cell of some of Gmsh's blocks of cells; nothing where no group has a name."""
    tags = mesh.cell_data.get("gmsh:physical")
    words = {(int(tag), int(dimension)): name for name, (tag, dimension) in mesh.field_data.items()}
    if tags is None or not words:
        return ()
    names: list[str] = []
    for block, of_block in zip(mesh.cells, tags, strict=True):
        if any(block is other for other in used):
            names += [words.get((int(tag), block.dim), "") for tag in of_block]
    return tuple(names)


def _mesh(path: str, file_format: str) -> tuple[Any, list[Notice]]:
    """The file as meshio gives it, and what meshio would have printed."""
    printed = io.StringIO()
    try:
        meshio = _meshio()
        with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed), np.errstate(all="ignore"):
            # the reader itself: meshio.read prints, and ends the program, where a file is malformed
            mesh = getattr(meshio, file_format).read(path)
    except (GeometryFileError, MemoryError, OSError):
        raise
    except (Exception, SystemExit) as error:  # the readers let all kinds of exceptions through
        reason = " ".join(f"{printed.getvalue()} {error}".split())
        reason = f": {reason[:200]}" if reason and reason != type(error).__name__ else ""
        raise GeometryFileError("geometry-file", f"is not a well-formed {WORDS[file_format]} file{reason}") from error
    words = " ".join(printed.getvalue().split())
    return mesh, [Notice("warning", "mesh-file-remarks", words[:500])] if words else []


@cache
def _meshio() -> Any:
    """The library, imported late, for it takes half a second, and completed."""
    import meshio
    from meshio._common import num_nodes_per_cell
    from meshio._mesh import topological_dimension
    from meshio.vtu import _vtu

    for kind, dimension in WITHOUT_DIMENSION.items():
        topological_dimension.setdefault(kind, dimension)
    for number in CELLS.keys() - VARIABLE:
        num_nodes_per_cell.setdefault(*CELLS[number])
    cells_of, polyhedra_of = _vtu.vtk_cells_from_data, _vtu._polyhedron_cells_from_data

    def checked_cells_of(points: IntArray, offsets: IntArray, types: IntArray, data: Any) -> Any:
        return cells_of(*checked_cells(points, offsets, types), data) if len(types) else ([], {})

    def checked_polyhedra_of(offsets: IntArray, faces: IntArray, ends: IntArray, data: Any) -> Any:
        refuse_other_faces(faces, ends)
        return polyhedra_of(offsets, faces, ends, data)

    _vtu.vtk_cells_from_data, _vtu._polyhedron_cells_from_data = checked_cells_of, checked_polyhedra_of
    _vtu.zlib = SimpleNamespace(compress=partial(zlib.compress, level=COMPRESSION), decompress=zlib.decompress)
    return meshio


def _points(mesh: Any) -> FloatArray:
    points = np.asarray(mesh.points, dtype=np.float64)
    if not points.size:
        return np.empty((0, 3))
    if points.ndim != 2 or points.shape[1] not in (2, 3):
        raise GeometryFileError("geometry-file", "the points have neither two nor three coordinates")
    if points.shape[1] == 2:
        points = np.concatenate([points, np.zeros((len(points), 1))], axis=1)
    return points


def _shape(cell_type: str) -> str:
    """``hexahedron`` for ``hexahedron20``: names of cells of higher order end in their number of nodes."""
    return cell_type.rstrip("0123456789")


def _volume_cells(points: FloatArray, block: Any) -> Polyhedra:
    if block.type.startswith("polyhedron"):
        return _polyhedron_cells(points, block.data)
    count, faces = VOLUME_CELLS[_shape(block.type)]
    rows = np.asarray(block.data, dtype=np.int64)
    if rows.ndim != 2 or rows.shape[1] < count:
        raise GeometryFileError("geometry-file", f"a cell of type {block.type} has fewer than {count} points")
    rows = rows[:, :count]
    check_rows(rows, len(points))
    return polyhedra_from_cells(points[rows], faces)


def _polyhedron_cells(points: FloatArray, cells: Any) -> Polyhedra:
    """Cells given by faces, each face by rows of points."""
    faces = [np.asarray(face, dtype=np.int64) for cell in cells for face in cell]
    block = np.repeat(np.arange(len(cells)), [len(cell) for cell in cells])
    counts = np.array([len(face) for face in faces], dtype=np.int64)
    corners = np.concatenate(faces)
    check_rows(corners, len(points))
    return own_vertices(points, corners, starts(counts), block)


def _surface_cells(block: Any) -> Iterator[Sequence[int]]:
    rows = np.asarray(block.data, dtype=np.int64)
    count = SURFACE_CELLS.get(_shape(block.type), 0)
    yield from (rows[:, :count] if count else rows).tolist()


def write_mesh(
    path: Path,
    points: FloatArray,
    cells: Sequence[tuple[str, Any]],
    point_data: Mapping[str, Any] | None = None,
    cell_data: Mapping[str, Sequence[Any]] | None = None,
    file_format: str = "vtu",
) -> None:
    """Write points, cells and data on them to a file; what meshio would print is logged as a warning.

    points     : (n_points, 3)
    cells      : meshio's (type, rows of points) blocks; polyhedra cannot be mixed with other types
    point_data : by name, (n_points,) or (n_points, k)
    cell_data  : by name, one array per entry of ``cells``; no booleans and no text

    Raises
    ------
    FileError
        where the file cannot be written
    """
    meshio = _meshio()
    printed = io.StringIO()
    try:
        with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
            mesh = meshio.Mesh(
                points,
                list(cells),
                point_data=dict(point_data or {}),
                cell_data={name: list(arrays) for name, arrays in (cell_data or {}).items()},
            )
            meshio.write(path, mesh, file_format=file_format)
    except OSError as error:
        raise FileError("file-not-written", f"{path}: cannot be written: {error.strerror or error}") from error
    if remarks := " ".join(printed.getvalue().split()):
        logging.getLogger(__name__).warning("%s: %s", path, remarks)
