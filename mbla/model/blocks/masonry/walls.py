"""Walls along lines, bonded where they meet, with what belongs to them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import Finding
from mbla.model.blocks.generated import Generated, ItemContext, ItemPart, ItemRefused
from mbla.model.blocks.masonry.additions import (
    PlacedButtress,
    PlacedOpening,
    buttress_leg,
    check_opening,
    check_wall,
    levels_with_top,
    place_buttress,
    place_opening,
    spans_of,
)
from mbla.model.blocks.masonry.bonds import random_levels
from mbla.model.blocks.masonry.courses import units_of
from mbla.model.blocks.masonry.leg import Leg, Passage, Slopes
from mbla.model.blocks.masonry.masonry import Buttress, Gable, Masonry, Opening
from mbla.model.blocks.masonry.plan import WallLine, check_plan, passages_of
from mbla.model.blocks.masonry.unspanned import unspanned


@dataclass(frozen=True)
class Walls:
    """Walls along lines, and what belongs to each by its number.

    item     : units and bond of all
    gables   : by the number of their wall
    numbered : whether blocks are labelled by the number of their wall
    """

    item: Masonry
    lines: Sequence[WallLine]
    openings: Sequence[tuple[int, Opening]]
    buttresses: Sequence[tuple[int, Buttress]]
    gables: Mapping[int, Gable]
    numbered: bool = False


@dataclass(frozen=True)
class _BondedWall:
    """A wall along a line with what belongs to it, and the walls that it shares squares with, by number."""

    line: WallLine
    openings: list[PlacedOpening]
    buttresses: list[PlacedButtress]
    meets: tuple[tuple[int, Passage], ...]


def build_walls(given: Walls, name: str, context: ItemContext) -> Generated:
    """Blocks of walls; ``name`` is that of their group.

    Raises ItemRefused with all that does not fit.
    """
    item, lines = given.item, given.lines
    if findings := list(check_plan(lines)):
        raise ItemRefused(*findings)
    sound: list[tuple[int, int, Opening]] = []
    for number, (segment, opening) in enumerate(given.openings):
        found = [each.below("openings", number) for each in check_opening(item, opening, context.tolerance)]
        findings += found
        sound += [] if found else [(number, segment, opening)]
    against = [(n, segment, each) for n, (segment, each) in enumerate(given.buttresses)]
    meets = passages_of(lines, item.courses)
    walls = [
        _BondedWall(
            line,
            [place_opening(item, n, opening, line.before) for n, segment, opening in sound if segment == number],
            [place_buttress(item, n, buttress, line.before) for n, segment, buttress in against if segment == number],
            meets[number],
        )
        for number, line in enumerate(lines)
    ]
    for wall in walls:
        findings += check_wall(item, wall.openings, wall.buttresses, wall.meets, wall.line.whole_length)
    findings += _check_gables(list(given.gables), meets)
    if findings:
        raise ItemRefused(*findings)
    levels = random_levels(item, _fixed_levels(walls))
    legs = [_leg(given, number, wall, levels) for number, wall in enumerate(walls)]
    notices = [each for leg, wall in zip(legs, walls, strict=True) for each in unspanned(leg, wall.openings, name)]
    return Generated(tuple(_parts(walls, legs, numbered=given.numbered)), notices=tuple(notices))


def _fixed_levels(walls: Sequence[_BondedWall]) -> list[int]:
    """Bed joints that random heights of courses leave where they are."""
    voids = [void for wall in walls for opening in wall.openings for void in opening.voids]
    found = [level for void in voids for level in (void.bottom, void.top)]
    return found + [buttress.courses for wall in walls for buttress in wall.buttresses]


def _leg(given: Walls, number: int, wall: _BondedWall, levels: FloatArray) -> Leg:
    """How a wall is laid; where it meets others, or is of a plan, remainders are joined to the next unit."""
    item, line, gable = given.item, wall.line, given.gables.get(number)
    passages = [passage for _, passage in wall.meets]
    passages += [placed.passage for placed in wall.buttresses if placed.buttress.bonded]
    leg = Leg(
        item=item,
        origin=line.origin,
        along=line.along,
        length=line.whole_length,
        levels=levels,
        level_courses=item.courses,
        voids=tuple(void for opening in wall.openings for void in opening.voids),
        passages=tuple(sorted(passages, key=lambda passage: passage.left)),
        swapped=not line.along_x,
        fitted=given.numbered or bool(passages),
        number=number,
    )
    if gable is None:
        return leg
    apex = leg.length / 2 if gable.apex is None else gable.apex + line.before
    slopes = Slopes(0.0, leg.length, apex, float(levels[-1]), gable.rise)
    return replace(leg, slopes=slopes, levels=levels_with_top(levels, gable.rise, item.unit[2]))


def _check_gables(numbers: Sequence[int], meets: Sequence[tuple[tuple[int, Passage], ...]]) -> Iterator[Finding]:
    """Of two walls that meet one has a gable at most; numbers of walls that have one."""
    for n, number in enumerate(numbers):
        if any(other in numbers[:n] for other, _ in meets[number]):
            yield Finding("wall-shape", "meets a wall that has a gable too", "gables", n, "segment")


def _parts(walls: Sequence[_BondedWall], legs: Sequence[Leg], numbered: bool) -> Iterator[ItemPart]:
    """Blocks of walls: the units of each, then what spans their openings, then the buttresses.

    numbered : whether blocks are labelled by the number of their wall

    Raises ItemRefused where openings leave nothing of the walls.
    """
    parts = [(units_of(leg), leg) for leg in legs]
    if not any(len(part.polyhedra) for part, _ in parts):
        raise ItemRefused(Finding("wall-shape", "nothing is left of the wall", "openings"))
    both = list(zip(walls, legs, strict=True))
    parts += [(part, leg) for wall, leg in both for part in spans_of(leg, wall.openings)]
    parts += [(units_of(buttress_leg(leg, placed)), leg) for wall, leg in both for placed in wall.buttresses]
    for part, leg in parts:
        if len(part.polyhedra):
            segment = {"segment": np.full(len(part.polyhedra), leg.number)} if numbered else {}
            yield replace(part, labels={**part.labels, **segment})
