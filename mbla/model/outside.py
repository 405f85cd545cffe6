"""Points that are said to belong to a block and lie off it."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.blocks import Blocks

OUTSIDE = 0.01
"""distance of a point from the bounding box of its block, relative to the diagonal, from which it is remarked on"""


def distance_outside(point: FloatArray, block: int, blocks: Blocks) -> float:
    """Distance of a point, (3,), from the bounding box of a block; 0 inside it and as good as inside."""
    vertices = blocks.vertices[blocks.vertex_start[block] : blocks.vertex_start[block + 1]]
    least, greatest = vertices.min(axis=0), vertices.max(axis=0)
    off = float(np.linalg.norm(np.maximum(0.0, np.maximum(least - point, point - greatest))))
    return off if off > OUTSIDE * float(np.linalg.norm(greatest - least)) else 0.0
