"""Glue: blocks that interfaces of the joint law *glued* join to one rigid body, or to a support.

Blocks that glue joins to a support, directly or through others, do not move. Every block that moves belongs to one
rigid body, most of them alone; what the solver sees of them is in :mod:`mbla.assembly.rigid_bodies`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, IntArray
from mbla.model.model import Model
from mbla.model.solids.measures import connected_labels
from mbla.model.solids.ragged import numbered


@dataclass(frozen=True)
class Glue:
    """What glued interfaces make of the blocks.

    solid_of_block : (n_blocks,) numbered from 0 in the order of their first blocks; None where nothing is joined
    held           : (n_blocks,) blocks that are glued to a support and do not move
    """

    solid_of_block: IntArray | None
    held: BoolArray


def solid_sizes(solid_of_block: IntArray | None) -> IntArray:
    """How many blocks each of the solids of several blocks has, (n,)."""
    if solid_of_block is None:
        return np.zeros(0, dtype=np.int64)
    sizes = np.bincount(solid_of_block)
    return np.asarray(sizes[sizes > 1])


def glue_blocks(model: Model, bodies: IntArray) -> Glue:
    """Solids that the glued interfaces between bodies (n, 2) make."""
    n_blocks = len(model.blocks)
    if not len(bodies):
        return Glue(None, np.zeros(n_blocks, dtype=bool))
    still = np.concatenate([model.fixed, np.ones(len(model.grounds), dtype=bool)])
    node = np.append(np.where(still, n_blocks, np.arange(len(still))), n_blocks)  # all supports are one node
    part = connected_labels(node[bodies], n_blocks + 1)
    held = (part[:n_blocks] == part[n_blocks]) & ~model.fixed
    own = part.max() + 1 + np.arange(n_blocks)
    label, first = numbered(np.where(held | model.fixed, own, part[:n_blocks]))
    return Glue(None if len(first) == n_blocks else label, held)
