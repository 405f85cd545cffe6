"""Generators of a straight wall (x along it, y through it, z up) and of walls along a plan, bonded where they meet."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.items.masonry import Buttress, Gable, Masonry
from mbla.deck.items.walls import WallItem, WallsItem
from mbla.deck.tree import KeyPath
from mbla.errors import Finding
from mbla.model.generators.amounts import Amount
from mbla.model.generators.generator import Generated, ItemRefused, Part, Site
from mbla.model.generators.masonry.bonds import random_levels
from mbla.model.generators.masonry.buttresses import (
    PlacedButtress,
    buttress_leg,
    check_buttresses,
    levels_with_top,
    place_buttress,
)
from mbla.model.generators.masonry.courses import units_of
from mbla.model.generators.masonry.leg import NO_UNIT, Leg, Passage, Slopes
from mbla.model.generators.masonry.openings import PlacedOpening, check_opening, check_spans, place_opening, spans_of
from mbla.model.generators.masonry.plan import Line, check_plan, lines_of, passages_of


def amount_wall(item: WallItem) -> Amount:
    """About how many units such an item has."""
    gables = [] if item.gable is None else [item.gable]
    return amount_of_units(item, item.length, ("length",), gables, item.buttresses)


def generate_wall(item: WallItem, site: Site) -> Generated:
    """Units course by course from the bottom, along +x in each, leaf by leaf; then lintels, arches, buttresses.

    Raises
    ------
    ItemRefused
        for openings off the bed joints, lintels and arches without support, buttresses across openings, or where
        nothing is left of the wall
    """
    findings: list[Finding] = []
    openings = []
    for number, opening in enumerate(item.openings):
        found = list(check_opening(item, opening, site.tolerance))
        findings += [each.below("openings", number) for each in found]
        if not found:
            openings.append(place_opening(item, number, opening))
    buttresses = [place_buttress(item, number, buttress) for number, buttress in enumerate(item.buttresses)]
    findings += check_spans(openings, item.length, item)
    findings += check_buttresses(buttresses, openings, item)
    if findings:
        raise ItemRefused(*findings)
    passages = tuple(placed.passage for placed in buttresses if placed.buttress.bonded)
    leg = Leg(
        item=item,
        origin=np.zeros(2),
        along=np.array([1.0, 0.0]),
        length=item.length,
        levels=random_levels(item, fixed_levels(openings, buttresses)),
        level_courses=item.courses,
        voids=tuple(void for opening in openings for void in opening.voids),
        passages=passages,
        fitted=bool(passages),
    )
    return Generated(tuple(parts_of([Wall(with_gable(leg, item.gable), openings, buttresses)], numbered=False)))


@dataclass(frozen=True)
class _Placed:
    """A wall of the plan with what belongs to it, and the walls that it shares squares with, by number."""

    line: Line
    openings: list[PlacedOpening]
    buttresses: list[PlacedButtress]
    meets: tuple[tuple[int, Passage], ...]


def amount_walls(item: WallsItem) -> Amount:
    """About how many units such an item has."""
    length = sum(line.whole_length for line in lines_of(item))
    return amount_of_units(item, length, ("plan",), item.gables, item.buttresses)


def generate_walls(item: WallsItem, site: Site) -> Generated:
    """Units wall by wall, in each course by course from the bottom, leaf by leaf; then lintels, arches, buttresses.

    Raises
    ------
    ItemRefused
        for walls that meet in part or lie on each other, openings off the bed joints or in corners, lintels and arches
        without support, buttresses across openings, gables that meet
    """
    lines = lines_of(item)
    _check_each(item, lines, site.tolerance)
    meets = passages_of(lines, item.courses)
    placed = [_place(item, number, line, meets[number]) for number, line in enumerate(lines)]
    _check_together(item, placed, meets)
    return Generated(tuple(parts_of(_walls(item, placed), numbered=True)))


def _check_each(item: WallsItem, lines: Sequence[Line], tolerance: float) -> None:
    """Refuse what is wrong with the plan, or with an opening by itself."""
    findings: list[Finding] = list(check_plan(lines))
    for number, opening in enumerate(item.openings):
        findings += [found.below("openings", number) for found in check_opening(item, opening, tolerance)]
    if findings:
        raise ItemRefused(*findings)


def _check_together(
    item: WallsItem, placed: Sequence[_Placed], meets: Sequence[tuple[tuple[int, Passage], ...]]
) -> None:
    """Refuse what is wrong with openings, buttresses and gables in their places along the walls."""
    findings: list[Finding] = []
    for wall in placed:
        findings += check_spans(wall.openings, wall.line.whole_length, item)
        findings += check_buttresses(wall.buttresses, wall.openings, item)
        findings += _check_meetings(item, wall)
    findings += _check_gables(item, meets)
    if findings:
        raise ItemRefused(*findings)


def _walls(item: WallsItem, placed: Sequence[_Placed]) -> list[Wall]:
    """Walls with their legs, which share their bed joints."""
    levels = random_levels(item, [level for wall in placed for level in fixed_levels(wall.openings, wall.buttresses)])
    walls = []
    for number, wall in enumerate(placed):
        leg = Leg(
            item=item,
            origin=wall.line.origin,
            along=wall.line.along,
            length=wall.line.whole_length,
            levels=levels,
            level_courses=item.courses,
            voids=tuple(void for opening in wall.openings for void in opening.voids),
            passages=_passages(wall),
            swapped=not wall.line.along_x,
            fitted=True,
            number=number,
        )
        gable = next((gable for gable in item.gables if gable.segment == number), None)
        walls.append(Wall(with_gable(leg, gable, wall.line.before), wall.openings, wall.buttresses))
    return walls


def _place(item: WallsItem, number: int, line: Line, meets: tuple[tuple[int, Passage], ...]) -> _Placed:
    openings = [
        place_opening(item, n, opening, line.before)
        for n, opening in enumerate(item.openings)
        if opening.segment == number
    ]
    buttresses = [
        place_buttress(item, n, buttress, line.before)
        for n, buttress in enumerate(item.buttresses)
        if buttress.segment == number
    ]
    return _Placed(line, openings, buttresses, meets)


def _passages(wall: _Placed) -> tuple[Passage, ...]:
    """Walls and buttresses that run through a wall in every other course, along it."""
    found = [passage for _, passage in wall.meets]
    found += [placed.passage for placed in wall.buttresses if placed.buttress.bonded]
    return tuple(sorted(found, key=lambda passage: passage.left))


def _check_meetings(item: WallsItem, wall: _Placed) -> Iterator[Finding]:
    """Openings and bonded buttresses keep off the squares that walls share; key paths below the item."""
    room = NO_UNIT * item.unit[0]
    for other, passage in wall.meets:
        for opening in wall.openings:
            for void in opening.voids:
                reach = void.lean * (void.top - void.bottom) * item.unit[2]
                if void.left - reach < passage.right - room and void.right + reach > passage.left + room:
                    yield Finding("wall-shape", f"reaches into wall {other}", "openings", opening.number)
                    break
        for placed in wall.buttresses:
            if placed.buttress.bonded and placed.start < passage.right - room and placed.end > passage.left + room:
                yield Finding("wall-shape", f"reaches into wall {other}", "buttresses", placed.number)


def _check_gables(item: WallsItem, meets: Sequence[tuple[tuple[int, Passage], ...]]) -> Iterator[Finding]:
    """Of two walls that meet one has a gable at most."""
    numbers = [gable.segment for gable in item.gables]
    for n, gable in enumerate(item.gables):
        if any(other in numbers[:n] for other, _ in meets[gable.segment]):
            yield Finding("wall-shape", "meets a wall that has a gable too", "gables", n, "segment")


@dataclass(frozen=True)
class Wall:
    """A straight wall with what belongs to it."""

    leg: Leg
    openings: Sequence[PlacedOpening]
    buttresses: Sequence[PlacedButtress]


def amount_of_units(
    item: Masonry, length: float, key: KeyPath, gables: Sequence[Gable], buttresses: Sequence[Buttress]
) -> Amount:
    """About how many units walls have.

    length : of all walls together
    """
    unit, width, height = item.unit
    courses = item.courses + max((gable.rise for gable in gables), default=0.0) / height
    along = item.leaves * max(length / min(unit, width if item.leaves > 1 else unit), 1.0)
    across = sum(max((buttress.depth + item.leaves * width) / unit, 1.0) for buttress in buttresses)
    return Amount(courses * (along + across), key)


def fixed_levels(openings: Iterable[PlacedOpening], buttresses: Iterable[PlacedButtress]) -> list[int]:
    """Bed joints that random heights of courses leave where they are."""
    found = [level for opening in openings for void in opening.voids for level in (void.bottom, void.top)]
    return found + [buttress.courses for buttress in buttresses]


def with_gable(leg: Leg, gable: Gable | None, shift: float = 0.0) -> Leg:
    """The wall with a triangle on top; ``shift`` is from the start of its line to that of the wall."""
    if gable is None:
        return leg
    apex = leg.length / 2 if gable.apex is None else gable.apex + shift
    slopes = Slopes(0.0, leg.length, apex, float(leg.levels[-1]), gable.rise)
    levels: FloatArray = levels_with_top(leg.levels, gable.rise, leg.item.unit[2])
    return replace(leg, slopes=slopes, levels=levels)


def parts_of(walls: Sequence[Wall], numbered: bool) -> Iterator[Part]:
    """Blocks of walls: the units of each, then what spans their openings, then the buttresses.

    numbered : whether blocks are labelled by the number of their wall

    Raises
    ------
    ItemRefused
        where openings leave nothing of the walls
    """
    parts = [(units_of(wall.leg), wall.leg) for wall in walls]
    if not any(len(part.polyhedra) for part, _ in parts):
        raise ItemRefused(Finding("wall-shape", "nothing is left of the wall", "openings"))
    parts += [(part, wall.leg) for wall in walls for part in spans_of(wall.leg, wall.openings)]
    parts += [(units_of(buttress_leg(wall.leg, placed)), wall.leg) for wall in walls for placed in wall.buttresses]
    for part, leg in parts:
        if len(part.polyhedra):
            segment = {"segment": np.full(len(part.polyhedra), leg.number)} if numbered else {}
            yield replace(part, labels={**part.labels, **segment})
