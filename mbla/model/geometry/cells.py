"""Volume cells of mesh files by their faces (types have meshio's names), and the sets of them joined to blocks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mbla.model.geometry.geometry import Geometry
from mbla.model.geometry.surfaces import face_codes
from mbla.model.geometry.welding import own_vertices, weld
from mbla.model.solids.polyhedra import HEXAHEDRON, Polyhedra, take_polyhedra

VOLUME_CELLS: dict[str, tuple[int, Sequence[Sequence[int]]]] = {
    "tetra": (4, ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3))),
    "VTK_LAGRANGE_TETRAHEDRON": (4, ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3))),
    "hexahedron": (8, HEXAHEDRON),
    "VTK_LAGRANGE_HEXAHEDRON": (8, HEXAHEDRON),
    "wedge": (6, ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5))),
    "VTK_LAGRANGE_WEDGE": (6, ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5))),
    "pyramid": (5, ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4))),
    "VTK_LAGRANGE_PYRAMID": (5, ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4))),
    "penta_prism": (
        10,
        ((4, 3, 2, 1, 0), (5, 6, 7, 8, 9), *((i, (i + 1) % 5, (i + 1) % 5 + 5, i + 5) for i in range(5))),
    ),
    "hexa_prism": (
        12,
        ((5, 4, 3, 2, 1, 0), (6, 7, 8, 9, 10, 11), *((i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6) for i in range(6))),
    ),
}
"""number of corners and faces by corner, of each shape of cell; cells of higher order begin with their corners"""


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
