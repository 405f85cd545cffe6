"""Volume cells joined to blocks: what is left of their faces where no two cells of a set meet."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.model.geometry.duplicate_faces import face_codes
from mbla.model.geometry.geometry import Geometry
from mbla.model.geometry.welding import own_vertices, weld
from mbla.model.solids.polyhedra import Polyhedra, take_polyhedra


def join_cells(geometry: Geometry) -> Geometry:
    """The outer faces of the cells of each set as one surface; cells without a set make one together."""
    cells = geometry.polyhedra
    names = geometry.names or ("",) * len(cells)
    present = list(dict.fromkeys(names))
    row_of = {name: row for row, name in enumerate(present)}
    owner = np.array([row_of[name] for name in names], dtype=np.int64)
    order = np.argsort(owner, kind="stable")
    sorted_cells = take_polyhedra(cells, order)
    block = owner[order][sorted_cells.block_of_face]
    merged = own_vertices(sorted_cells.vertices, sorted_cells.loops, sorted_cells.loop_start, block)
    welded = weld(merged).polyhedra
    codes = face_codes(welded, oriented=False)
    single = np.bincount(codes)[codes] == 1
    faces = np.flatnonzero(single)
    return replace(
        geometry,
        polyhedra=_outer(welded, faces),
        names=tuple(present) if any(present) else (),
        cells=False,
        indexed=False,
    )


def _outer(surfaces: Polyhedra, faces: np.typing.NDArray[np.int64]) -> Polyhedra:
    chosen = np.zeros(len(surfaces.block_of_face), dtype=bool)
    chosen[faces] = True
    corners = chosen[surfaces.face_of_corner]
    counts = np.diff(surfaces.loop_start)[faces]
    start = np.concatenate([[0], np.cumsum(counts)])
    return own_vertices(surfaces.vertices, surfaces.loops[corners], start, surfaces.block_of_face[faces])
