"""Haunches of arches and barrel vaults: coursed masonry between the extrados and upright backs, up to a level top.

They stand on the piers of the arch, or on level ground from the springing of the extrados outwards.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import numpy as np
from pydantic import Field

from mbla.arrays import FloatArray, IntArray
from mbla.deck.quantities import Length, PositiveLength
from mbla.deck.section import Section
from mbla.errors import Finding
from mbla.model.blocks.arches.sections import ArchSection, springing_joints
from mbla.model.blocks.generated import GroundPart, ItemRefused, Part
from mbla.model.solids.polyhedra import prisms


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
) -> tuple[Part, tuple[IntArray, IntArray], tuple[FloatArray, FloatArray]]:
    """Blocks of the haunches; which of them stand on the base left and right; and a point of either base, (3,).

    piers  : width of piers that carry them, None for ground
    across : both ends along y of the units of a course, (n, 2)

    Raises ItemRefused where springings lean inwards, the top lies below them, or units are too large.
    """
    from mbla.model.blocks.arches.spandrels import Masonry, bed_levels, build_outline, coursed

    joints = springing_joints(section)
    if any(joint.rise < 0 for joint in joints):
        words = "haunches need springing joints that are level or rise outwards: at most half a circle"
        raise ItemRefused(Finding("arch-shape", words, "backing"))
    line = section.line(-1)
    width = 0.0 if backing.width is None else backing.width
    left, right = line[0, 0] - width, line[-1, 0] + width
    if piers is not None:
        left, right = joints[0].intrados[0] - piers, joints[1].intrados[0] + piers
    low = float(min(line[0, 1], line[-1, 1]))
    if backing.top <= max(line[0, 1], line[-1, 1]):
        words = f"must be > {max(line[0, 1], line[-1, 1]):g}, the height of the extrados at its springing"
        raise ItemRefused(Finding("out-of-bounds", words, "backing", "top"))
    down = np.array([0.0, low])
    ends = np.array([[left, line[0, 1]]]), np.array([[right, line[-1, 1]]])
    outline = build_outline([ends[0] - down, line - down, ends[1] - down])
    top = backing.top - low
    if not np.isfinite(top + right - left):
        raise ItemRefused(Finding("out-of-bounds", "is too large to compute with: use other units", "backing", "top"))
    masonry = Masonry(*backing.unit, extent=float(min(top, right - left)))
    shelves = np.array([line[0, 1], line[-1, 1]]) - low
    beds = bed_levels(outline, top, np.array([line[:, 1].max() - low]), shelves, masonry)
    polygons, course, unit = coursed(outline, beds, (left, right), masonry)
    if not polygons:
        words = "is too large for what lies beside the arch: take a smaller unit, or a higher top"
        raise ItemRefused(Finding("out-of-bounds", words, "backing", "unit"))
    rows = [across(number) for number in course.tolist()]
    block = np.repeat(np.arange(len(polygons)), [len(row) for row in rows])
    raised = [polygon + down for polygon in polygons]
    made = prisms([raised[row] for row in block.tolist()], np.concatenate(rows), shear)
    part = Part(made, member="backing", labels={"course": course[block], "unit": unit[block]})
    on_base = [
        np.flatnonzero([_stands(raised[row], side, ON_BASE * top) for row in block.tolist()])
        for side in ((left, float(line[0, 0]), float(line[0, 1])), (float(line[-1, 0]), right, float(line[-1, 1])))
    ]
    bases = np.array([left, 0.0, line[0, 1]]), np.array([right, 0.0, line[-1, 1]])
    return part, (on_base[0], on_base[1]), bases


def _stands(polygon: FloatArray, base: tuple[float, float, float], near: float) -> bool:
    """Whether a polygon (k, 2) has an edge on a level base, by its left end, right end and height."""
    left, right, height = base
    on = polygon[np.abs(polygon[:, 1] - height) <= near, 0]
    return bool(len(on) > 1 and min(on.max(), right) - max(on.min(), left) > near)


def haunch_grounds(
    stand: tuple[IntArray, IntArray], bases: tuple[FloatArray, FloatArray], before: int, joint: str | None
) -> tuple[GroundPart, ...]:
    """Level ground under the haunches; ``before`` blocks of the item come before theirs."""
    up = np.array([0.0, 0.0, 1.0])
    return tuple(
        GroundPart(base, up, before + blocks, joint) for base, blocks in zip(bases, stand, strict=True) if len(blocks)
    )


def with_backing(backing: Backing | None, carrying: float, key: str, length: float) -> tuple[float, str]:
    """Units with those of haunches on both sides of an arch, which are no longer than it and their width."""
    if backing is None or not math.isfinite(length + backing.top):
        return carrying, key
    along = max((length + 2 * (backing.width or 0.0)) / backing.unit[0], 1.0)
    filling = along * max(backing.top / backing.unit[1], 1.0)
    return carrying + filling, "backing" if filling > carrying else key
