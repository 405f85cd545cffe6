"""Which tolerance would join what no contact joins: near misses over a wide reach, and the least gap that is enough.

The near misses of a structure that hangs together lie within ten times its tolerance. Where some of its blocks reach no
support the tolerance says nothing about the gaps that were left there, so that all up to ``WIDEST`` are looked at,
whatever the tolerance is: the same gaps are told, and the same tolerance that closes them.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.broad_phase import NEAR_MISS, PairsRefused, find_block_pairs
from mbla.contacts.connectivity import unsupported_parts
from mbla.contacts.facets import Facets
from mbla.contacts.narrow_phase import Patches, find_patches, judge
from mbla.model.model import Model

WIDEST = 0.1
"""Gap relative to block size up to which faces nearly touch where blocks reach no support: the greatest tolerance."""


def misses_within(model: Model, facets: Facets, tolerance: float) -> Patches | None:
    """Near misses with gaps up to ``WIDEST``; None where those of the search reach as far, or cannot be looked at."""
    if NEAR_MISS * tolerance >= WIDEST:
        return None
    coarse = WIDEST / NEAR_MISS
    try:
        pairs = find_block_pairs(model.blocks, coarse)
    except PairsRefused:
        return None
    patches = find_patches(model.blocks, facets, pairs, model.grounds, coarse)
    found = judge(patches, tolerance, WIDEST).near_misses
    # what is narrower than its gap would be no contact if the gap were none
    return found.take((found.widths >= np.abs(found.gaps)) & (np.abs(found.gaps) <= WIDEST))


def joining_gap(fixed: BoolArray, bodies: IntArray, near: IntArray, gaps: FloatArray) -> float | None:
    """The least gap g such that every free block reaches a support if near misses up to g were contacts; None for none.

    fixed  : (n_blocks,)
    bodies : (n, 2) bodies in contact
    near   : (m, 2) bodies of near misses
    gaps   : (m,) of them
    """
    sizes = np.unique(np.abs(gaps))
    low, high = 0, len(sizes)
    while low < high:
        middle = (low + high) // 2
        closed = near[np.abs(gaps) <= sizes[middle]]
        if unsupported_parts(fixed, np.concatenate([bodies, closed])):
            low = middle + 1
        else:
            high = middle
    return float(sizes[low]) if low < len(sizes) else None
