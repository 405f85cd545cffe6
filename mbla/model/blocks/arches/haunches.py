"""Haunches of arches and barrel vaults: coursed masonry between the extrados and upright backs, up to a level top.

They stand on the piers of the arch, or on level ground from the springing of the extrados outwards.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
from pydantic import Field

from mbla.arrays import FloatArray
from mbla.deck.quantities import Length, PositiveLength
from mbla.deck.section import Section
from mbla.errors import Finding
from mbla.model.blocks.arches.sections import ArchSection, springing_joints, units_across
from mbla.model.blocks.generated import GroundPart, ItemPart, ItemRefused, level_ground


class Backing(Section):
    """Haunches on both sides: coursed masonry on the extrados up to a level top, between upright backs, in one block
    through the width of an arch, in the bond of a barrel vault. Member `backing`, with `course` from the bottom and
    `unit` from the left. They stand on the piers, over the width of these, or from the springing of the extrados
    outwards on what the deck's supports give there, with `springers` on ground of their own.
    """

    top: Length = Field(description="height z of their top, over the springings of the line that has the shape")
    unit: tuple[PositiveLength, PositiveLength] = Field(
        description="length and height of a unit; courses are evened out to fit"
    )
    width: PositiveLength | None = Field(
        None, description="extent beyond the springing of the extrados; with piers it is theirs"
    )


def backing_width(backing: Backing) -> Iterator[Finding]:
    """Without piers haunches need a width."""
    if backing.width is None:
        yield Finding("missing-key", "needs width", "backing")


ON_BASE = 1e-9
"""height over the base, relative to that of the haunches, that is rounding"""


def haunches(
    backing: Backing, section: ArchSection, piers: float | None, across: Callable[[int], FloatArray], shear: float = 0.0
) -> tuple[ItemPart, tuple[GroundPart, ...]]:
    """Blocks of the haunches, and level ground under those at their base, which counts blocks from the first of theirs.

    piers  : width of piers that carry them, None for ground
    across : both ends along y of the units of a course, (n, 2)

    Raises ItemRefused where springings lean inwards, the top lies below them, or units are too large.
    """
    from mbla.model.blocks.arches.spandrels import CoursedMasonry, bed_levels, build_outline, coursed

    left, right = _backs(backing, section, piers)
    line = section.line(-1)
    springings = line[[0, -1], 1]
    if backing.top <= springings.max():
        words = f"must be > {springings.max():g}, the height of the extrados at its springing"
        raise ItemRefused(Finding("out-of-bounds", words, "backing", "top"))
    down = np.array([0.0, springings.min()])
    top = backing.top - down[1]
    if not np.isfinite(top + right - left):
        raise ItemRefused(Finding("out-of-bounds", "is too large to compute with: use other units", "backing", "top"))
    outline = build_outline([np.array([[left, springings[0]], *line, [right, springings[1]]]) - down])
    masonry = CoursedMasonry(*backing.unit, extent=float(min(top, right - left)))
    beds = bed_levels(outline, top, np.array([line[:, 1].max() - down[1]]), springings - down[1], masonry)
    polygons, course, unit = coursed(outline, beds, (left, right), masonry)
    if not polygons:
        words = "is too large for what lies beside the arch: take a smaller unit, or a higher top"
        raise ItemRefused(Finding("out-of-bounds", words, "backing", "unit"))
    polygons = [polygon + down for polygon in polygons]
    made, block, _ = units_across(polygons, [across(number) for number in course.tolist()], shear)
    grounds, bases = [], ((left, line[0, 0]), (right, line[-1, 0]))
    for height, base in zip(springings, bases, strict=True):
        on_base = np.array([_stands(each, min(base), max(base), height, ON_BASE * top) for each in polygons])
        if on_base.any():
            grounds.append(level_ground(np.flatnonzero(on_base[block]), None, (base[0], 0.0, height)))
    part = ItemPart(made, member="backing", labels={"course": course[block], "unit": unit[block]})
    return part, tuple(grounds)


def _backs(backing: Backing, section: ArchSection, piers: float | None) -> tuple[float, float]:
    """Places of the upright backs of the haunches."""
    joints, line = springing_joints(section), section.line(-1)
    if any(joint.rise < 0 for joint in joints):
        words = "haunches need springing joints that are level or rise outwards: at most half a circle"
        raise ItemRefused(Finding("arch-shape", words, "backing"))
    if piers is not None:
        return joints[0].intrados[0] - piers, joints[1].intrados[0] + piers
    width = 0.0 if backing.width is None else backing.width
    return line[0, 0] - width, line[-1, 0] + width


def _stands(polygon: FloatArray, left: float, right: float, height: float, near: float) -> bool:
    """Whether a polygon (k, 2) has an edge on a level base, by its left end, right end and height."""
    on = polygon[np.abs(polygon[:, 1] - height) <= near, 0]
    return bool(len(on) > 1 and min(on.max(), right) - max(on.min(), left) > near)


def grounds_behind(grounds: tuple[GroundPart, ...], before: int, joint: str | None) -> tuple[GroundPart, ...]:
    """Ground under haunches whose blocks come behind ``before`` others of the item."""
    return tuple(replace(ground, blocks=before + ground.blocks, joint=joint) for ground in grounds)


def with_backing(backing: Backing | None, carrying: float, key: str, length: float) -> tuple[float, str]:
    """Units with those of haunches on both sides of an arch, which are no longer than it and their width."""
    if backing is None or not math.isfinite(length + backing.top):
        return carrying, key
    along = max((length + 2 * (backing.width or 0.0)) / backing.unit[0], 1.0)
    filling = along * max(backing.top / backing.unit[1], 1.0)
    return carrying + filling, "backing" if filling > carrying else key
