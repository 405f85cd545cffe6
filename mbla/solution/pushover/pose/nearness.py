"""Which solids are near each other, and near the ground: motions of others bring no new contacts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mbla.arrays import BoolArray, IntArray
from mbla.contacts.moved import REACH
from mbla.model.model import Ground
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.plane import meeting_boxes

AROUND = 0.2
"""Distance of a solid from a ground, over its size, up to which it is near."""


@dataclass(frozen=True)
class Nearness:
    """Of solids where contacts were found."""

    blocks: Blocks
    grounds: Sequence[Ground]

    @cached_property
    def pairs(self) -> IntArray:
        """Solids whose boxes are near each other, (n, 2)."""
        blocks = self.blocks
        first = blocks.vertex_start[:-1]
        low, high = np.minimum.reduceat(blocks.vertices, first), np.maximum.reduceat(blocks.vertices, first)
        margin = (REACH * blocks.sizes)[:, None]
        a, b = meeting_boxes(low - margin, high + margin, low - margin, high + margin)
        return np.column_stack([a, b])[a < b]

    @cached_property
    def of_ground(self) -> BoolArray:
        """Which solids are near a ground, (n_solids,): near a plane, or where one has an outline."""
        blocks = self.blocks
        near = np.zeros(len(blocks), dtype=bool)
        for ground in self.grounds:
            if ground.outline is not None:
                return ~near
            height = (blocks.vertices - ground.point) @ ground.normal
            near |= np.minimum.reduceat(height, blocks.vertex_start[:-1]) < AROUND * blocks.sizes
        return near
