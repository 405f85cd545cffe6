"""Item `walls`: along the lines of a plan, bonded where they meet."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Literal

import numpy as np
from pydantic import Field

from mbla.deck.kinds.positions import COURSE, LEAF, SEGMENT, UNIT, VOUSSOIR
from mbla.deck.quantities import Index, PlanePoint, Switch
from mbla.deck.section import Section, rule
from mbla.errors import Finding, KeyPath
from mbla.model.blocks.generated import Generated, ItemContext
from mbla.model.blocks.item import ItemKind, register_item
from mbla.model.blocks.masonry.masonry import (
    MATERIALS,
    Buttress,
    Gable,
    Masonry,
    Opening,
    check_part,
    units_of_walls,
)

if TYPE_CHECKING:
    from mbla.model.blocks.masonry.plan import WallLine


class CrossWall(Section):
    """A straight wall besides the main line; an end that lies on another wall is bonded into it."""

    from_: PlanePoint = Field(alias="from", description="where it begins: x, y")
    to: PlanePoint = Field(description="where it ends: x, y")


class OnSegment(Section):
    """On one of several walls."""

    segment: Index = Field(description="which wall: segments of the plan from 0, then the cross walls")


class SegmentOpening(Opening, OnSegment):
    """Opening in one wall of a plan; distances along it are from the first point of its line."""


class SegmentGable(Gable, OnSegment):
    """Gable on one wall of a plan, over its full length with the corners."""


class SegmentButtress(Buttress, OnSegment):
    """Buttress against one wall of a plan."""


class WallsItem(Masonry):
    """Walls along the lines of a plan, on the ground at z = 0, bonded at corners and junctions: of two walls that meet
    one runs through in even courses, that along x, the other in odd courses. Lines run along x or y.
    """

    plan: list[PlanePoint] = Field(min_length=2, description="corners of the main line: x, y of each")
    closed: Switch = Field(False, description="whether the line returns to its first point")
    cross_walls: list[CrossWall] = Field(default_factory=list, description="further walls, for T- and cross-plans")
    side: Literal["left", "right", "centre"] = Field(
        "left", description="where the walls stand, seen along their lines; left is inside where they turn left"
    )
    openings: list[SegmentOpening] = Field(default_factory=list, description="rectangles left free")
    gables: list[SegmentGable] = Field(default_factory=list, description="triangles on top of walls")
    buttresses: list[SegmentButtress] = Field(default_factory=list, description="piers against faces of walls")


SQUARE = 1e-6
"""departure of a line from its axis, relative to its length, that is rounding"""


@rule(WallsItem)
def walls(item: WallsItem) -> Iterator[Finding]:
    """Lines run along the axes and turn by right angles; what belongs to a wall names one that is there."""
    lines = list(plan_lines(item))
    if faults := [*_check_lines(lines), *_check_turns(item)]:
        yield from faults
        return
    lengths = [max(abs(b - a) for a, b in zip(start, end, strict=True)) for _, start, end in lines]
    for key in ("openings", "gables", "buttresses"):
        for number, part in enumerate(getattr(item, key)):
            if part.segment < len(lengths):
                found = check_part(item, part, lengths[part.segment])
            else:
                words = f"must be <= {len(lengths) - 1}: there are {len(lengths)} walls, from 0"
                found = iter([Finding("out-of-bounds", words, "segment")])
            yield from (finding.below(key, number) for finding in found)
    segments = [gable.segment for gable in item.gables]
    for number, segment in enumerate(segments):
        if segment in segments[:number]:
            yield Finding("duplicate-key", f"wall {segment} has a gable already", "gables", number, "segment")


def plan_lines(item: WallsItem) -> Iterator[tuple[KeyPath, Sequence[float], Sequence[float]]]:
    """Key path, start and end of each wall's line: those of the plan, then the cross walls."""
    points = [*item.plan, item.plan[0]] if item.closed else item.plan
    for number in range(len(points) - 1):
        yield ("plan", (number + 1) % len(item.plan)), points[number], points[number + 1]
    for number, cross in enumerate(item.cross_walls):
        yield ("cross_walls", number, "to"), cross.from_, cross.to


