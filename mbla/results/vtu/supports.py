"""``STEM_supports.vtu``: ground planes as slabs under what stands on them, fixed blocks and guided blocks."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.geometry.meshio_files import write_mesh
from mbla.model.model import Model
from mbla.results.pictures.geometry import ground_slab

GROUND, FIXED, GUIDED = 0, 1, 2
"""kinds of supports"""
SLAB_FACES = np.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]])
"""of a box whose corners are listed with the first coordinate fastest, outwards where these axes are right-handed"""


def support_slabs(model: Model, contacts: Contacts) -> tuple[tuple[int, FloatArray], ...]:
    """Ground planes that carry something, with the corners of a slab for each, (8, 3) m."""
    size = float(np.linalg.norm(np.ptp(model.blocks.vertices, axis=0)))
    slabs = [(ground, ground_slab(model, contacts, ground, size)) for ground in range(len(model.grounds))]
    return tuple((ground, slab) for ground, slab in slabs if slab is not None)


def has_supports(model: Model, contacts: Contacts) -> bool:
    """Whether there is a support to be seen."""
    return bool(model.fixed.any() or len(model.guides) or support_slabs(model, contacts))


def write_supports_vtu(path: Path, model: Model, contacts: Contacts) -> None:
    """Supports as polyhedra."""
    slabs = support_slabs(model, contacts)
    guided = np.setdiff1d(model.guides.blocks, np.flatnonzero(model.fixed))
    chosen = np.concatenate([np.flatnonzero(model.fixed), guided]).astype(np.int64)
    cells, vertices = _cells_of_blocks(model, chosen)
    for number, (_, slab) in enumerate(slabs):
        cells.append(list(_outward_faces(slab) + 8 * number + len(vertices)))
    kinds = [FIXED] * int(model.fixed.sum()) + [GUIDED] * len(guided) + [GROUND] * len(slabs)
    bodies = np.append(chosen, [len(model.blocks) + ground for ground, _ in slabs]).astype(np.int64)
    write_mesh(
        path,
        np.concatenate([vertices, *(slab for _, slab in slabs)]),
        [("polyhedron", cells)],
        point_data={},
        cell_data={"kind": [np.array(kinds, dtype=np.int8)], "body": [bodies]},
    )


def _outward_faces(slab: FloatArray) -> IntArray:
    """Faces of a slab, (6, 4), by rows of its corners."""
    right_handed = np.linalg.det(slab[[1, 2, 4]] - slab[0]) > 0
    return np.asarray(SLAB_FACES if right_handed else SLAB_FACES[:, ::-1])


def _cells_of_blocks(model: Model, chosen: IntArray) -> tuple[list[Any], FloatArray]:
    """Faces of each chosen block by rows of the vertices of these blocks alone, and these vertices, (n, 3) m."""
    blocks = model.blocks
    kept = np.isin(blocks.block_of_vertex, chosen)
    row = np.cumsum(kept) - 1
    cells = []
    for block in chosen.tolist():
        faces = range(int(blocks.face_start[block]), int(blocks.face_start[block + 1]))
        cells.append([row[blocks.loops[blocks.loop_start[face] : blocks.loop_start[face + 1]]] for face in faces])
    return cells, blocks.vertices[kept]
