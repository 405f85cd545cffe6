"""Items `wall` and `walls`: a straight wall, and walls along the lines of a plan, bonded where they meet."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Literal

from pydantic import Field

from mbla.deck.items.masonry import Buttress, Gable, Masonry, Opening, check_buttress, check_gable, check_opening
from mbla.deck.quantities import Index, PlanePoint, PositiveLength, Switch
from mbla.deck.section import Section, rule
from mbla.errors import Finding


class WallItem(Masonry):
    """A straight wall: runs along +x from the origin, rises along +z, thickness along +y."""

    length: PositiveLength = Field(description="length of the wall; the closing units are cut to fit")
    openings: list[Opening] = Field(default_factory=list, description="rectangles left free")
    gable: Gable | None = Field(None, description="triangle on top")
    buttresses: list[Buttress] = Field(default_factory=list, description="piers against its faces")


@rule(WallItem)
def wall(item: WallItem) -> Iterator[Finding]:
    """All that a straight wall has."""
    for number, opening in enumerate(item.openings):
        yield from (finding.below("openings", number) for finding in check_opening(item, opening, item.length))
    if item.gable is not None:
        yield from (finding.below("gable") for finding in check_gable(item, item.gable, item.length))
    for number, buttress in enumerate(item.buttresses):
        found = check_buttress(item, buttress, item.length)
        yield from (finding.below("buttresses", number) for finding in found)


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
    for key, check in (("openings", check_opening), ("gables", check_gable), ("buttresses", check_buttress)):
        for number, part in enumerate(getattr(item, key)):
            if part.segment < len(lengths):
                found = check(item, part, lengths[part.segment])
            else:
                words = f"must be <= {len(lengths) - 1}: there are {len(lengths)} walls, from 0"
                found = iter([Finding("out-of-bounds", words, "segment")])
            yield from (finding.below(key, number) for finding in found)
    segments = [gable.segment for gable in item.gables]
    for number, segment in enumerate(segments):
        if segment in segments[:number]:
            yield Finding("duplicate-key", f"wall {segment} has a gable already", "gables", number, "segment")


def plan_lines(item: WallsItem) -> Iterator[tuple[tuple[str | int, ...], Sequence[float], Sequence[float]]]:
    """Key path, start and end of each wall's line: those of the plan, then the cross walls."""
    points = [*item.plan, item.plan[0]] if item.closed else item.plan
    for number in range(len(points) - 1):
        yield ("plan", (number + 1) % len(item.plan)), points[number], points[number + 1]
    for number, cross in enumerate(item.cross_walls):
        yield ("cross_walls", number, "to"), cross.from_, cross.to


def _check_lines(
    lines: Sequence[tuple[tuple[str | int, ...], Sequence[float], Sequence[float]]],
) -> Iterator[Finding]:
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
