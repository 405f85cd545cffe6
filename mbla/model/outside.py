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
    vertices = blocks.vertices[blocks.vertex_start[block] : blocks.vertex_start[block + 1]]
    off, length = _distance(point, vertices), units.length
    if off <= OUTSIDE * float(np.linalg.norm(np.ptp(vertices, axis=0))):
        return None
    size = float(np.linalg.norm(np.ptp(blocks.vertices, axis=0)))
    if off <= FAR * size:
        return Outside(f"{off:.4g} {length} outside that block", False)
    words = f"{off:.4g} {length} outside that block, of a structure that is {size:.4g} {length} large"
    for unit in METRES:
        there = point * (METRES[unit] / METRES[length])
        if _distance(there, blocks.vertices) <= NEAR * size:
            return Outside(f"{words}; in {unit} it would be at {vector(there)} {length}", True)
    return Outside(words, True)


def _distance(point: FloatArray, vertices: FloatArray) -> float:
    """Distance of a point, (3,), from the bounding box of vertices, (n, 3); 0 inside."""
    least, greatest = vertices.min(axis=0), vertices.max(axis=0)
    return float(np.linalg.norm(np.maximum(0.0, np.maximum(least - point, point - greatest))))
