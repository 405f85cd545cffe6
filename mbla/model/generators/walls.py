"""Generators of a straight wall (x along it, y through it, z up) and of walls along a plan, bonded where they meet."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.items.masonry import Gable, Masonry, Opening
from mbla.deck.items.walls import WallItem, WallsItem
from mbla.errors import Finding
from mbla.model.generators.generator import Generated, ItemRefused, Part, Site
from mbla.model.generators.masonry.additions import (
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
from mbla.model.generators.masonry.bonds import random_levels
from mbla.model.generators.masonry.courses import units_of
from mbla.model.generators.masonry.leg import Leg, Passage, Slopes
from mbla.model.generators.masonry.plan import Line, check_plan, lines_of, passages_of
from mbla.model.generators.masonry.unspanned import unspanned


def generate_wall(item: WallItem, site: Site) -> Generated:
    """Units course by course from the bottom, along +x in each, leaf by leaf; then lintels, arches, buttresses.

    Raises
    ------
    ItemRefused
        for openings off the bed joints, lintels and arches without support, buttresses across openings, or where
        nothing is left of the wall
    """
    thickness = item.leaves * item.unit[1]
    line = Line(np.zeros(2), np.array([1.0, 0.0]), item.length, 0.0, 0.0, 0.0, thickness, ())
    return _generate(item, [line], {} if item.gable is None else {0: item.gable}, site)


def generate_walls(item: WallsItem, site: Site) -> Generated:
    """Units wall by wall, in each course by course from the bottom, leaf by leaf; then lintels, arches, buttresses.

    Raises
    ------
    ItemRefused
        for walls that meet in part or lie on each other, openings off the bed joints or in corners, lintels and arches
        without support, buttresses across openings, gables that meet
    """
    return _generate(item, lines_of(item), {gable.segment: gable for gable in item.gables}, site)


@dataclass(frozen=True)
class _Wall:
    """A wall along a line with what belongs to it, and the walls that it shares squares with, by number."""

    line: Line
    openings: list[PlacedOpening]
    buttresses: list[PlacedButtress]
    meets: tuple[tuple[int, Passage], ...]


def _generate(item: WallItem | WallsItem, lines: Sequence[Line], gables: Mapping[int, Gable], site: Site) -> Generated:
    """Blocks of walls along lines, with gables by the number of their wall."""
    plan = isinstance(item, WallsItem)
    if findings := list(check_plan(lines)):
        raise ItemRefused(*findings)
    sound: list[tuple[int, int, Opening]] = []
    for number, opening in enumerate(item.openings):
        found = [each.below("openings", number) for each in check_opening(item, opening, site.tolerance)]
        findings += found
        sound += [] if found else [(number, getattr(opening, "segment", 0), opening)]
    against = [(n, getattr(each, "segment", 0), each) for n, each in enumerate(item.buttresses)]
    meets = passages_of(lines, item.courses)
    walls = [
        _Wall(
            line,
            [place_opening(item, n, opening, line.before) for n, segment, opening in sound if segment == number],
            [place_buttress(item, n, buttress, line.before) for n, segment, buttress in against if segment == number],
            meets[number],
        )
        for number, line in enumerate(lines)
    ]
    for wall in walls:
        findings += check_wall(item, wall.openings, wall.buttresses, wall.meets, wall.line.whole_length)
    if isinstance(item, WallsItem):
        findings += _check_gables(item, meets)
    if findings:
        raise ItemRefused(*findings)
    levels = random_levels(item, _fixed_levels(walls))
    legs = [_leg(item, number, wall, levels, gables.get(number), plan) for number, wall in enumerate(walls)]
    name = item.group or ("walls" if plan else "wall")
    notices = [each for leg, wall in zip(legs, walls, strict=True) for each in unspanned(leg, wall.openings, name)]
    return Generated(tuple(_parts(walls, legs, numbered=plan)), notices=tuple(notices))


def _fixed_levels(walls: Sequence[_Wall]) -> list[int]:
    """Bed joints that random heights of courses leave where they are."""
    voids = [void for wall in walls for opening in wall.openings for void in opening.voids]
    found = [level for void in voids for level in (void.bottom, void.top)]
    return found + [buttress.courses for wall in walls for buttress in wall.buttresses]


def _leg(item: Masonry, number: int, wall: _Wall, levels: FloatArray, gable: Gable | None, plan: bool) -> Leg:
    """How a wall is laid; where it meets others, or is of a plan, remainders are joined to the next unit."""
    line = wall.line
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
        fitted=plan or bool(passages),
        number=number,
    )
    if gable is None:
        return leg
    apex = leg.length / 2 if gable.apex is None else gable.apex + line.before
    slopes = Slopes(0.0, leg.length, apex, float(levels[-1]), gable.rise)
    return replace(leg, slopes=slopes, levels=levels_with_top(levels, gable.rise, item.unit[2]))


def _check_gables(item: WallsItem, meets: Sequence[tuple[tuple[int, Passage], ...]]) -> Iterator[Finding]:
    """Of two walls that meet one has a gable at most."""
    numbers = [gable.segment for gable in item.gables]
    for n, gable in enumerate(item.gables):
        if any(other in numbers[:n] for other, _ in meets[gable.segment]):
            yield Finding("wall-shape", "meets a wall that has a gable too", "gables", n, "segment")


def _parts(walls: Sequence[_Wall], legs: Sequence[Leg], numbered: bool) -> Iterator[Part]:
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
