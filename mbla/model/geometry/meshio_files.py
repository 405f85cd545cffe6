"""The formats that meshio reads and writes (only importer of meshio).

Volume cells are blocks, one each; files without any hold surfaces, whose closed parts are the blocks. Cells of higher
order go by their corners, which come first.

meshio trusts what cells and sections announce, and blocks would be missing or wrong: of a VTU file it takes as many
points as the type of a cell needs, counted back from its offset, of a Gmsh file as many lines as a section announces.
So these numbers are compared with the content.

Source: VTK file formats, https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html
"""

from __future__ import annotations

import contextlib
import io
import logging
import re
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
from mbla.model.geometry.cells import VOLUME_CELLS
from mbla.model.geometry.geometry import (
    Geometry,
    GeometryFileError,
    cells_left_out,
    check_rows,
    malformed,
    unused_points,
)
from mbla.model.geometry.welding import own_vertices, surfaces_by_label
from mbla.model.solids.polyhedra import Polyhedra, join_polyhedra, polyhedra_from_cells
from mbla.model.solids.ragged import ranges
from mbla.model.wording import counted

SURFACE_CELLS = {"triangle": 3, "quad": 4, "polygon": None}
"""number of corners; None where it is that of the cell"""
POLYHEDRON = "polyhedron"
POLYGON = 7
NODES = {1: 1, 3: 2, 5: 3, POLYGON: 3, 8: 4, 9: 4, 10: 4, 11: 8, 12: 8, 13: 6, 14: 5, 15: 10, 16: 12, 21: 3, 22: 6}
NODES |= {23: 8, 24: 10, 25: 20, 26: 15, 27: 13, 28: 9, 29: 27, 30: 6, 31: 12, 32: 18, 33: 24, 34: 7, 35: 4}
"""number of points of each type of VTK that is read, of polygons the least"""
HIGHER = {3: (21, 35), 5: (22, 34), 9: (23, 28, 30), 10: (24,), 12: (25, 29, 33), 13: (26, 31, 32), 14: (27,)}
PLAIN = {kind: plain for plain, kinds in HIGHER.items() for kind in kinds}
"""type that a cell of higher order is by its corners"""
BY_AXES = {8: (9, (0, 1, 3, 2)), 11: (12, (0, 1, 3, 2, 4, 5, 7, 6))}
"""pixels and voxels, whose points come along the axes: the type that they are, and its points in order around it"""
PRISMS = {"penta_prism": 10, "hexa_prism": 12}
SOLID = (*PRISMS, "wedge15", "pyramid13")
"""cells that meshio's readers know and its mesh does not, for want of a number of points or of dimensions"""
WORDS = {"vtu": "VTU", "gmsh": "Gmsh .msh"}
SECTIONS = {b"Nodes": "node", b"Elements": "element"}
"""sections of a Gmsh file of version 2 that begin with their number of lines"""
COMPRESSION = 1
"""level of zlib in VTU files, which meshio has no option for: coordinates and forces hardly get smaller by a higher one
(0.4 % of an animation frame of 10,000 blocks), and writing takes twice as long at its 6"""


def read_vtu(path: Path) -> Geometry:
    """Volume cells, or closed parts of surfaces, of a VTU file; raises GeometryFileError for malformed ones."""
    return _read(str(path), "vtu")


def read_msh(path: Path) -> Geometry:
    """Volume cells, or closed parts of surfaces, of a Gmsh file; raises GeometryFileError for malformed ones."""
    _refuse_other_sections(path)  # before memory is allocated for what they announce
    return _read(str(path), "gmsh")


def _refuse_other_sections(path: Path) -> None:
    """Refuse a Gmsh file of text, version 2, with a section that has other lines than it announces."""
    content = path.read_bytes()
    if not re.match(rb"\s*\$MeshFormat\s+2\S*\s+0\s", content):
        return
    for name, noun in SECTIONS.items():
        for section in re.findall(rb"^\$" + name + rb"\s*$(.*?)(?=^\$|\Z)", content, re.DOTALL | re.MULTILINE):
            number, *lines = [line for line in section.splitlines() if line.strip()] or [b""]
            if number.strip() != str(len(lines)).encode():
                announced = number.strip().decode(errors="replace")[:20]
                raise malformed(WORDS["gmsh"], f"it announces {announced} {noun}s and has {counted(len(lines), noun)}")


