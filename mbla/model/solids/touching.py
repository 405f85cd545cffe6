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
from mbla.model.solids.ragged import ranges

WAYS = np.array(list(product((-1.0, 1.0), repeat=3))) @ np.array(
    [[0.9212, 0.2731, 0.2774], [-0.3261, 0.9314, 0.1616], [-0.2142, -0.2393, 0.9470]]
)
"""Eight ways from a point, (8, 3), along which no face of a building is likely to lie."""


def touched_blocks(point: FloatArray, blocks: Blocks, chosen: IntArray, tolerance: float) -> IntArray:
    """Those of the chosen blocks, (n,), that a point, (3,), lies in or on, in their order.

    tolerance : relative to block size, by which it may lie outside
    """
    low, high = blocks.boxes
    room = tolerance * blocks.sizes[:, None]
    near = np.all((point >= low - room) & (point <= high + room), axis=1)
    around = chosen[near[chosen]].tolist()
    return np.array([block for block in around if _touches(point, blocks, block, tolerance)], dtype=np.int64)


def is_within(point: FloatArray, blocks: Blocks, block: int, tolerance: float) -> bool:
    """Whether a point, (3,), lies in a block and not on its surface, by more than ``tolerance`` of its size."""
    corners = _triangles(blocks, block)
    moved = point + tolerance * float(blocks.sizes[block]) * WAYS
    return bool((_turns_round(moved, corners) > 0.5).all())


def _touches(point: FloatArray, blocks: Blocks, block: int, tolerance: float) -> bool:
    corners = _triangles(blocks, block)
    moved = point + tolerance * float(blocks.sizes[block]) * np.vstack([np.zeros(3), WAYS])
    return bool((_turns_round(moved, corners) > 0.5).any())


def _triangles(blocks: Blocks, block: int) -> FloatArray:
    """Faces of a block as fans, (n, 3, 3) m."""
    faces = np.arange(blocks.face_start[block], blocks.face_start[block + 1])
    corners, start = blocks.corners_of(faces)
    first = np.repeat(start[:-1], np.diff(start) - 2)
    second = ranges(start[:-1] + 1, np.diff(start) - 2)
    return np.stack([corners[first], corners[second], corners[second + 1]], axis=1)


def _turns_round(points: FloatArray, corners: FloatArray) -> FloatArray:
    """Solid angle of triangles, (n, 3, 3), seen from points, (m, 3), over 4 π, (m,): 1 inside of what they enclose."""
    a, b, c = (corners[None, :, side] - points[:, None] for side in range(3))
    la, lb, lc = (np.linalg.norm(each, axis=-1) for each in (a, b, c))
    volume = np.einsum("pij,pij->pi", a, np.cross(b, c))
    flat = la * lb * lc + (a * b).sum(axis=-1) * lc + (b * c).sum(axis=-1) * la + (c * a).sum(axis=-1) * lb
    return np.asarray(np.arctan2(volume, flat).sum(axis=1) / (2.0 * np.pi))
