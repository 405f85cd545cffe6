"""Each block as a box: three axes across its greatest faces, and how far it reaches along them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray, row_of_item, starts, summed
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.ragged import ranges, row_ranges


@dataclass(frozen=True)
class Boxes:
    """Boxes about blocks.

    axes     : (n_blocks, 3, 3) unit, right-handed, by rows: across the greatest face, across the greatest one that is
               most across that, along both
    low, high : (n_blocks, 3) m, reach along them from the centroid
    triangles : (t, 3) corners of the faces cut into triangles, counter-clockwise from outside; rows of the vertices
    start     : (n_blocks + 1,) triangles of each block
    """

    axes: FloatArray
    low: FloatArray
    high: FloatArray
    triangles: IntArray
    start: IntArray

    @property
    def lengths(self) -> FloatArray:
        """(n_blocks, 3) m."""
        return np.asarray(self.high - self.low)


def boxes_of(blocks: Blocks) -> Boxes:
    """Of every block."""
    counts = np.diff(blocks.loop_start) - 2
    face = np.repeat(np.arange(len(counts)), counts)
    first, step = blocks.loop_start[face], ranges(np.ones(len(counts), dtype=np.int64), counts)
    triangles = np.column_stack([blocks.loops[first], blocks.loops[first + step], blocks.loops[first + step + 1]])
    a, b, c = (blocks.vertices[triangles[:, corner]] for corner in range(3))
    areas = np.linalg.norm(summed(face, np.cross(b - a, c - a), len(counts)), axis=1)
    block_of_face = row_of_item(blocks.face_start)
    normals = blocks.face_normals
    one = normals[_greatest(areas, blocks.face_start)]
    across = normals - np.einsum("fi,fi->f", normals, one[block_of_face])[:, None] * one[block_of_face]
    two = across[_greatest(areas * np.linalg.norm(across, axis=1), blocks.face_start)]
    two = two / np.linalg.norm(two, axis=1)[:, None]
    axes = np.stack([one, two, np.cross(one, two)], axis=1)
    owner = row_of_item(blocks.vertex_start)
    along = np.einsum("vij,vj->vi", axes[owner], blocks.vertices - blocks.centroids[owner])
    low, high = row_ranges(along, blocks.vertex_start)
    per_block = summed(block_of_face, counts, len(blocks)).astype(np.int64)
    return Boxes(axes, low, high, triangles, starts(per_block))


def _greatest(values: FloatArray, start: IntArray) -> IntArray:
    """Row of the first of the greatest values of each block, up to rounding, (n_blocks,)."""
    most = np.maximum.reduceat(values, start[:-1])
    chosen = np.flatnonzero(values >= (1.0 - 1e-9) * most[row_of_item(start)])
    owner = row_of_item(start)[chosen]
    return chosen[np.searchsorted(owner, np.arange(len(start) - 1))]
