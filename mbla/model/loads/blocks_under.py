"""Which block lies under a point, or under each part of a line.

One looks from the point in a direction: the block is the one that the point lies in, or else the first one ahead.
As blocks do not overlap, that is the block of the first face ahead through which the direction leads *out*, so that
points on a top face and points inside a block need no case of their own.

A line is looked at in the curtain that it spans with that direction, in coordinates s along the line, 0 to 1, and h
along the direction. Every such face cuts the curtain in segments over s; between two ends of segments no two of them
cross, so that the middle of each interval decides for all of it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.plane import unit
from mbla.model.solids.ragged import items_of_rows, next_item

GRAZING = 1e-9
"""cosine between a face's normal and the direction, below which the direction runs along the face"""
BEHIND = 1e-6
"""a point may lie behind the outer side of a block by this share of the block's size and still be taken to lie on it"""


@dataclass(frozen=True)
class Stretch:
    """Parts of a line by what lies under them, in order.

    ends   : (n + 1,) from 0 to 1 along the line
    blocks : (n,) the block under each part, -1 where there is none
    above  : (n,) how far the middle of each part lies before the block's near side; negative: inside it
    """

    ends: FloatArray
    blocks: IntArray
    above: FloatArray


@dataclass(frozen=True)
class _Segments:
    """Cuts of faces with a curtain: from (s0, h0) to (s1, h1) with s0 < s1; all (n,)."""

    s0: FloatArray
    h0: FloatArray
    s1: FloatArray
    h1: FloatArray
    block: IntArray

    def heights(self, s: FloatArray) -> FloatArray:
        """Height of each segment over each s, inf where it does not reach, (n_s, n)."""
        t = (s[:, None] - self.s0) / (self.s1 - self.s0)
        return np.where((t >= 0.0) & (t <= 1.0), self.h0 + t * (self.h1 - self.h0), np.inf)


def stretches_under(
    begin: FloatArray, end: FloatArray, towards: FloatArray, chosen: IntArray, blocks: Blocks
) -> tuple[Stretch, Stretch]:
    """What lies under a line from ``begin`` to ``end``, (3,) each, just left and just right of it.

    Only the ``chosen`` blocks count. The two differ where the line runs along a joint, or along an edge.
    """
    down = unit(towards)
    aside = unit(np.cross(end - begin, down)) * BEHIND * float(blocks.sizes[chosen].min(initial=np.inf))
    return (
        _stretch(begin - aside, end - aside, down, chosen, blocks),
        _stretch(begin + aside, end + aside, down, chosen, blocks),
    )


def block_under(point: FloatArray, towards: FloatArray, chosen: IntArray, blocks: Blocks) -> tuple[int, float]:
    """The block under a point (3,), -1 where there is none, and how far the point lies before its near side.

    On a joint it is the block with the lower number.
    """
    down = unit(towards)
    axis = np.eye(3)[np.argmin(np.abs(down))]
    half = unit(axis - (axis @ down) * down) * BEHIND * float(blocks.sizes[chosen].min(initial=np.inf))
    both = stretches_under(point - half, point + half, down, chosen, blocks)
    found = np.concatenate([stretch.blocks for stretch in both])
    above = np.concatenate([stretch.above for stretch in both])
    if not (found >= 0).any():
        return -1, 0.0
    first = int(np.argmin(np.where(found >= 0, found, np.iinfo(np.int64).max)))
    return int(found[first]), float(above[first])


def _stretch(begin: FloatArray, end: FloatArray, down: FloatArray, chosen: IntArray, blocks: Blocks) -> Stretch:
    leaving = _cuts(begin, end, down, chosen, blocks, 1.0)
    entering = _cuts(begin, end, down, chosen, blocks, -1.0)
    ends = np.unique(np.clip(np.concatenate([[0.0, 1.0], leaving.s0, leaving.s1]), 0.0, 1.0))
    middles = (ends[:-1] + ends[1:]) / 2
    found, above = _first_ahead(middles, leaving, entering, blocks)
    first = np.append(0, np.flatnonzero(np.diff(found) != 0) + 1)
    return Stretch(np.append(ends[first], 1.0), found[first], above[first])


def _first_ahead(s: FloatArray, leaving: _Segments, entering: _Segments, blocks: Blocks) -> tuple[IntArray, FloatArray]:
    """Block of the first face ahead that leads out, -1 for none, and how far ahead its near side is."""
    nothing = np.full(len(s), -1, dtype=np.int64), np.zeros(len(s))
    if not len(leaving.block):
        return nothing
    heights = leaving.heights(s)
    heights = np.where(heights > BEHIND * blocks.sizes[leaving.block], heights, np.inf)
    row = np.argmin(heights, axis=1)
    out = heights[np.arange(len(s)), row]
    found = np.where(np.isfinite(out), leaving.block[row], -1)
    inward = entering.heights(s)
    inward = np.where((entering.block == found[:, None]) & (inward <= out[:, None]), inward, -np.inf)
    near = inward.max(axis=1, initial=-np.inf)
    return found, np.where(np.isfinite(near), near, 0.0)


def _cuts(
    begin: FloatArray, end: FloatArray, down: FloatArray, chosen: IntArray, blocks: Blocks, sign: float
) -> _Segments:
    """Segments in which faces that lead out (sign +1) or in (-1) cut the curtain of a line."""
    run = end - begin
    across = run - (run @ down) * down
    length = float(np.linalg.norm(across))
    along, normal = across / length, np.cross(across / length, down)
    faces = items_of_rows(blocks.face_start, chosen)
    faces = faces[sign * (blocks.face_normals[faces] @ down) > GRAZING]
    counts = blocks.loop_start[faces + 1] - blocks.loop_start[faces]
    corners = blocks.vertices[blocks.loops[items_of_rows(blocks.loop_start, faces)]] - begin
    side, s, h = corners @ normal, (corners @ along) / length, corners @ down
    h = h - s * (run @ down)
    start = np.append(0, np.cumsum(counts))
    after = next_item(start)
    # a corner on the curtain belongs to its right side: each face is then crossed an even number of times
    crossed = (side >= 0.0) != (side[after] >= 0.0)
    t = side[crossed] / (side[crossed] - side[after][crossed])
    s_at = s[crossed] + t * (s[after] - s)[crossed]
    h_at = h[crossed] + t * (h[after] - h)[crossed]
    face = np.repeat(np.arange(len(faces)), counts)[crossed]
    order = np.lexsort((s_at, face))
    pairs = s_at[order].reshape(-1, 2), h_at[order].reshape(-1, 2)
    owner = blocks.block_of_face[faces[face[order][::2]]]
    wide = pairs[0][:, 1] - pairs[0][:, 0] > 0.0
    (s0, s1), (h0, h1) = pairs[0][wide].T, pairs[1][wide].T
    return _Segments(s0, h0, s1, h1, owner[wide])
