"""Volume cells of mesh files by their faces (types have meshio's names), and the sets of them joined to blocks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mbla.arrays import IntArray
from mbla.model.geometry.geometry import Geometry
from mbla.model.geometry.repeated_faces import face_codes
from mbla.model.geometry.welding import own_vertices, take_faces, weld
from mbla.model.solids.measures import connected_labels
from mbla.model.solids.polyhedra import HEXAHEDRON, Polyhedra, take_polyhedra

VOLUME_CELLS: dict[str, tuple[int, Sequence[Sequence[int]]]] = {
    "tetra": (4, ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3))),
    "hexahedron": (8, HEXAHEDRON),
    "wedge": (6, ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5))),
    "pyramid": (5, ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4))),
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
    sets, names, _ = _by_set(geometry)
    codes = face_codes(sets, oriented=False)
    return replace(
        geometry,
        polyhedra=take_faces(sets, np.bincount(codes)[codes] == 1),
        names=names if any(names) else (),
        sets=None,
        cells=False,
        indexed=False,
    )


def joinable_tetrahedra(geometry: Geometry) -> tuple[int, int]:
    """How many tetrahedra share a whole face with another one of their set, and how many blocks joined cells make.

    Hexahedra that share faces are masonry as often as they are meshes; no mason builds with tetrahedra that do.
    """
    cells = geometry.polyhedra
    corners = np.diff(cells.loop_start)
    four = np.diff(cells.face_start) == 4
    if not four.any():
        return 0, 0
    sets, _, cell = _by_set(geometry)
    slanted = four & (np.bincount(cells.block_of_face, weights=corners != 3, minlength=len(cells)) == 0)
    codes = face_codes(sets, oriented=False)
    order = np.argsort(codes, kind="stable")
    same = np.flatnonzero(codes[order[1:]] == codes[order[:-1]])
    pairs = cell[np.stack([order[same], order[same + 1]], axis=1)]
    sharing = np.unique(pairs[slanted[pairs].all(axis=1)])
    return len(sharing), int(connected_labels(pairs, len(cells)).max()) + 1


def _by_set(geometry: Geometry) -> tuple[Polyhedra, tuple[str, ...], IntArray]:
    """All faces of the cells of each set as one polyhedron, the names of the sets, and the cell of each face."""
    cells = geometry.polyhedra
    sets = [0] * len(cells) if geometry.sets is None else geometry.sets.tolist()
    keys = list(zip(geometry.names or ("",) * len(cells), sets, strict=True))
    present = list(dict.fromkeys(keys))
    row_of = {key: row for row, key in enumerate(present)}
    owner = np.array([row_of[key] for key in keys], dtype=np.int64)
    order = np.argsort(owner, kind="stable")
    sorted_cells = weld(take_polyhedra(cells, order)).polyhedra  # first alone: which faces collapse is known by cell
    cell = order[sorted_cells.block_of_face]
    merged = own_vertices(sorted_cells.vertices, sorted_cells.loops, sorted_cells.loop_start, owner[cell])
    return weld(merged).polyhedra, tuple(name for name, _ in present), cell
