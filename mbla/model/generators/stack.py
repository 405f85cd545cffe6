"""Generator of stacks of equal cuboids.

Harmonic overhang: with blocks of length l, the k-th from the top is shifted over the one below by s l/(2 k); at s = 1
the blocks above each joint have their centre of gravity exactly over its edge.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.items.stack import StackItem
from mbla.model.generators.amounts import Amount, refuse_too_many
from mbla.model.generators.generator import Generated, Part, Site
from mbla.model.solids.polyhedra import cuboids


def amount_stack(item: StackItem) -> Amount:
    """How many blocks such an item has."""
    return Amount(item.count, "count")


def generate_stack(item: StackItem, site: Site) -> Generated:
    """Blocks from the bottom.

    Raises
    ------
    ItemRefused
        for more blocks than can be handled
    """
    refuse_too_many(amount_stack(item), item)
    shifts = np.concatenate([np.zeros((1, 2)), np.cumsum(_shifts(item), axis=0)])
    heights = item.block[2] * np.arange(item.count + 1)
    least = np.column_stack([shifts, heights[:-1]])
    greatest = np.column_stack([shifts + item.block[:2], heights[1:]])
    return Generated((Part(cuboids(least, greatest), labels={"drum": np.arange(item.count)}),))


def _shifts(item: StackItem) -> FloatArray:
    """Displacement along x and y of each block but the lowest from the one below, (count - 1, 2)."""
    shifts = np.zeros((item.count - 1, 2))
    if item.shift is not None:
        shifts[:] = item.shift
    elif item.offsets is not None:
        shifts[:, 0] = item.offsets
    elif item.overhang is not None:
        shifts[:, 0] = item.overhang * item.block[0] / (2.0 * np.arange(item.count - 1, 0, -1))
    return shifts
