"""The VTU format: points, cells and data on them as XML with arrays in base64, compressed by zlib in blocks.

The bytes are those that meshio 5.3.5 writes at the same level of compression, but for the line that names the program:
the library takes longer to import, with all its formats and its command line, than the files of a thousand blocks to
write. Arrays of whole numbers (connectivity, blocks, groups) are the same in every frame of an animation and are
encoded once.

Source: VTK file formats, https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html
"""

from __future__ import annotations

import base64
import sys
import zlib
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import mbla
from mbla.arrays import FloatArray, IntArray
from mbla.errors import FileError

COMPRESSION = 1
"""level of zlib: coordinates and forces hardly get smaller by a higher one (0.4 % of an animation frame of 10,000
blocks), and writing takes twice as long at its usual 6"""
BLOCK_BYTES = 32_768
"""compressed as one; the header before the array lists them"""
ENCODED_ARRAYS = 16
"""that are kept encoded: a frame has about ten of whole numbers"""

POLYHEDRON = "polyhedron"
CELL_TYPES = {
    "vertex": 1,
    "line": 3,
    "triangle": 5,
    "polygon": 7,
    "quad": 9,
    "tetra": 10,
    "hexahedron": 12,
    "wedge": 13,
    POLYHEDRON: 42,
}
"""numbers of VTK"""
WEDGE = [0, 2, 1, 3, 5, 4]
"""corners of a wedge in the order of VTK, whose base faces the other way"""
DATA_TYPES = {
    np.dtype(np.float64): "Float64",
    np.dtype(np.float32): "Float32",
    np.dtype(np.int8): "Int8",
    np.dtype(np.int16): "Int16",
    np.dtype(np.int32): "Int32",
    np.dtype(np.int64): "Int64",
    np.dtype(np.uint8): "UInt8",
}

Arrays = dict[str, NDArray[Any]]


def write_mesh(
    path: Path,
    points: FloatArray,
    cells: Sequence[tuple[str, Any]],
    point_data: Mapping[str, NDArray[Any]],
    cell_data: Mapping[str, Sequence[NDArray[Any]]],
) -> None:
    """Write points, cells and data on them to a VTU file.

    points     : (n_points, 3)
    cells      : pairs of a type of ``CELL_TYPES`` and rows of points, (n, corners); of polyhedra their faces, each an
                 array of rows of points. They cannot be mixed with other types
    point_data : by name, (n_points,) or (n_points, k); whole or real numbers
    cell_data  : by name, one array per entry of ``cells``

    Raises
    ------
    FileError
        where the file cannot be written
    ValueError
        for data of another length than that of its points or cells
    """
    on_cells = {name: np.concatenate(list(arrays)) for name, arrays in cell_data.items()}
    n_cells = sum(len(block) for _, block in cells)
    _check_lengths("points", point_data, len(points))
    _check_lengths("cells", on_cells, n_cells)
    sections = (
        ("Points", {"Points": points}),
        ("Cells", _polyhedra(cells) if any(kind == POLYHEDRON for kind, _ in cells) else _plain_cells(cells)),
        ("PointData", point_data),
        ("CellData", on_cells),
    )
    try:
        with path.open("w", encoding="ascii", newline="\n") as file:
            file.writelines(_lines(sections, len(points), n_cells))
    except OSError as error:
        raise FileError(f"{path}: cannot be written: {error.strerror or error}") from error


def _check_lengths(what: str, data: Mapping[str, NDArray[Any]], length: int) -> None:
    for name, array in data.items():
        if len(array) != length:
            raise ValueError(f"{name} has {len(array)} rows for {length} {what}")


def _lines(sections: Sequence[tuple[str, Mapping[str, NDArray[Any]]]], n_points: int, n_cells: int) -> Iterator[str]:
    order = "LittleEndian" if sys.byteorder == "little" else "BigEndian"
    yield '<?xml version="1.0"?>\n'
    yield f'<VTKFile type="UnstructuredGrid" version="0.1" byte_order="{order}" compressor="vtkZLibDataCompressor">\n'
    yield f"<!--This file was created by mbla {mbla.__version__}-->\n"
    yield f'<UnstructuredGrid>\n<Piece NumberOfPoints="{n_points}" NumberOfCells="{n_cells}">\n'
    for section, arrays in sections:
        if arrays:
            yield f"<{section}>\n"
            for name, array in arrays.items():
                yield from _data_array(name, array)
            yield f"</{section}>\n"
    yield "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n"


def _data_array(name: str, array: NDArray[Any]) -> Iterator[str]:
    columns = f' NumberOfComponents="{array.shape[1]}"' if array.ndim == 2 else ""
    yield f'<DataArray type="{DATA_TYPES[array.dtype]}" Name="{name}"{columns} format="binary">\n'
    yield (_encoded_once if array.dtype.kind in "iu" else _encoded)(array.tobytes())
    yield "\n</DataArray>\n"


def _encoded(raw: bytes) -> str:
    """Header (number of blocks, their bytes, bytes of the last, of each compressed) and blocks, in base64."""
    starts = range(0, len(raw), BLOCK_BYTES)
    blocks = [zlib.compress(raw[start : start + BLOCK_BYTES], COMPRESSION) for start in starts]
    last = len(raw) - (len(blocks) - 1) * BLOCK_BYTES
    header = np.array([len(blocks), BLOCK_BYTES, last, *map(len, blocks)], dtype=np.uint32)
    return (base64.b64encode(header.tobytes()) + base64.b64encode(b"".join(blocks))).decode("ascii")


_encoded_once = lru_cache(maxsize=ENCODED_ARRAYS)(_encoded)


def _plain_cells(cells: Sequence[tuple[str, Any]]) -> Arrays:
    """Connectivity, ends and types of cells whose corners are all there is to say."""
    rows = [np.asarray(block)[:, WEDGE] if kind == "wedge" else np.asarray(block) for kind, block in cells]
    corners = np.concatenate([np.full(len(block), block.shape[1], dtype=np.int64) for block in rows])
    return {
        "connectivity": np.concatenate([block.ravel() for block in rows]),
        "offsets": np.cumsum(corners),
        "types": np.concatenate([np.full(len(block), CELL_TYPES[kind]) for kind, block in cells]),
    }


def _polyhedra(cells: Sequence[tuple[str, Any]]) -> Arrays:
    """The same of polyhedra, and their faces: of each cell their number, of each face that of its corners and these."""
    bodies = [body for _, block in cells for body in block]
    if any(kind != POLYHEDRON for kind, _ in cells):
        raise ValueError("polyhedra cannot be mixed with other cells in one file")
    nodes: list[IntArray] = [np.unique(np.concatenate(body)) for body in bodies]
    faces: list[int] = []
    ends = []
    for body in bodies:
        faces.append(len(body))
        for face in body:
            faces.append(len(face))
            faces += face.tolist()
        ends.append(len(faces))
    return {
        "connectivity": np.concatenate(nodes),
        "offsets": np.cumsum([len(each) for each in nodes]),
        "types": np.full(len(bodies), CELL_TYPES[POLYHEDRON]),
        "faces": np.array(faces, dtype=np.int64),
        "faceoffsets": np.array(ends, dtype=np.int64),
    }
