"""Rules on walls along a plan."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from mbla.deck import types
from mbla.deck.rules.masonry import check_bond, check_buttress, check_gable, check_openings
from mbla.deck.section import Finding, rule
from mbla.errors import Message

SQUARE = 1e-6
"""departure of a line from its axis, relative to its length, that is rounding"""


@rule(types.WallsItem)
def walls(item: types.WallsItem) -> Iterator[Finding]:
    """Lines run along the axes and turn by right angles; what belongs to a wall names one that is there."""
    yield from check_bond(item)
    lines = list(_lines(item))
    found = [*_check_lines(lines), *_check_turns(item)]
    yield from found
    if found:
        return
    lengths = [max(abs(b - a) for a, b in zip(start, end, strict=True)) for _, start, end in lines]
    for key in ("openings", "gables", "buttresses"):
        for number, part in enumerate(getattr(item, key)):
            if part.segment >= len(lengths):
                yield (
                    (key, number, "segment"),
                    Message("out-of-bounds", f"must be <= {len(lengths) - 1}: there are {len(lengths)} walls, from 0"),
                )
                continue
            length = lengths[part.segment]
            if key == "openings":
                yield from check_openings(item, number, length)
                continue
            below = check_gable(part, length) if key == "gables" else check_buttress(item, part, length)
            yield from (((key, number, *path), message) for path, message in below)
    yield from _one_gable_each(item)


def _one_gable_each(item: types.WallsItem) -> Iterator[Finding]:
    segments = [gable.segment for gable in item.gables]
    for number, segment in enumerate(segments):
        if segment in segments[:number]:
            yield ("gables", number, "segment"), Message("duplicate-key", f"wall {segment} has a gable already")


def _lines(item: types.WallsItem) -> Iterator[tuple[tuple[str | int, ...], Sequence[float], Sequence[float]]]:
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
            yield path, Message("wall-shape", "is the point before it")
        elif short > SQUARE * long:
            yield (
                path,
                Message(
                    "wall-shape",
                    "must lie along x or along y from the point before it, since only right angles can be bonded here; "
                    "a plan in another direction is turned by transform",
                ),
            )


def _check_turns(item: types.WallsItem) -> Iterator[Finding]:
    """The main line turns by a right angle at each corner."""
    if item.closed and len(item.plan) < 4:
        yield ("closed",), Message("wall-shape", f"needs 4 points of the plan or more, here are {len(item.plan)}")
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
            yield ("plan", number % len(item.plan)), Message("wall-shape", message)