def _read(path: str, file_format: str) -> Geometry:
    """What the file holds."""
    mesh, remarks = _mesh(path, file_format)
    points = _points(mesh)
    volumes = [block for block in mesh.cells if _shape(block.type) in (*VOLUME_CELLS, POLYHEDRON)]
    used = volumes or [block for block in mesh.cells if _shape(block.type) in SURFACE_CELLS]
    others = [block for block in mesh.cells if not any(block is other for other in used) and block.type != "vertex"]
    left_out = (block.type for block in others for _ in range(len(block.data)))  # single points need no remark
    cells_of = [(_shape(block.type), cell) for block in mesh.cells for cell in block.data]
    corners = [np.ravel(face) for shape, cell in cells_of for face in (cell if shape == POLYHEDRON else [cell])]
    rows = np.concatenate([np.empty(0, dtype=np.int64), *corners]).astype(np.int64)
    notices = (*remarks, *cells_left_out(left_out, bool(volumes)), *unused_points(len(points), rows))
    names = _physical_groups(mesh, used)
    if volumes:
        cells = join_polyhedra([_volume_cells(points, block) for block in volumes])
        return Geometry(cells, notices, names, _entities(mesh, volumes), cells=True)
    sided = [np.asarray(block.data, dtype=np.int64)[:, : SURFACE_CELLS[_shape(block.type)]] for block in used]
    faces = [face for loops in sided for face in loops.tolist()]
    check_rows(np.fromiter(chain.from_iterable(faces), dtype=np.int64), len(points))
    surface, present = surfaces_by_label(points, faces, names or ("",) * len(faces))
    return Geometry(surface, notices, tuple(present) if names else ())


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


def _entities(mesh: Any, used: Sequence[Any]) -> IntArray | None:
    """Number of the physical group of each cell of some of Gmsh's blocks of cells, or less than 0 of its geometric
    entity where it is in none, (n,).
    """
    entities, groups = (mesh.cell_data.get(f"gmsh:{kind}") for kind in ("geometrical", "physical"))
    if entities is None:
        return None
    rows = [row for row, block in enumerate(mesh.cells) if any(block is other for other in used)]
    entity = np.concatenate([np.asarray(entities[row], dtype=np.int64) for row in rows])
    if groups is None:
        return -entity
    group = np.concatenate([np.asarray(groups[row], dtype=np.int64) for row in rows])
    return np.where(group > 0, group, -entity)


def _mesh(path: str, file_format: str) -> tuple[Any, list[Notice]]:
    """The file as meshio gives it, and what meshio would have printed."""
    with _printed() as printed:
        try:
            with np.errstate(all="ignore"):
                # the reader itself: meshio.read prints, and ends the program, where a file is malformed
                mesh = getattr(_meshio(), file_format).read(path)
        except (GeometryFileError, MemoryError, OSError):
            raise
        except (Exception, SystemExit) as error:  # the readers let all kinds of exceptions through
            reason = " ".join(f"{printed.getvalue()} {error}".split())
            raise malformed(WORDS[file_format], reason[:200] or "it cannot be read") from error
    words = " ".join(printed.getvalue().split())
    return mesh, [Notice("warning", "mesh-file-remarks", words[:500])] if words else []


@contextlib.contextmanager
def _printed() -> Iterator[io.StringIO]:
    """What is printed meanwhile, instead of printing it."""
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
        yield printed


@cache
def _meshio() -> Any:
    """The library, imported late, for it takes half a second, and completed."""
    import meshio
    from meshio._common import num_nodes_per_cell
    from meshio._mesh import topological_dimension
    from meshio.vtu import _vtu

    num_nodes_per_cell.update(PRISMS)
    topological_dimension.update(dict.fromkeys(SOLID, 3))
    cells_of, polyhedra_of = _vtu.vtk_cells_from_data, _vtu._polyhedron_cells_from_data

    def checked_cells_of(points: IntArray, offsets: IntArray, types: IntArray, data: Any) -> Any:
        return cells_of(*_plain_cells(points, offsets, types), data) if len(types) else ([], {})

    def checked_polyhedra_of(offsets: IntArray, faces: IntArray, ends: IntArray, data: Any) -> Any:
        _refuse_other_faces(faces, ends)
        return polyhedra_of(offsets, faces, ends, data)

    _vtu.vtk_cells_from_data, _vtu._polyhedron_cells_from_data = checked_cells_of, checked_polyhedra_of
    _vtu.zlib = SimpleNamespace(compress=partial(zlib.compress, level=COMPRESSION), decompress=zlib.decompress)
    return meshio


