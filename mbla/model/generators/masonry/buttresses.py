"""Buttresses: short walls that stand against another one, or run through it in every other course."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.items.masonry import Buttress, Masonry
from mbla.errors import Finding
from mbla.model.generators.masonry.leg import NO_UNIT, Leg, Passage, Slopes
from mbla.model.generators.masonry.openings import PlacedOpening

LEAST_TOP_COURSE = 0.25
"""height of the last course under an apex, in courses, below which it is part of the one beneath it"""


def levels_with_top(levels: FloatArray, rise: float, height: float) -> FloatArray:
    """Bed joints (n,) of the level courses, then those up to the apex: whole courses and a rest [length]."""
    above = max(int(np.ceil(rise / height - LEAST_TOP_COURSE)), 1)
    tops = float(levels[-1]) + height * np.arange(1, above + 1)
    tops[-1] = float(levels[-1]) + rise
    return np.concatenate([levels, tops])


@dataclass(frozen=True)
class PlacedButtress:
    """A buttress on the grid of its wall; ``number`` is that in the deck.

    start, end : along the wall [length]
    courses    : of its level part
    """

    number: int
    buttress: Buttress
    start: float
    end: float
    courses: int

    @property
    def passage(self) -> Passage:
        """Where it runs through its wall."""
        return Passage(self.start, self.end, self.courses)


def slope_courses(item: Masonry, buttress: Buttress) -> float:
    """Height of the sloped top in courses of the wall."""
    return buttress.slope / item.unit[2]


def place_buttress(item: Masonry, number: int, buttress: Buttress, shift: float = 0.0) -> PlacedButtress:
    """A buttress with its courses; ``shift`` is from the start of its line to that of its wall."""
    courses = buttress.courses
    if courses is None:
        courses = item.courses - round(slope_courses(item, buttress))
    start = buttress.at + shift
    return PlacedButtress(number, buttress, start, start + buttress.width, courses)


def check_buttresses(
    placed: Sequence[PlacedButtress], openings: Sequence[PlacedOpening], item: Masonry
) -> Iterator[Finding]:
    """Buttresses that run through the wall do so in solid courses, apart from each other; key paths below the item."""
    room = NO_UNIT * item.unit[0]
    for each in placed:
        if not each.buttress.bonded:
            continue
        for opening in openings:
            if any(
                void.left < each.end + room and void.right > each.start - room and void.bottom < each.courses
                for void in opening.voids
            ):
                message = f"meets openings[{opening.number}]: move it, or write bonded: false"
                yield Finding("wall-shape", message, "buttresses", each.number)
        for other in placed[: placed.index(each)]:
            if other.buttress.bonded and other.start < each.end - room and other.end > each.start + room:
                words = f"runs through the wall where buttresses[{other.number}] does"
                yield Finding("wall-shape", words, "buttresses", each.number)


def buttress_leg(host: Leg, placed: PlacedButtress) -> Leg:
    """A buttress as a wall of its own; its units are as long as those of its wall, along its depth."""
    buttress = placed.buttress
    inside = host.thickness if buttress.bonded else 0.0
    back = buttress.side == "back"
    # s of the buttress leads away from the face; its width then lies to the left
    corner = placed.end if back else placed.start
    face = (0.0 if buttress.bonded else host.thickness) if back else (host.thickness if buttress.bonded else 0.0)
    left = np.array([-host.along[1], host.along[0]])
    levels = host.levels[: placed.courses + 1]
    slopes = None
    if buttress.slope > 0:
        bottom = float(levels[-1])
        slopes = Slopes(inside, inside + buttress.depth, inside, bottom, buttress.slope)
        levels = levels_with_top(levels, buttress.slope, host.item.unit[2])
    unit = (host.item.unit[0], buttress.width, host.item.unit[2])
    plain = {"leaves": 1, "bond": "running", "headers": None, "irregular": None, "unit": unit}
    return replace(
        host,
        item=host.item.model_copy(update=plain),
        origin=host.in_plan(np.array(corner), np.array(face)),
        along=left if back else -left,
        length=inside + buttress.depth,
        levels=levels,
        level_courses=placed.courses,
        voids=(),
        passages=(Passage(0.0, inside, placed.courses),) if buttress.bonded else (),
        slopes=slopes,
        # it runs through its wall where the wall does not
        swapped=host.interrupted(1) == (host.item.start == "full"),
        fitted=True,
        member="buttress",
        top_member="buttress",
    )
