"""Guides of blocks that are glued into solids: the solid moves as its guided block does.

A way in which block b moves with (v, ω) about its own centroid c_b moves its solid with (v + ω × (c − c_b), ω) about
the centroid c of the solid. Two guided blocks of one solid agree where they belong to one guided body and both give the
solid the same motion in each way; otherwise their guides would have to be intersected, and such a deck is refused.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.guides import Guides

AGREE = 1e-9
"""Difference of two motions of one solid, over the largest entry, up to which they are the same but for rounding."""


def solid_guides(guides: Guides, label: IntArray, arms: FloatArray) -> Guides:
    """Guides of the solids: each guided solid by its first guided block.

    label : (n_blocks,) solid of each block
    arms  : (n_blocks, 3) from the centroid of the solid to that of the block
    """
    if not len(guides):
        return guides
    _, first = np.unique(label[guides.blocks], return_index=True)
    first = np.sort(first)
    _, bodies = np.unique(guides.bodies[first], return_inverse=True)
    motions = _about_solids(guides, arms)[first]
    return Guides(label[guides.blocks[first]], bodies.astype(np.int64), motions, guides.words)


def guides_at_odds(guides: Guides, label: IntArray, arms: FloatArray) -> tuple[int, int] | None:
    """Two guided blocks of one solid whose guides do not say the same of it; None where there are none."""
    if not len(guides):
        return None
    _, first, row = np.unique(label[guides.blocks], return_index=True, return_inverse=True)
    motions = _about_solids(guides, arms)
    size = np.abs(motions).max(axis=(1, 2), initial=0.0)
    differs = np.abs(motions - motions[first[row]]).max(axis=(1, 2), initial=0.0) > AGREE * size
    odd = np.flatnonzero(differs | (guides.bodies != guides.bodies[first[row]]))
    if not len(odd):
        return None
    return int(guides.blocks[first[row[odd[0]]]]), int(guides.blocks[odd[0]])


def _about_solids(guides: Guides, arms: FloatArray) -> FloatArray:
    """Motions of the guided blocks about the centroids of their solids, (m, 6, 6)."""
    motions = guides.motions.copy()
    motions[:, :3] -= np.cross(motions[:, 3:], arms[guides.blocks][:, :, None], axis=1)
    return np.asarray(motions)
