"""Broad phase: pairs of blocks, then of facets, that are near enough to be worth clipping.

Near means within the reach of a pair: ten times its tolerance, so that pairs which just miss each other are seen.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import ContactsRefused
from mbla.contacts.facets import Facets
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.plane import CrowdedError, meeting_boxes
from mbla.model.solids.ragged import chunks, rows_and_items

NEAR_MISS = 10.0
"""Gaps up to this many tolerances are near misses."""

MOST_PAIRS, PAIRS_OF_A_BLOCK = 300_000, 30
"""of blocks that are looked at: so many, or so many times the number of blocks; those that share no volume have some
ten"""

# Facets farther from opposite than this are no contact: the strip along their common line where the gap stays within
# the tolerance would be narrower than 3.5 tolerances.
_COARSE_ANGLE = np.cos(np.radians(30))

# Facet pairs looked at together: bounds memory to some 200 MB.
_BATCH = 1_000_000


@dataclass(frozen=True)
class BlockPairs:
    """Pairs of blocks i < j whose bounding boxes come within reach of each other, sorted.

    blocks       : (n_pairs, 2)
    sizes        : (n_pairs,) m    block size of the pair, the smaller of the two
    box_depths   : (n_pairs,) m    how deep the boxes overlap, along the axis where it is least; negative for a gap
    """

    blocks: IntArray
    sizes: FloatArray
    box_depths: FloatArray

    def __len__(self) -> int:
        return len(self.sizes)


def find_block_pairs(blocks: Blocks, tolerance: float) -> BlockPairs:
    """Pairs of blocks within reach; tolerance is relative to block size.

    Raises
    ------
    ContactsRefused
        for far more of them than blocks that lie beside each other have
    """
    lower, upper = block_boxes(blocks)
    # Half the reach on either box is enough for every pair; the exact reach of the pair is compared after.
    margin = (NEAR_MISS * tolerance / 2 * blocks.sizes)[:, None]
    most = max(MOST_PAIRS, PAIRS_OF_A_BLOCK * len(blocks))
    try:
        i, j = meeting_boxes(lower - margin, upper + margin, lower - margin, upper + margin, most)
    except CrowdedError as crowded:
        words = (
            f"many blocks lie in one place, as {blocks.name(crowded.box)}: more than {most:,} pairs come near each "
            "other; no more can be handled"
        )
        raise ContactsRefused("too-many-units", words, ("blocks",)) from crowded
    sizes = np.minimum(blocks.sizes[i], blocks.sizes[j])
    depths = (np.minimum(upper[i], upper[j]) - np.maximum(lower[i], lower[j])).min(axis=1, initial=np.inf)
    keep = depths >= -NEAR_MISS * tolerance * sizes
    return BlockPairs(np.stack([i[keep], j[keep]], axis=1), sizes[keep], depths[keep])


def block_boxes(blocks: Blocks) -> tuple[FloatArray, FloatArray]:
    """Least and greatest coordinates of each block, two of (n_blocks, 3)."""
    first = blocks.vertex_start[:-1]
    return np.minimum.reduceat(blocks.vertices, first), np.maximum.reduceat(blocks.vertices, first)


def find_facet_pairs(blocks: Blocks, facets: Facets, pairs: BlockPairs, tolerance: float) -> tuple[IntArray, IntArray]:
    """Facets of a pair of blocks that are opposite (coarsely) and within reach of each other.

    Returns
    -------
    facets : (n, 2) facet of block a, facet of block b; sorted by pair of blocks
    pair   : (n,)   row of ``pairs``
    """
    reach = NEAR_MISS * tolerance * pairs.sizes
    lower, upper = block_boxes(blocks)
    near = [_facets_near_box(facets, pairs.blocks[:, s], lower, upper, pairs.blocks[:, 1 - s], reach) for s in (0, 1)]
    (pair_a, facet_a), (pair_b, facet_b) = near
    first = np.searchsorted(pair_b, pair_a, side="left")
    counts = np.searchsorted(pair_b, pair_a, side="right") - first
    found: list[tuple[IntArray, IntArray]] = []
    for rows in chunks(counts, _BATCH):
        row, item = rows_and_items(first[rows], counts[rows])
        a, b, pair = facet_a[rows][row], facet_b[item], pair_a[rows][row]
        for test in (_opposite, _boxes_meet, _planes_near):
            keep = test(facets, a, b, reach[pair])
            a, b, pair = a[keep], b[keep], pair[keep]
        found.append((np.stack([a, b], axis=1), pair))
    if not found:
        return np.zeros((0, 2), dtype=np.int64), np.zeros(0, dtype=np.int64)
    return np.concatenate([f for f, _ in found]), np.concatenate([p for _, p in found])


def opposite(normals_a: FloatArray, normals_b: FloatArray) -> BoolArray:
    """True (n,) where two outward normals (n, 3) face each other, coarsely."""
    facing: BoolArray = np.einsum("ki,ki->k", normals_a, normals_b) < -_COARSE_ANGLE
    return facing


def _facets_near_box(
    facets: Facets, block: IntArray, lower: FloatArray, upper: FloatArray, other: IntArray, reach: FloatArray
) -> tuple[IntArray, IntArray]:
    """Row of the pair and facet for the facets of one block of each pair that come near the box of the other."""
    pair, facet = rows_and_items(facets.facet_start[block], np.diff(facets.facet_start)[block])
    keep = np.ones(len(pair), dtype=bool)
    for axis in range(3):
        margin = reach[pair]
        keep &= facets.lower[facet, axis] - margin <= upper[other[pair], axis]
        keep &= facets.upper[facet, axis] + margin >= lower[other[pair], axis]
    return pair[keep], facet[keep]


def _opposite(facets: Facets, a: IntArray, b: IntArray, reach: FloatArray) -> BoolArray:
    return opposite(facets.normals[a], facets.normals[b])


def _boxes_meet(facets: Facets, a: IntArray, b: IntArray, reach: FloatArray) -> BoolArray:
    apart = np.maximum(facets.lower[a] - facets.upper[b], facets.lower[b] - facets.upper[a])
    return np.asarray((apart <= reach[:, None]).all(axis=1))


def _planes_near(facets: Facets, a: IntArray, b: IntArray, reach: FloatArray) -> BoolArray:
    """True unless the planes are farther apart than the reach everywhere on the facets."""
    normals_a, normals_b = facets.normals[a], facets.normals[b]
    normal = normals_a - normals_b
    normal /= np.sqrt(np.einsum("ki,ki->k", normal, normal))[:, None]
    cosine = np.einsum("ki,ki->k", normals_a, normal)
    tilt = np.sqrt(np.maximum(1 - cosine**2, 0.0))
    distance = np.abs(np.einsum("ki,ki->k", facets.origins[b] - facets.origins[a], normal))
    near: BoolArray = distance <= reach + tilt * (facets.radii[a] + facets.radii[b])
    return near
