"""A straight wall between its two ends, with whatever cuts into it: how its courses are laid.

Distances are along the wall from its start, s, from its right face to its left one, r, and up, z.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.blocks.masonry.bonds import shifted
from mbla.model.blocks.masonry.masonry import Masonry


@dataclass(frozen=True)
class Stretch:
    """Where a solid stretch of a course begins and ends along the wall [length], at its bed and at its top."""

    left: float
    left_top: float
    right: float
    right_top: float

    @property
    def sloped(self) -> bool:
        """Whether an end is cut at a slope."""
        return self.left != self.left_top or self.right != self.right_top


@dataclass(frozen=True)
class Void:
    """Opening that is free of units, in courses bottom <= course < top.

    left, right : along the wall at its bottom [length]
    lean        : by how much it widens at either side for each length that it rises
    """

    left: float
    right: float
    bottom: int
    top: int
    lean: float = 0.0

    def covers(self, course: int) -> bool:
        """Whether it is in that course."""
        return self.bottom <= course < self.top

    def at(self, course: int, levels: FloatArray) -> Stretch:
        """Its extent in a course, ends at the bed and at the top.

        levels : (n_courses + 1,) heights of the bed joints [length]
        """
        low, high = (self.lean * float(levels[n] - levels[self.bottom]) for n in (course, course + 1))
        return Stretch(self.left - low, self.left - high, self.right + low, self.right + high)

    def widest(self, height: float) -> Void:
        """The upright room that holds it; ``height`` of a course [length]."""
        reach = self.lean * (self.top - self.bottom) * height
        return Void(self.left - reach, self.right + reach, self.bottom, self.top)

    def meets(self, other: Void, room: float) -> bool:
        """Whether it overlaps another by more than some length, in a course at least."""
        along = other.left < self.right - room and other.right > self.left + room
        return along and other.bottom < self.top and other.top > self.bottom


def solid_stretches(outside: Stretch, voids: Iterable[Stretch], least: float) -> Iterator[Stretch]:
    """What remains between the voids, left to right; voids may overlap each other. No stretch is shorter than least."""
    left, left_top = outside.left, outside.left_top
    for void in sorted(voids, key=lambda void: void.left):
        if void.left - left > least:
            yield Stretch(left, left_top, void.left, void.left_top)
        left, left_top = max(left, void.right), max(left_top, void.right_top)
    if outside.right - left > least:
        yield Stretch(left, left_top, outside.right, outside.right_top)


NO_UNIT = 1e-6
"""length of a remainder, relative to the unit, that is no unit of its own"""


@dataclass(frozen=True)
class Passage:
    """Where another wall meets this one, from left to right: it runs through in the second courses of this one's bond.

    courses : height of the other wall
    """

    left: float
    right: float
    courses: int

    @property
    def void(self) -> Void:
        """The room that it takes."""
        return Void(self.left, self.right, 0, self.courses)


@dataclass(frozen=True)
class Slopes:
    """Outline of a wall above its level part: straight from both of its ends to an apex, or to the top under one.

    left, right : ends at the height ``bottom``; apex: along the wall, at the height bottom + rise [length]
    """

    left: float
    right: float
    apex: float
    bottom: float
    rise: float

    def ends(self, height: float) -> tuple[float, float]:
        """Left and right end at a height."""
        share = (height - self.bottom) / self.rise
        return self.left + share * (self.apex - self.left), self.right + share * (self.apex - self.right)


@dataclass(frozen=True)
class Leg:
    """A straight wall.

    item      : its units and bond
    origin    : (2,) corner of its plan, s = r = 0
    along     : (2,) unit vector of s, along x or y; r is to the left of it
    length    : with the corners that it shares [length]
    levels    : (n + 1,) heights of its bed joints, those of its slopes with them [length]
    level_courses : courses of its level part
    swapped   : whether the two courses of its bond are exchanged
    fitted    : whether remainders shorter than the overlap are joined to the next unit, and joints kept off the faces
                of other walls
    number    : of the wall in its plan
    member    : part of the structure that it is; empty for the wall itself
    top_member : what its blocks above the level part are
    """

    item: Masonry
    origin: FloatArray
    along: FloatArray
    length: float
    levels: FloatArray
    level_courses: int
    voids: tuple[Void, ...] = ()
    passages: tuple[Passage, ...] = ()
    slopes: Slopes | None = None
    swapped: bool = False
    fitted: bool = False
    number: int = 0
    member: str = ""
    top_member: str = "gable"

    @property
    def thickness(self) -> float:
        """Of all leaves together."""
        return self.item.leaves * self.item.unit[1]

    @property
    def n_courses(self) -> int:
        """Level ones and those cut to slopes."""
        return len(self.levels) - 1

    @property
    def begins_at_a_corner(self) -> bool:
        """Whether another wall passes at its start."""
        return any(passage.left <= NO_UNIT * self.item.unit[0] for passage in self.passages)

    def second(self, course: int) -> bool:
        """Whether a course is the second of the two of the bond, in which other walls run through."""
        return shifted(self.item, course, self.swapped)

    def outside(self, course: int) -> Stretch:
        """Ends of a course, openings or not."""
        if self.slopes is None or course < self.level_courses:
            return Stretch(0.0, 0.0, self.length, self.length)
        low, high = (self.slopes.ends(float(self.levels[n])) for n in (course, course + 1))
        return Stretch(low[0], high[0], low[1], high[1])

    def interruptions(self, course: int) -> tuple[Stretch, ...]:
        """Where other walls run through a course."""
        if not self.interrupted(course):
            return ()
        return tuple(Stretch(p.left, p.left, p.right, p.right) for p in self.passages if course < p.courses)

    def interrupted(self, course: int) -> bool:
        """Whether other walls run through a course, if any are there."""
        if self.item.bond == "stack":
            return (course % 2 == 1) != self.swapped
        return self.second(course)

    def faces(self, course: int) -> tuple[Passage, ...]:
        """Walls whose faces the joints of a course keep off, since they run through the course below or above."""
        return () if self.interrupted(course) else tuple(p for p in self.passages if course <= p.courses)

    def in_plan(self, s: FloatArray, r: FloatArray) -> FloatArray:
        """Places in the wall's plan as x and y, (..., 2)."""
        left = np.array([-self.along[1], self.along[0]])
        return np.asarray(self.origin + s[..., None] * self.along + r[..., None] * left)
