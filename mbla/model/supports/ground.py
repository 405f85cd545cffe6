"""Rigid ground behind planes: floors, walls, abutments of any inclination."""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.deck.tree import KeyPath
from mbla.deck.types import GroundPlane
from mbla.errors import Fault, Message
from mbla.model.blocks import Blocks
from mbla.model.model import Ground
from mbla.model.ragged import row_maxima
from mbla.model.selectors import Roster
from mbla.model.wording import named, vector

FACING = 0.99
"""cosine of the greatest angle between a face and the ground it lies on"""


def plane(ground: GroundPlane) -> tuple[FloatArray, FloatArray, str]:
    """Point, unit normal and label of a ground plane."""
    for axis, key in enumerate("xyz"):
        coordinate = getattr(ground, key)
        if coordinate is not None:
            unit = np.eye(3)[axis]
            return coordinate * unit, unit, f"ground {key} = {coordinate:g}"
    assert ground.point is not None and ground.normal is not None  # noqa: PT018 - one rule of the deck
    point, normal = np.array(ground.point), np.array(ground.normal)
    normal = normal / np.abs(normal).max()  # so that squares neither overflow nor vanish
    normal = normal / np.linalg.norm(normal)
    return point, normal, f"ground at {vector(point)} with normal {vector(normal)}"


def check_ground(
    ground: Ground, path: KeyPath, fixed: BoolArray, roster: Roster, tolerance: float, faults: list[Fault]
) -> None:
    """Blocks it may carry must not reach below it, and one of their faces must lie on it."""
    blocks = roster.blocks
    # what cannot be built need not lie right, either
    may_carry = ~fixed & ~np.isin(np.array(blocks.groups), list(roster.partial))
    if ground.blocks is not None:
        may_carry &= np.isin(np.arange(len(blocks)), ground.blocks)
    heights = (blocks.vertices - ground.point) @ ground.normal
    depths = row_maxima(-heights, blocks.vertex_start)
    sunk = np.flatnonzero(may_carry & (depths > tolerance * blocks.sizes))
    if len(sunk):
        faults.append(roster.fault_at(path, Message("ground-misplaced", _sunk_in_words(sunk, depths, blocks))))
    elif not _faces_on(ground, heights, may_carry, blocks, tolerance) and not roster.partial:
        lowest = -depths[may_carry].max() if may_carry.any() else np.nan
        nearest = f"; the nearest block begins {lowest:.4g} above it" if lowest > 0 else ""
        faults.append(
            roster.fault_at(path, Message("ground-misplaced", f"no face of a block that can move lies on it{nearest}"))
        )


def _sunk_in_words(sunk: IntArray, depths: FloatArray, blocks: Blocks) -> str:
    worst = sunk[np.argmax(depths[sunk])]
    verb = "reaches" if len(sunk) == 1 else "reach"
    most = "" if len(sunk) == 1 else f", {blocks.name(int(worst))}"
    return (
        f"{named(sunk, blocks.name)} {verb} below it{most} by {depths[worst]:.4g}; "
        "move the plane, or name the blocks it carries with blocks"
    )


def _faces_on(ground: Ground, heights: FloatArray, may_carry: BoolArray, blocks: Blocks, tolerance: float) -> bool:
    """Whether a face of one of the blocks lies on the ground, looking down at it."""
    allowed = tolerance * blocks.sizes[blocks.block_of_face]
    away = row_maxima(np.abs(heights[blocks.loops]), blocks.loop_start)
    facing = blocks.face_normals @ ground.normal < -FACING
    return bool((facing & (away <= allowed) & may_carry[blocks.block_of_face]).any())
