"""Broad phase: pairs of blocks that may share volume, and of facets that are near enough to be worth clipping.

Near means within the reach of a pair: ten times its tolerance, so that pairs which just miss each other are seen.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeAlias

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import ContactsRefused
from mbla.contacts.faces.facets import Facets
from mbla.model.model import Ground
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.plane import CrowdedError, meeting_boxes

NEAR_MISS = 10.0
"""Gaps up to this many tolerances are near misses."""

MOST_PAIRS, PAIRS_OF_A_BLOCK = 300_000, 30
"""of blocks that are examined: this number, or this multiple of the number of blocks; those that share no volume have
some ten"""

# Facets farther from opposite than this are no contact: the strip along their common line where the gap stays within
# the tolerance would be narrower than 3.5 tolerances.
_COARSE_ANGLE = np.cos(np.radians(30))


def find_block_pairs(blocks: Blocks, tolerance: float) -> IntArray:
    """Pairs of blocks i < j whose boxes share more than the tolerance along every axis, (n, 2), sorted.

    tolerance : relative to the size of the smaller block

    Raises
    ------
    ContactsRefused
        for far more blocks that touch each other's boxes than blocks that lie next to each other have
    """
    lower, upper = block_boxes(blocks)
    most = max(MOST_PAIRS, PAIRS_OF_A_BLOCK * len(blocks))
    try:
        i, j = meeting_boxes(lower, upper, lower, upper, most)
    except CrowdedError as crowded:
        words = (
            f"many blocks lie in one place, as {blocks.name(crowded.box)}: more than {most:,} pairs come near each "
            "other; no more can be handled"
        )
        raise ContactsRefused("too-many-units", words, ("blocks",)) from crowded
    depths = (np.minimum(upper[i], upper[j]) - np.maximum(lower[i], lower[j])).min(axis=1, initial=np.inf)
    pairs = np.stack([i, j], axis=1)
    return np.asarray(pairs[depths > tolerance * blocks.sizes[pairs].min(axis=1)])


def block_boxes(blocks: Blocks) -> tuple[FloatArray, FloatArray]:
    """Least and greatest coordinates of each block, two of (n_blocks, 3)."""
    first = blocks.vertex_start[:-1]
    return np.minimum.reduceat(blocks.vertices, first), np.maximum.reduceat(blocks.vertices, first)


Faces: TypeAlias = Callable[[IntArray, IntArray, FloatArray, FloatArray], BoolArray]
"""Whether facets may be in contact, (n,): bodies and facets, (n, 2) each, −1 for ground planes, and outward normals of
both, (n, 3) each."""


def are_opposite(bodies: IntArray, facets: IntArray, normals_a: FloatArray, normals_b: FloatArray) -> BoolArray:
    """Whether outward normals face each other, coarsely."""
    facing: BoolArray = np.einsum("ki,ki->k", normals_a, normals_b) < -_COARSE_ANGLE
    return facing


def find_facet_pairs(blocks: Blocks, sheets: Facets, grounds: Sequence[Ground], reach: float, faces: Faces) -> IntArray:
    """Facets of two blocks, then ground surfaces and facets of what they may carry, that face each other within reach.

    sheets : facets of the blocks, and behind them ground surfaces that end somewhere
    reach  : relative to the size of the smaller block

    Returns (n, 2) rows of these, those of either kind sorted.
    """
    first = int(np.searchsorted(sheets.blocks, len(blocks)))
    sizes = np.append(blocks.sizes, np.full(len(grounds), np.inf))[sheets.blocks]
    margin = (reach / 2 * sizes[:first])[:, None]
    lower, upper = sheets.lower[:first], sheets.upper[:first]
    a, b = meeting_boxes(lower - margin, upper + margin, lower - margin, upper + margin, np.inf)
    other = sheets.blocks[a] != sheets.blocks[b]
    a, b = a[other], b[other]
    if len(sheets) > first:
        surfaces = sheets.lower[first:], sheets.upper[first:]
        surface, on = meeting_boxes(*surfaces, lower - 2 * margin, upper + 2 * margin)
        surface += first
        carried = may_carry(grounds, sheets.blocks[surface] - len(blocks), sheets.blocks[on])
        a, b = np.append(a, surface[carried]), np.append(b, on[carried])
    pairs = np.stack([a, b], axis=1)
    pairs = pairs[faces(sheets.blocks[pairs], pairs, sheets.normals[a], sheets.normals[b])]
    for test in (_boxes_meet, _planes_near):
        a, b = pairs.T
        pairs = pairs[test(sheets, a, b, reach * np.minimum(sizes[a], sizes[b]))]
    return pairs


def may_carry(grounds: Sequence[Ground], ground: IntArray, block: IntArray) -> BoolArray:
    """Whether grounds, by number, may carry blocks, (n,)."""
    allowed = np.ones(len(block), dtype=bool)
    for number in np.unique(ground).tolist():
        if (chosen := grounds[number].blocks) is not None:
            rows = ground == number
            allowed[rows] = np.isin(block[rows], chosen)
    return allowed


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
