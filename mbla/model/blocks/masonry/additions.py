"""What belongs to a wall: openings with the lintels and arches that span them, and buttresses.

Buttresses are short walls that stand against another one, or run through it in every other course.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import Finding
from mbla.model.blocks.generated import ItemPart
from mbla.model.blocks.masonry.courses import blocks_in, prisms_in
from mbla.model.blocks.masonry.leg import NO_UNIT, Leg, Passage, Slopes, Void
from mbla.model.blocks.masonry.masonry import Buttress, Masonry, Opening, OpeningArch

USUAL_EMBRACE = 60.0
"""degrees between the end joints of a flat arch, by default"""


@dataclass(frozen=True)
class PlacedOpening:
    """An opening on the grid of its wall; ``number`` is that in the deck."""

    number: int
    opening: Opening
    void: Void
    span: Void | None
    """room of what spans it; none where nothing does"""

    @property
    def voids(self) -> tuple[Void, ...]:
        """What it leaves free of units."""
        return (self.void,) if self.span is None else (self.void, self.span)


def place_opening(item: Masonry, number: int, opening: Opening, shift: float = 0.0) -> PlacedOpening:
    """An opening on bed joints; ``shift`` is from the start of its line to that of its wall."""
    height = item.unit[2]
    left, right = opening.from_[0] + shift, opening.to[0] + shift
    void = Void(left, right, round(opening.from_[1] / height), round(opening.to[1] / height))
    span = None
    if opening.lintel is not None:
        bearing, top = opening.lintel.bearing, void.top + opening.lintel.courses
        span = Void(left - bearing, right + bearing, void.top, top)
    if opening.arch is not None:
        span = Void(left, right, void.top, void.top + opening.arch.courses, lean_of(opening.arch, right - left))
    return PlacedOpening(number, opening, void, span)


def lean_of(arch: OpeningArch, span: float) -> float:
    """Tangent of the angle between the end joints of an arch and the vertical."""
    if arch.rise > 0:
        # half the rise over half the span is the tangent of half the half angle
        return math.tan(2 * math.atan2(2 * arch.rise, span))
    return math.tan(math.radians(USUAL_EMBRACE if arch.embrace is None else arch.embrace) / 2)


def check_opening(item: Masonry, opening: Opening, tolerance: float) -> Iterator[Finding]:
    """Bottom and top of an opening lie on bed joints, or so close that they mean them; key paths below it."""
    height = item.unit[2]
    for key, value in (("from", opening.from_[1]), ("to", opening.to[1])):
        if abs(value - round(value / height) * height) > tolerance * height:
            below = int(value // height)
            words = f"must lie on a bed joint; the nearest are {below * height:g} and {(below + 1) * height:g}"
            yield Finding("wall-shape", words, key, 1)
    if round(opening.to[1] / height) == round(opening.from_[1] / height):
        yield Finding("out-of-bounds", "must be at least a course above from", "to", 1)
    if opening.to[0] - opening.from_[0] <= NO_UNIT * item.unit[0]:
        yield Finding("wall-shape", "the opening is too narrow to separate two units", "to", 0)


def check_wall(
    item: Masonry,
    openings: Sequence[PlacedOpening],
    buttresses: Sequence[PlacedButtress],
    meets: Sequence[tuple[int, Passage]],
    length: float,
) -> Iterator[Finding]:
    """What belongs to a wall lies in solid courses, apart from all else; key paths below the item.

    meets  : other walls that run through it, by number
    length : of the wall, both ends of which are ends of its courses
    """
    room, height = NO_UNIT * item.unit[0], item.unit[2]
    for each in openings:
        path = ("openings", each.number)
        taken = [void.widest(height) for void in each.voids]
        for number, passage in meets:
            if any(void.meets(passage.void, room) for void in taken):
                yield Finding("wall-shape", f"reaches into wall {number}", *path)
        if each.span is None:
            continue
        key = "lintel" if each.opening.lintel is not None else "arch"
        if taken[1].left < -room or taken[1].right > length + room:
            what = "a bearing" if key == "lintel" else "a skewback"
            yield Finding("wall-shape", f"{what} reaches beyond the end of the wall", *path, key)
        if each.span.top > item.courses:
            yield Finding("wall-shape", "reaches above the top course", *path, key, "courses")
        carried = replace(taken[1], bottom=each.void.top - 1)  # with the course that carries it
        for other in openings:
            if other is not each and any(carried.meets(void, room) for void in other.voids):
                message = f"meets openings[{other.number}]: it must lie in solid courses, and on one at either side"
                yield Finding("wall-shape", message, *path, key)
    bonded = [each for each in buttresses if each.buttress.bonded]
    for row, placed in enumerate(bonded):
        own, found = placed.passage.void, []
        found += [f"reaches into wall {number}" for number, passage in meets if own.meets(passage.void, room)]
        found += [
            f"meets openings[{opening.number}]: move it, or write bonded: false"
            for opening in openings
            if any(own.meets(void, -room) for void in opening.voids)
        ]
        found += [
            f"runs through the wall where buttresses[{other.number}] does"
            for other in bonded[:row]
            if own.meets(other.passage.void, room)
        ]
        yield from (Finding("wall-shape", words, "buttresses", placed.number) for words in found)


def spans_of(leg: Leg, placed: Sequence[PlacedOpening]) -> Iterator[ItemPart]:
    """Lintels and voussoirs of a wall, one part for each opening that has them."""
    for each in placed:
        if each.span is None:
            continue
        low, high = float(leg.levels[each.span.bottom]), float(leg.levels[each.span.top])
        if each.opening.lintel is not None:
            box = np.array([[each.span.left, each.span.right, low, high]])
            made = blocks_in(leg, box, np.array([[0.0, leg.thickness]]))
            labels = {"course": np.array([each.span.bottom])}
            yield ItemPart(made, member="lintel", labels=labels, material=each.opening.lintel.material)
        if each.opening.arch is not None:
            outlines = voussoir_outlines(each.opening.arch, each.span, low, high)
            n = len(outlines)
            made = prisms_in(leg, list(outlines), np.tile([0.0, leg.thickness], (n, 1)))
            labels = {"course": np.full(n, each.span.bottom), "voussoir": np.arange(n)}
            yield ItemPart(made, member="voussoir", labels=labels, material=each.opening.arch.material)


def voussoir_outlines(arch: OpeningArch, room: Void, low: float, high: float) -> FloatArray:
    """Voussoirs from left to right, (n, 4, 2) along the wall and up, counter-clockwise.

    Of a flat arch the intrados is divided into equal lengths, of a segment of a circle into equal angles; all joints
    lie on lines through one centre, at the depth (span/2)/lean below the springing.
    """
    middle, half = (room.left + room.right) / 2, (room.right - room.left) / 2
    centre = low - half / room.lean
    if arch.rise > 0:
        angles = math.atan(room.lean) * np.linspace(-1.0, 1.0, arch.voussoirs + 1)
        radius = math.hypot(half, low - centre)
        intrados = np.stack([middle + radius * np.sin(angles), centre + radius * np.cos(angles)], axis=1)
        slopes = np.tan(angles)
        intrados[[0, -1]] = [[room.left, low], [room.right, low]]
    else:
        places = np.linspace(room.left, room.right, arch.voussoirs + 1)
        intrados = np.stack([places, np.full(len(places), low)], axis=1)
        slopes = (places - middle) / (low - centre)
    extrados = np.stack([middle + (high - centre) * slopes, np.full(len(slopes), high)], axis=1)
    return np.stack([intrados[:-1], intrados[1:], extrados[1:], extrados[:-1]], axis=1)


LEAST_TOP_COURSE = 0.25
"""height of the last course under an apex, in courses, below which it is part of the one beneath it"""


def levels_with_top(levels: FloatArray, rise: float, height: float) -> FloatArray:
    """Bed joints (n,) of the level courses, then those up to the apex: full courses and a remainder [length]."""
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
