"""Which block of one result is which of the other.

Blocks are the same by name (group and index) where those lie at the same places; where the names are the same but in
another order, or are others, by place; where the shape was changed but the names are the same, by name.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.solids.blocks import Blocks

SAME_PLACE = 1e-3
"""Distance of two points that are one, over the block size: the default tolerance of contacts."""

NEAR = 0.25
"""Distance of centroids, over the block size, up to which blocks of other names may be one another: less than half the
distance of neighbours."""

ENOUGH = 0.9
"""Share of the volume of either model that must be matched for mechanisms to be comparable."""


@dataclass(frozen=True)
class Matching:
    """Rows of B for the rows of A, -1 where there is none.

    blocks : (n_blocks of A,)
    share  : of the volume that is matched, the less of that of A and of B
    length : B's unit of length in that of A
    """

    blocks: IntArray
    share: float
    length: float

    @property
    def comparable(self) -> bool:
        """Whether motions of the two can be compared."""
        return self.share >= ENOUGH


def match_blocks(first: Blocks, second: Blocks, length: float) -> Matching:
    """Blocks of two models; ``length`` is B's unit of length in that of A."""
    places = second.centroids * length
    found = _by_name(first, second)
    if not _in_place(first, places, found):
        by_place = _by_place(first.centroids, places, first.sizes)
        complete = (found >= 0).all() and len(first) == len(second)
        if not complete or _in_place(first, places, by_place):
            found = by_place
    there = found >= 0
    volumes, others = first.volumes, second.volumes
    share = min(volumes[there].sum() / volumes.sum(), others[found[there]].sum() / others.sum())
    return Matching(found, float(share), length)


def _by_name(first: Blocks, second: Blocks) -> IntArray:
    rows = {second.name(block): block for block in range(len(second))}
    return np.array([rows.get(first.name(block), -1) for block in range(len(first))], dtype=np.int64)


def _in_place(first: Blocks, places: FloatArray, found: IntArray) -> bool:
    """Whether every block has a match at its own place, and no other block of B is left."""
    if (found < 0).any() or len(found) != len(places) or len(np.unique(found)) != len(found):
        return False
    off = np.linalg.norm(places[found] - first.centroids, axis=1)
    return bool((off <= SAME_PLACE * first.sizes).all())


def _by_place(centroids: FloatArray, places: FloatArray, sizes: FloatArray) -> IntArray:
    """Blocks that are each other's nearest, (n,)."""
    from scipy.spatial import cKDTree

    distance, nearest = cKDTree(places).query(centroids)
    _, back = cKDTree(centroids).query(places)
    nearest, back = np.asarray(nearest), np.asarray(back)
    mutual = (back[nearest] == np.arange(len(centroids))) & (distance <= NEAR * sizes)
    return np.where(mutual, nearest, -1).astype(np.int64)