def _plain_cells(points: IntArray, offsets: IntArray, types: IntArray) -> tuple[IntArray, IntArray, IntArray]:
    """The same by corners alone, pixels turned into quadrilaterals and voxels into hexahedra.

    points  : rows of points of all cells, one after the other
    offsets : (n_cells,) where the points of each cell end
    types   : (n_cells,) numbers of VTK

    Raises GeometryFileError for a type that is not read, and for a cell of more or fewer points than its type needs.
    """
    points, offsets, types = (np.array(each, dtype=np.int64) for each in (points, offsets, types))
    sizes = np.diff(offsets, prepend=0)
    for kind in np.unique(types).tolist():
        rows = np.flatnonzero(types == kind)
        if kind not in NODES:
            words = f"cell {rows[0]} (from 0) cannot be read: it is of VTK type {kind}"
            raise GeometryFileError("geometry-file", f"{words}; export the mesh without such cells")
        wrong = rows[sizes[rows] < NODES[kind] if kind == POLYGON else sizes[rows] != NODES[kind]]
        if len(wrong):
            found = counted(int(sizes[wrong[0]]), "point")
            raise malformed("VTU", f"cell {wrong[0]} (from 0), of VTK type {kind}, needs {NODES[kind]} and has {found}")
    if sizes.sum() != len(points):
        words = f"its cells have {counted(int(sizes.sum()), 'point')} by their offsets and {len(points)} in their list"
        raise malformed("VTU", words)
    for kind, (other, order) in BY_AXES.items():
        rows = np.flatnonzero(types == kind)
        first = offsets[rows, None] - len(order)
        points[first + np.arange(len(order))] = points[first + np.array(order)]
        types[rows] = other
    first = offsets - sizes
    for kind in np.intersect1d(types, list(PLAIN)).tolist():
        rows = types == kind
        types[rows], sizes[rows] = PLAIN[kind], NODES[PLAIN[kind]]
    return points[ranges(first, sizes)], np.cumsum(sizes), types


def _refuse_other_faces(faces: IntArray, ends: IntArray) -> None:
    """Refuse polyhedra whose faces do not end where their offsets say.

    faces : (n,) of each polyhedron their number, and of each of them the number of its points and these
    ends  : (n_polyhedra,) where the faces of each polyhedron end
    """
    numbers, begin = faces.tolist(), 0
    for row, end in enumerate(ends.tolist()):
        at, left = begin + 1, numbers[begin] if 0 <= begin < len(numbers) else 0
        while left > 0 and at < len(numbers) and numbers[at] > 0:
            at, left = at + numbers[at] + 1, left - 1
        if left or at != end or end > len(numbers):
            words = f"the faces of polyhedron {row} (from 0) have more or fewer points than they announce"
            raise malformed("VTU", words)
        begin = end


def _points(mesh: Any) -> FloatArray:
    """In space, (n, 3); those of a plane lie at height zero."""
    points = np.asarray(mesh.points, dtype=np.float64)
    if not points.size:
        return np.empty((0, 3))
    if points.ndim != 2 or points.shape[1] not in (2, 3):
        raise GeometryFileError("geometry-file", "the points have neither two nor three coordinates")
    return np.pad(points, ((0, 0), (0, 3 - points.shape[1])))


def _shape(cell_type: str) -> str:
    """``hexahedron`` for ``hexahedron20``: names of cells of higher order end in their number of nodes."""
    return cell_type.rstrip("0123456789")


def _volume_cells(points: FloatArray, block: Any) -> Polyhedra:
    """Cells of one shape, or given by faces, each face by rows of points."""
    if _shape(block.type) == POLYHEDRON:
        faces = [np.asarray(face, dtype=np.int64) for cell in block.data for face in cell]
        owner = np.repeat(np.arange(len(block.data)), [len(cell) for cell in block.data])
        corners = np.concatenate(faces)
        check_rows(corners, len(points))
        return own_vertices(points, corners, starts(np.array([len(face) for face in faces], dtype=np.int64)), owner)
    count, of_shape = VOLUME_CELLS[_shape(block.type)]
    rows = np.asarray(block.data, dtype=np.int64)
    if rows.ndim != 2 or rows.shape[1] < count:
        raise GeometryFileError("geometry-file", f"a cell of type {block.type} has fewer than {count} points")
    check_rows(rows[:, :count], len(points))
    return polyhedra_from_cells(points[rows[:, :count]], of_shape)


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

    Raises FileError where the file cannot be written.
    """
    meshio = _meshio()
    of_cells = {name: list(arrays) for name, arrays in (cell_data or {}).items()}
    try:
        with _printed() as printed:
            mesh = meshio.Mesh(points, list(cells), point_data=dict(point_data or {}), cell_data=of_cells)
            meshio.write(path, mesh, file_format=file_format)
    except OSError as error:
        raise FileError("file-not-written", f"{path}: cannot be written: {error.strerror or error}") from error
    if remarks := " ".join(printed.getvalue().split()):
        logging.getLogger(__name__).warning("%s: %s", path, remarks)
