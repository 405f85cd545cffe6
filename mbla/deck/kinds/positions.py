"""Positions that items give their blocks, counted from 0: keys of selectors and labels of blocks.

Here are those that several kinds of items share; a kind may bring one of its own.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class BlockPosition:
    """A position.

    name  : key of selectors
    words : what it counts
    depth : of what it counts; negative positions count from the last one in each of the parts of less depth that are
            chosen besides
    """

    name: str
    words: str
    depth: int


COURSE = BlockPosition("course", "course of a wall or vault, from the bottom", 5)
UNIT = BlockPosition("unit", "position along its course", 8)
LEAF = BlockPosition("leaf", "leaf of a wall, from its front; headers have none", 3)
VOUSSOIR = BlockPosition("voussoir", "position along an arch", 9)
RING = BlockPosition("ring", "ring of a dome, from the springing; of an arch, from inside", 4)
SEGMENT = BlockPosition("segment", "position around a ring; wall of a plan", 2)
TREAD = BlockPosition("tread", "step of a stair, from the bottom", 6)
DRUM = BlockPosition("drum", "position in a column or stack, from the bottom", 7)
SPAN = BlockPosition("span", "span of a bridge, or web of a vault", 1)
COPY = BlockPosition("copy", "repetition of the item", 0)
SHARED = (COURSE, UNIT, LEAF, VOUSSOIR, RING, SEGMENT, TREAD, DRUM, SPAN)
"""in the order of the schema; others follow, copies come last"""
NONE = -1
"""position of a block that has none of some name"""
