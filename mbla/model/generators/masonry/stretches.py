"""Solid stretches of a course between the ends of the wall, its openings and the walls that pass through it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from mbla.arrays import FloatArray


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
    """What is left free of units, in courses bottom <= course < top.

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
        """Its extent in a course, ends at the bed and at the top."""
        low, high = (self.lean * float(levels[n] - levels[self.bottom]) for n in (course, course + 1))
        return Stretch(self.left - low, self.left - high, self.right + low, self.right + high)


def solid_stretches(outside: Stretch, voids: Iterable[Stretch], least: float) -> Iterator[Stretch]:
    """What remains between the voids, left to right; voids may overlap each other. No stretch is shorter than least."""
    left, left_top = outside.left, outside.left_top
    for void in sorted(voids, key=lambda void: void.left):
        if void.left - left > least:
            yield Stretch(left, left_top, void.left, void.left_top)
        left, left_top = max(left, void.right), max(left_top, void.right_top)
    if outside.right - left > least:
        yield Stretch(left, left_top, outside.right, outside.right_top)
