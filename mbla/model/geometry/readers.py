"""Geometry files: one reader per file, registered by extension. A new one is a file and a line here."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import numpy as np

from mbla.model.geometry.compas_json import read_compas_json
from mbla.model.geometry.dxf import read_dxf
from mbla.model.geometry.geometry import Geometry, GeometryFileError
from mbla.model.geometry.inp import read_inp
from mbla.model.geometry.meshio_files import read_msh, read_vtu
from mbla.model.geometry.obj import read_obj
from mbla.model.geometry.ply import read_ply
from mbla.model.geometry.stl import read_stl
from mbla.process.limits import can_limit, limited, written

READERS: dict[str, Callable[[Path], Geometry]] = {
    ".obj": read_obj,
    ".ply": read_ply,
    ".stl": read_stl,
    ".vtu": read_vtu,
    ".msh": read_msh,
    ".inp": read_inp,
    ".json": read_compas_json,
    ".dxf": read_dxf,
}
"""by extension, in lower case"""

LARGEST_FILE = 1024**3
"""bytes of a geometry file: some ten million triangles as text"""
LEAST_MEMORY, MEMORY_PER_BYTE = 96 * 1024**2, 60
"""bytes that reading may take: libraries trust the sizes that files announce, and unpack what is packed"""


def _read_within_memory(reader: Callable[[Path], Geometry], path: Path) -> Geometry:
    """What a reader gives, in memory that is in proportion to the size of the file where the system can hold it to."""
    size = 0
    try:
        with path.open("rb") as file:  # a folder, and a file without permission, are refused here
            size = os.fstat(file.fileno()).st_size
        if size > LARGEST_FILE:
            words = f"is larger than {LARGEST_FILE // 1024**2} MB: divide it into several files"
            raise GeometryFileError("geometry-too-large", words)
        with limited(written() + LEAST_MEMORY + MEMORY_PER_BYTE * size if can_limit() else None):
            return reader(path)
    except OSError as error:
        raise GeometryFileError("file-unreadable", f"cannot be read: {error.strerror or error}") from error
    except MemoryError as error:
        words = f"needs far more memory than its {size} bytes can hold blocks for: damaged or packed; export it anew"
        raise GeometryFileError("geometry-too-large", words) from error


def read_geometry(path: Path) -> Geometry:
    """What a geometry file holds, as read.

    Raises GeometryFileError for unknown extensions, files that cannot be read, malformed ones, and files without
    blocks.
    """
    reader = READERS.get(path.suffix.lower())
    if reader is None:
        raise GeometryFileError("geometry-not-read", f"unknown kind of geometry file; known are {', '.join(READERS)}")
    geometry = _read_within_memory(reader, path)
    if not len(geometry.polyhedra):
        raise GeometryFileError(
            "geometry-without-blocks", "the file holds no blocks: no surface and no volume cell was found"
        )
    if len(short := np.flatnonzero(np.diff(geometry.polyhedra.loop_start) < 3)):
        raise GeometryFileError("geometry-file", f"face {short[0]} of the file has fewer than three corners")
    return geometry
