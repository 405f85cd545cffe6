"""What lies nearest to a part of the structure that nothing holds: where a contact was meant, that is the gap in it.

Distances are those of the boxes around blocks, along the axes: exact for walls and piers, and a lower limit for
all else.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.model import Model

MOST = 300
"""blocks of either side, those nearest to the box around the other side, that are compared one by one"""

NONE = 1e-9
"""distance relative to the block size that is rounding of coordinates"""


def nearest_words(model: Model, part: IntArray) -> str:
    """``; nearest to it is lower[33], 0.0128 m from upper[0] ...``; nothing where nothing else is there."""
    blocks, units = model.blocks, model.units
    first = blocks.vertex_start[:-1]
    least, greatest = np.minimum.reduceat(blocks.vertices, first), np.maximum.reduceat(blocks.vertices, first)
    found: list[tuple[float, str, int]] = []
    others = np.setdiff1d(np.arange(len(blocks)), part)
    if len(others):
        gap, own, other = _nearest_pair(least, greatest, part, others)
        found.append((gap, blocks.name(other), own))
    for ground in model.grounds:
        carried = part if ground.blocks is None else np.intersect1d(part, ground.blocks)
        if len(carried):
            heights = np.minimum.reduceat((blocks.vertices - ground.point) @ ground.normal, first)[carried]
            lowest = int(np.argmin(np.abs(heights)))
            found.append((abs(float(heights[lowest])), ground.label, int(carried[lowest])))
    if not found:
        return ""
    gap, name, own = min(found)
    if gap <= NONE * blocks.sizes[own]:
        return f"; nearest to it is {name}, which {blocks.name(own)} meets or overlaps without a common surface"
    return f"; nearest to it is {name}, {gap:.3g} {units.length} from {blocks.name(own)}, by the boxes around them"


def _nearest_pair(least: FloatArray, greatest: FloatArray, part: IntArray, others: IntArray) -> tuple[float, int, int]:
    """Distance of the two nearest boxes, one of the part and one of the others, and their blocks."""
    part = _nearest_to(least, greatest, part, others)
    others = _nearest_to(least, greatest, others, part)  # by the box around what is left of the part
    apart = np.maximum(least[part, None] - greatest[None, others], least[None, others] - greatest[part, None])
    gaps = np.linalg.norm(np.maximum(apart, 0.0), axis=2)
    own, other = np.unravel_index(int(np.argmin(gaps)), gaps.shape)
    return float(gaps[own, other]), int(part[own]), int(others[other])


def _nearest_to(least: FloatArray, greatest: FloatArray, chosen: IntArray, side: IntArray) -> IntArray:
    """Those of the blocks ``chosen`` that are nearest to the box around ``side``."""
    low, high = least[side].min(axis=0), greatest[side].max(axis=0)
    apart = np.maximum(np.maximum(least[chosen] - high, low - greatest[chosen]), 0.0)
    return chosen[np.argsort(np.linalg.norm(apart, axis=1), kind="stable")[:MOST]]
