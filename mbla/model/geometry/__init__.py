"""Geometry files: one reader per file, registered by extension. A new one is a file and a line here."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from mbla.model.geometry.compas_json import read_compas_json
from mbla.model.geometry.dxf import read_dxf
from mbla.model.geometry.geometry import Geometry, GeometryFileError
from mbla.model.geometry.gltf import read_gltf
from mbla.model.geometry.inp import read_inp
from mbla.model.geometry.meshio_files import read_msh, read_ply, read_vtu
from mbla.model.geometry.obj import read_obj
from mbla.model.geometry.stl import read_stl

READERS: dict[str, Callable[[Path], Geometry]] = {
    ".obj": read_obj,
    ".ply": read_ply,
    ".stl": read_stl,
    ".vtu": read_vtu,
    ".msh": read_msh,
    ".inp": read_inp,
    ".gltf": read_gltf,
    ".glb": read_gltf,
    ".json": read_compas_json,
    ".dxf": read_dxf,
}
"""by extension, in lower case"""


def read_geometry(path: Path) -> Geometry:
    """What a geometry file holds, as read.

    Raises
    ------
    GeometryFileError
        for unknown extensions, malformed files, and files without blocks
    """
    reader = READERS.get(path.suffix.lower())
    if reader is None:
        raise GeometryFileError(f"unknown kind of geometry file; known are {', '.join(READERS)}")
    geometry = reader(path)
    if not len(geometry.polyhedra):
        raise GeometryFileError("the file holds no blocks: no surface and no volume cell was found")
    if len(short := np.flatnonzero(np.diff(geometry.polyhedra.loop_start) < 3)):
        raise GeometryFileError(f"face {short[0]} of the file has fewer than three corners")
    return geometry
