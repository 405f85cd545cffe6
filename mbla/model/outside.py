"""Points that lie outside of the block which a deck gives for them: how far, and in what unit they would not."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.units import METRES, Units
from mbla.model.solids.blocks import Blocks
from mbla.model.wording import vector

OUTSIDE = 0.01
"""distance of a point from the bounding box of its block, relative to the diagonal, from which it is remarked on"""
FAR, NEAR = 10.0, 0.5
"""distance over the size of the structure beyond which nothing is meant to act, and within which a point is of it"""


@dataclass(frozen=True)
class Outside:
    """Where a point lies that is not in its block.

    words : how far outside, and in which unit it would be at the structure
    far   : so far that no arm reaches there
    """

    words: str
    far: bool


def outside(point: FloatArray, block: int, blocks: Blocks, units: Units) -> Outside | None:
    """A point, (3,), held against the bounding box of a block; None inside it and as good as inside."""
    own, every = (blocks.boxes[0][block], blocks.boxes[1][block]), (blocks.boxes[0].min(0), blocks.boxes[1].max(0))
    off, length = _distance(point, *own), units.length
    if off <= OUTSIDE * float(np.linalg.norm(own[1] - own[0])):
        return None
    size = float(np.linalg.norm(every[1] - every[0]))
    if off <= FAR * size:
        return Outside(f"{off:.4g} {length} outside that block", False)
    words = f"{off:.4g} {length} outside that block, of a structure that is {size:.4g} {length} large"
    for unit in METRES:
        there = point * (METRES[unit] / METRES[length])
        if _distance(there, *every) <= NEAR * size:
            return Outside(f"{words}; in {unit} it would be at {vector(there)} {length}", True)
    return Outside(words, True)


def _distance(point: FloatArray, least: FloatArray, greatest: FloatArray) -> float:
    """Distance of a point from a box, (3,) each; 0 inside."""
    return float(np.linalg.norm(np.maximum(0.0, np.maximum(least - point, point - greatest))))
