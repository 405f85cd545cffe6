"""Guides of blocks that glue joins: the solid moves as its guided block may.

A way (v, ω) of a block at the arm d from the centroid of its solid is the way (v − ω × d, ω) of the solid.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.guides import Guides
from mbla.model.model import Model

SAME = 1e-9
"""difference of two ways of a solid, relative to the larger, that is rounding"""


def guides_of_solids(guides: Guides, label: IntArray, arms: FloatArray) -> Guides:
    """Guides of the solids; of several guided blocks in one solid the first counts, see ``clashing_guides``.

    label : (n_blocks,) solid of each block; arms : (n_blocks, 3) from the centroid of the solid to that of the block
    """
    if not len(guides):
        return guides
    _, first = np.unique(label[guides.blocks], return_index=True)
    kept = np.sort(first)
    _, bodies = np.unique(guides.bodies[kept], return_inverse=True)
    motions = _about_solids(guides, arms)[kept]
    return Guides(label[guides.blocks][kept], bodies.astype(np.int64), motions, guides.words)


def clashing_guides(model: Model, label: IntArray, arms: FloatArray) -> IntArray:
    """Guided blocks of one solid with others that are guided in another way, ascending."""
    guides = model.guides
    solid = label[guides.blocks]
    motions = _about_solids(guides, arms)
    _, first, inverse = np.unique(solid, return_index=True, return_inverse=True)
    leader = first[inverse]
    size = np.abs(motions).max(axis=(1, 2), initial=0.0)
    apart = np.abs(motions - motions[leader]).max(axis=(1, 2), initial=0.0) > SAME * size
    other = (guides.bodies != guides.bodies[leader]) & (np.arange(len(solid)) != leader)
    return np.unique(guides.blocks[apart | other])


def _about_solids(guides: Guides, arms: FloatArray) -> FloatArray:
    """Ways of the guided blocks as ways of their solids, (m, 6, 6)."""
    motions = guides.motions.copy()
    d = arms[guides.blocks]
    motions[:, :3] -= np.cross(guides.motions[:, 3:], d[:, :, None], axis=1)
    return motions
