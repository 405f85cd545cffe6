"""Which blocks a point lies in, or on.

The solid angle of the faces of a block, seen from a point, is 4 π inside and 0 outside of it (van Oosterom and Strackee
1983, doi:10.1109/TBME.1983.325207). Faces are taken as fans of triangles from their first corners, whose signs add up
for outlines that are not convex too. A point on a block is inside when it is moved a little, in one of eight ways.
"""

from __future__ import annotations

from itertools import product

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.ragged import row_maxima

WAYS = np.array(list(product((-1.0, 1.0), repeat=3))) @ np.array(
    [[0.9212, 0.2731, 0.2774], [-0.3261, 0.9314, 0.1616], [-0.2142, -0.2393, 0.9470]]
)
"""Eight ways from a point, (8, 3), along which no face of a building is likely to lie."""


def touched_blocks(point: FloatArray, blocks: Blocks, chosen: IntArray, tolerance: float) -> IntArray:
    """Those of the chosen blocks, (n,), that a point, (3,), lies in or on, in their order.

    tolerance : relative to block size, by which it may lie outside
    """
    start = blocks.vertex_start
    low, high = -row_maxima(-blocks.vertices, start), row_maxima(blocks.vertices, start)
    room = tolerance * blocks.sizes[:, None]
    near = np.all((point >= low - room) & (point <= high + room), axis=1)
    around = chosen[near[chosen]].tolist()
    return np.array([block for block in around if _touches(point, blocks, block, tolerance)], dtype=np.int64)


def is_within(point: FloatArray, blocks: Blocks, block: int, tolerance: float) -> bool:
    """Whether a point, (3,), lies in a block and not on its surface, by more than ``tolerance`` of its size."""
    corners = _triangles(blocks, block)
    moved = point + tolerance * float(blocks.sizes[block]) * WAYS
    return all(_turns_round(each, corners) > 0.5 for each in moved)


def _touches(point: FloatArray, blocks: Blocks, block: int, tolerance: float) -> bool:
    corners = _triangles(blocks, block)
    moved = point + tolerance * float(blocks.sizes[block]) * np.vstack([np.zeros(3), WAYS])
    return any(_turns_round(each, corners) > 0.5 for each in moved)


def _triangles(blocks: Blocks, block: int) -> FloatArray:
    """Faces of a block as fans, (n, 3, 3) m."""
    fans = []
    for face in range(blocks.face_start[block], blocks.face_start[block + 1]):
        loop = blocks.vertices[blocks.loops[blocks.loop_start[face] : blocks.loop_start[face + 1]]]
        fans.append(np.stack([np.broadcast_to(loop[0], loop[1:-1].shape), loop[1:-1], loop[2:]], axis=1))
    return np.concatenate(fans)


def _turns_round(point: FloatArray, corners: FloatArray) -> float:
    """Solid angle of triangles, (n, 3, 3), seen from a point, over 4 π: 1 inside of what they enclose, 0 outside."""
    a, b, c = (corners[:, side] - point for side in range(3))
    la, lb, lc = (np.linalg.norm(each, axis=1) for each in (a, b, c))
    volume = np.einsum("ij,ij->i", a, np.cross(b, c))
    flat = la * lb * lc + (a * b).sum(axis=1) * lc + (b * c).sum(axis=1) * la + (c * a).sum(axis=1) * lb
    return float(np.arctan2(volume, flat).sum() / (2.0 * np.pi))