def _check_lines(lines: Sequence[tuple[KeyPath, Sequence[float], Sequence[float]]]) -> Iterator[Finding]:
    """Each line has a length, and runs along x or along y."""
    for path, start, end in lines:
        short, long = sorted(abs(b - a) for a, b in zip(start, end, strict=True))
        if long == 0:
            yield Finding("wall-shape", "is the point before it", *path)
        elif short > SQUARE * long:
            words = (
                "must lie along x or along y from the point before it, since only right angles can be bonded here; "
                "a plan in another direction is turned by transform"
            )
            yield Finding("wall-shape", words, *path)


def _check_turns(item: WallsItem) -> Iterator[Finding]:
    """The main line turns by a right angle at each corner."""
    if item.closed and len(item.plan) < 4:
        yield Finding("wall-shape", f"needs 4 points of the plan or more, here are {len(item.plan)}", "closed")
        return
    points = [*item.plan, item.plan[0], item.plan[1]] if item.closed else item.plan
    for number in range(1, len(points) - 1):
        before, here, after = points[number - 1 : number + 2]
        into = [b - a for a, b in zip(before, here, strict=True)]
        out = [b - a for a, b in zip(here, after, strict=True)]
        along = abs(sum(a * b for a, b in zip(into, out, strict=True)))
        size = max(map(abs, into)) * max(map(abs, out))
        if size > 0 and along > (1 - SQUARE) * size:
            message = "must be a corner: the line goes on along the same axis; leave the point out"
            yield Finding("wall-shape", message, "plan", number % len(item.plan))


def generate(item: WallsItem, context: ItemContext) -> Generated:
    """Units wall by wall, in each course by course from the bottom, leaf by leaf; then lintels, arches, buttresses.

    Raises ItemRefused for walls that meet in part or lie on each other, openings off the bed joints or in corners,
    lintels and arches without support, buttresses across openings, gables that meet.
    """
    from mbla.model.blocks.masonry.walls import Walls, build_walls

    walls = Walls(
        item,
        lines_of(item),
        [(opening.segment, opening) for opening in item.openings],
        [(buttress.segment, buttress) for buttress in item.buttresses],
        {gable.segment: gable for gable in item.gables},
        numbered=True,
    )
    return build_walls(walls, item.group or "walls", context)


def lines_of(item: WallsItem) -> list[WallLine]:
    """Walls of the main line, then the cross walls, ends still free where they meet other walls."""
    from mbla.model.blocks.masonry.plan import line_along, reaching_through, turned_corners

    thickness = item.leaves * item.unit[1]
    middle = {"left": 0.5, "centre": 0.0, "right": -0.5}[item.side] * thickness
    every = [
        line_along(np.array(start), np.array(end), middle, thickness, key[:2]) for key, start, end in plan_lines(item)
    ]
    n_lines = len(every) - len(item.cross_walls)
    main = turned_corners(every[:n_lines], middle, closed=item.closed)
    lines = [*main, *every[n_lines:]]
    return [*main, *(reaching_through(line, lines) for line in every[n_lines:])]


def amount(item: WallsItem) -> tuple[float, str]:
    """Units of all walls and their buttresses."""
    length = sum(math.dist(start, end) for _, start, end in plan_lines(item))
    gable = max((gable.rise for gable in item.gables), default=0.0)
    return units_of_walls(item, length, gable, item.buttresses), "plan"


register_item(
    ItemKind(
        "walls",
        WallsItem,
        generate,
        amount,
        after="wall",
        positions=(SEGMENT, COURSE, UNIT, LEAF, VOUSSOIR),
        materials=MATERIALS,
    )
)
