"""Blocks that share volume.

Two blocks are apart if the plane of some face has all of one on its inner side and all of the other on its outer side,
up to the tolerance. Pairs without such a plane are intersected as solids: with V the volume and S the surface of what
they share, they overlap if the thickness 2 V / S exceeds the tolerance times the block size. The measure sees identical
and nested blocks too, which no comparison of faces does.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.broad_phase import BlockPairs
from mbla.contacts.ragged import rows_and_items
from mbla.contacts.solids import Solid
from mbla.model.blocks import Blocks
from mbla.model.ragged import chunks

# Distances computed together: bounds memory to some 100 MB.
_BATCH = 1_000_000


@dataclass(frozen=True)
class Overlaps:
    """Pairs of blocks that share volume.

    pairs     : (n, 2) blocks
    depths    : (n,)   thickness of the shared volume relative to block size
    unchecked : (m, 2) pairs that could not be judged, because one of the blocks is not a closed solid
    """

    pairs: IntArray
    depths: FloatArray
    unchecked: IntArray


def find_overlaps(blocks: Blocks, pairs: BlockPairs, touching: IntArray, tolerance: float) -> Overlaps:
    """Overlaps deeper than the tolerance (relative to block size).

    touching : (m, 2) pairs of blocks with a contact
    """
    deep = pairs.box_depths > tolerance * pairs.sizes
    a, b = pairs.blocks.T
    # The joint between two convex blocks separates them: no need to look for another plane.
    apart = blocks.convex[a] & blocks.convex[b] & _listed(pairs.blocks, touching, len(blocks))
    rows = np.flatnonzero(deep & ~apart)
    if len(rows):
        extents = _own_extents(blocks)
        for one, other in ((0, 1), (1, 0)):
            limit = -tolerance * pairs.sizes[rows]
            rows = rows[_clearances(blocks, pairs.blocks[rows, one], pairs.blocks[rows, other], extents) < limit]
    return _by_solids(blocks, pairs, rows, tolerance)


def _listed(pairs: IntArray, listed: IntArray, n_blocks: int) -> BoolArray:
    """True for pairs that occur in the list."""
    found: BoolArray = np.isin(pairs[:, 0] * n_blocks + pairs[:, 1], listed[:, 0] * n_blocks + listed[:, 1])
    return found


def _face_points(blocks: Blocks) -> FloatArray:
    """A corner of each face, (n_faces, 3)."""
    return blocks.vertices[blocks.loops[blocks.loop_start[:-1]]]


def _own_extents(blocks: Blocks) -> FloatArray:
    """How far each block reaches beyond the plane of each of its faces, (n_faces,) m; 0 for faces of convex blocks."""
    n_vertices = np.diff(blocks.vertex_start)[blocks.block_of_face]
    points = _face_points(blocks)
    extents = np.empty(len(points))
    for faces in chunks(n_vertices, _BATCH):
        block = blocks.block_of_face[faces]
        row, vertex = rows_and_items(blocks.vertex_start[block], n_vertices[faces])
        height = _heights(blocks, vertex, points[faces][row], blocks.face_normals[faces][row])
        extents[faces] = np.maximum.reduceat(height, np.flatnonzero(np.diff(row, prepend=-1)))
    return extents


def _clearances(blocks: Blocks, one: IntArray, other: IntArray, extents: FloatArray) -> FloatArray:
    """Greatest clearance between the blocks of each pair along a face normal of the first, (n,) m; negative if none."""
    points = _face_points(blocks)
    n_faces = np.diff(blocks.face_start)[one]
    n_vertices = np.diff(blocks.vertex_start)[other]
    clearances = np.empty(len(one))
    for rows in chunks(n_faces * n_vertices, _BATCH):
        pair, face = rows_and_items(blocks.face_start[one[rows]], n_faces[rows])
        row, vertex = rows_and_items(blocks.vertex_start[other[rows]][pair], n_vertices[rows][pair])
        height = _heights(blocks, vertex, points[face][row], blocks.face_normals[face][row])
        nearest = np.minimum.reduceat(height, np.flatnonzero(np.diff(row, prepend=-1)))
        clearance = nearest - extents[face]
        clearances[rows] = np.maximum.reduceat(clearance, np.flatnonzero(np.diff(pair, prepend=-1)))
    return clearances


def _heights(blocks: Blocks, vertex: IntArray, points: FloatArray, normals: FloatArray) -> FloatArray:
    """Height of vertices over planes, (n,) m."""
    heights: FloatArray = np.einsum("ki,ki->k", blocks.vertices[vertex] - points, normals)
    return heights


def _by_solids(blocks: Blocks, pairs: BlockPairs, rows: IntArray, tolerance: float) -> Overlaps:
    """Judge the pairs left over one by one."""
    found, depths, unchecked = [], [], []
    for row in rows:
        a, b = (int(block) for block in pairs.blocks[row])
        size = float(pairs.sizes[row])
        origin = blocks.centroids[a if blocks.sizes[a] <= blocks.sizes[b] else b]
        solids = [Solid(blocks, block, origin, size) for block in (a, b)]
        if not all(solid.sound for solid in solids):
            unchecked.append((a, b))
            continue
        thickness = solids[0].shared_thickness(solids[1])
        if thickness > tolerance:
            found.append((a, b))
            depths.append(thickness)
    return Overlaps(
        np.array(found, dtype=np.int64).reshape(-1, 2),
        np.array(depths, dtype=np.float64),
        np.array(unchecked, dtype=np.int64).reshape(-1, 2),
    )
