"""Supports: blocks that do not move, and rigid ground behind planes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.deck.tree import KeyPath
from mbla.deck.types import GroundPlane, Support
from mbla.errors import Fault
from mbla.model.blocks import Blocks
from mbla.model.model import Ground
from mbla.model.ragged import row_maxima
from mbla.model.selectors import Roster, select_blocks
from mbla.model.wording import named, vector

FACING = 0.99
"""cosine of the greatest angle between a face and the ground it lies on"""


@dataclass(frozen=True)
class Supports:
    """``fixed`` (n_blocks,) blocks that do not move; grounds in the order of the deck, those of arches first."""

    fixed: BoolArray
    grounds: tuple[Ground, ...]


def build_supports(
    supports: Sequence[Support],
    default_joint: str,
    brought_along: Supports,
    roster: Roster,
    tolerance: float,
    faults: list[Fault],
) -> Supports:
    """Supports of the deck, with those that items bring along.

    brought_along : fixed blocks and grounds of items, such as the springers of arches
    tolerance     : by which faces may leave the plane of the ground, relative to block size

    Adds to ``faults``: grounds with blocks below them or without a face on them, structures without support, and
    structures in which nothing can move.
    """
    fixed = brought_along.fixed.copy()
    grounds: list[tuple[KeyPath, Ground]] = []
    complete = not roster.partial
    for number, support in enumerate(supports):
        path: KeyPath = ("supports", number)
        chosen = None
        if support.blocks is not None:
            chosen = select_blocks(support.blocks, (*path, "blocks"), roster, faults)
            if chosen is None:
                complete = False
                continue
        if support.ground is None:
            fixed[chosen] = True
        else:
            point, normal, label = _plane(support.ground)
            joint = support.joint or default_joint
            grounds.append(((*path, "ground"), Ground(point, normal, joint, chosen, label)))
    for path, ground in grounds:
        _check_ground(ground, path, fixed, roster, tolerance, faults)
    everything = (*brought_along.grounds, *(ground for _, ground in grounds))
    if complete:
        if not fixed.any() and not everything:
            faults.append(roster.fault_at(("supports",), "nothing holds the structure: give ground or fixed blocks"))
        if fixed.all():
            faults.append(roster.fault_at(("supports",), "every block is fixed: nothing can move"))
    return Supports(fixed, everything)


def _plane(ground: GroundPlane) -> tuple[FloatArray, FloatArray, str]:
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


def _check_ground(
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
        faults.append(roster.fault_at(path, _sunk_in_words(sunk, depths, blocks)))
    elif not _faces_on(ground, heights, may_carry, blocks, tolerance) and not roster.partial:
        lowest = -depths[may_carry].max() if may_carry.any() else np.nan
        nearest = f"; the nearest block begins {lowest:.4g} above it" if lowest > 0 else ""
        faults.append(roster.fault_at(path, f"no face of a block that can move lies on it{nearest}"))


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
