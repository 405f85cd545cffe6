"""Bonds, regular and random: where the joints of an endless course lie, and which of its units go through the wall.

With w the thickness of a unit and n leaves, units of english, flemish and header bond are l = n w long: a header, laid
across, is w wide and goes through the wall. Joints of successive courses keep w/2 apart in these bonds, l/2 in
running bond. A wall that ends square begins its header courses with a header and a closer of w/2 (l/2 - w/2 in
flemish bond); at a corner, where the other wall passes, the stretchers begin with a three-quarter unit instead.

Random lengths of units and heights of courses are the same on every machine: the numbers are those of numpy's PCG64
generator, whose stream numpy keeps fixed: uniform doubles made of integers, no transcendental function.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.model.blocks.masonry.masonry import Irregular, Masonry

ROUNDING = 1e-6
"""relative: places along a wall that differ by no more are one place"""


@dataclass(frozen=True)
class Pattern:
    """One course of a bond, from the start of the wall to beyond its end.

    joints  : (n,) distance along the wall, ascending, all above 0
    through : (n,) whether the unit that ends at each joint goes through all leaves
    """

    joints: FloatArray
    through: BoolArray

    def through_at(self, places: FloatArray) -> BoolArray:
        """Whether the units at places (n,) [length] go through all leaves, (n,)."""
        return np.asarray(self.through[np.searchsorted(self.joints, places)])


def shifted(item: Masonry, course: int, swapped: bool) -> bool:
    """Whether a course is the second of the two that a bond repeats; ``swapped`` where a plan exchanges them."""
    if item.bond == "stack":
        return item.start == "half"
    return ((course % 2 == 1) != (item.start == "half")) != swapped


def least_overlap(item: Masonry) -> float:
    """Distance that joints of successive courses keep, and length of the least unit at a junction [length]."""
    if item.irregular is not None:
        return item.irregular.overlap * item.unit[0]
    return 0.5 * item.unit[1] if bonded(item) else 0.25 * item.unit[0]


def bonded(item: Masonry) -> bool:
    """Whether the bond itself has headers."""
    return item.bond in ("english", "flemish", "header")


def pattern(item: Masonry, course: int, length: float, second: bool, corner: bool) -> Pattern:
    """A course of any bond but random ones.

    second : whether it is the second of the two courses of the bond
    corner : whether the wall begins at a corner of a plan
    """
    if item.bond in ("running", "stretcher", "stack"):
        return _running(item, course, length, second)
    if item.bond == "flemish":
        return _flemish(item, length, second, corner)
    unit, width, _ = item.unit
    if item.bond == "english" and not second:
        return _of_one_kind(_regular(1.5 * width if corner else unit, unit, length), False)
    if corner:  # headers that begin at the face of the wall that they abut, an integer number of them from the corner
        return _of_one_kind(_regular(width if second else 0.5 * width, width, length), True)
    if item.bond == "header":
        return _of_one_kind(_regular(0.5 * width if second else width, width, length), True)
    joints = np.concatenate([[width], _regular(1.5 * width, width, length)])
    return _closed(_of_one_kind(joints, True), item, length, _regular(unit, unit, length))


def _running(item: Masonry, course: int, length: float, second: bool) -> Pattern:
    unit = item.unit[0]
    joints = _regular(0.5 * unit if second else unit, unit, length)
    return Pattern(joints, headers_by_number(item, course, len(joints)))


def headers_by_number(item: Masonry, course: int, count: int) -> BoolArray:
    """Whether units of a running or stack bond go through all leaves, (count,) from the start of their course."""
    headers = item.headers
    if headers is None or course % headers.every != headers.every - 1:
        return np.full(count, item.leaves == 1)
    stagger = (course // headers.every) % 2 * (headers.spacing // 2)
    return np.asarray((np.arange(count) + stagger) % headers.spacing == 0)


def _flemish(item: Masonry, length: float, second: bool, corner: bool) -> Pattern:
    """Headers from h to h + w and on every l + w, those of a course centred on the stretchers of the other."""
    unit, width, _ = item.unit
    if corner:
        return _headers_from(0.0 if second else 0.5 * (unit + width), unit, width, length)
    first = _headers_from(unit, unit, width, length)
    if not second:
        return first
    found = _headers_from(0.5 * (unit - width), unit, width, length)
    # the end of a stretcher before the first header becomes a header, and that header the closer
    joints, through = found.joints.copy(), found.through.copy()
    joints[0], through[0] = width, True
    return _closed(Pattern(joints, through), item, length, first.joints)


def _headers_from(start: float, unit: float, width: float, length: float) -> Pattern:
    before = _regular(start, unit + width, length)
    joints = np.stack([before, before + width], axis=1).ravel()
    through = np.tile([False, True], len(before))
    return Pattern(joints[joints > 0], through[joints > 0])


def _regular(first: float, unit: float, length: float) -> FloatArray:
    """Joints from the first on, the last of them beyond the end."""
    count = int(max(np.ceil((length - first) / unit), 0.0)) + 1
    return first + unit * np.arange(count, dtype=np.float64)


def _of_one_kind(joints: FloatArray, through: bool) -> Pattern:
    return Pattern(joints, np.full(len(joints), through))


def _closed(found: Pattern, item: Masonry, length: float, others: FloatArray) -> Pattern:
    """The same with the closer at the far end before its last header, unless this meets joints of the other course."""
    width, overlap = item.unit[1], least_overlap(item) * (1 - ROUNDING)
    last = int(np.searchsorted(found.joints, length * (1 - ROUNDING))) - 1
    if last < 1 or not found.through[last] or length - found.joints[last] > width * (1 - ROUNDING):
        return found
    moved = length - width
    inside = others[others < length * (1 - ROUNDING)]
    if moved - found.joints[last - 1] < overlap or np.abs(inside - moved).min(initial=np.inf) < overlap:
        return found
    joints, through = found.joints.copy(), found.through.copy()
    joints[last], through[last + 1] = moved, True
    return Pattern(joints, through)


HEIGHTS = 0
"""stream of the heights of courses; the walls of an item have streams 1, 2, ..."""


def stream(irregular: Irregular, number: int) -> np.random.Generator:
    """Random numbers of one wall of an item."""
    return np.random.Generator(np.random.PCG64([irregular.seed, number]))


def random_levels(item: Masonry, fixed: Sequence[int]) -> FloatArray:
    """Heights of bed joints, (n_courses + 1,) [length]; those numbered ``fixed`` stay where equal courses have them."""
    levels = item.unit[2] * np.arange(item.courses + 1, dtype=np.float64)
    if item.irregular is None or item.irregular.heights == 0:
        return levels
    uniform = stream(item.irregular, HEIGHTS).random(item.courses)
    heights = 1 + item.irregular.heights * (2 * uniform - 1)
    kept = sorted({0, item.courses, *fixed})
    for low, high in pairwise(kept):
        share = np.cumsum(heights[low : high - 1]) / heights[low:high].sum()
        levels[low + 1 : high] = levels[low] + share * (levels[high] - levels[low])
    return levels


def random_joints(
    item: Masonry, left: float, right: float, avoid: FloatArray, numbers: np.random.Generator
) -> FloatArray:
    """Joints (n,) between two ends, each a random length after the one before, off the joints of other courses.

    avoid : places that joints keep the overlap from, ascending

    A joint too close to one of them goes to the nearest place where it is not. None is nearer than the overlap to the
    ends; where no place is left the last unit is longer.
    """
    assert item.irregular is not None
    unit, variation = item.unit[0], item.irregular.variation
    overlap = item.irregular.overlap * unit
    least = max(0.5 * (1 - variation) * unit, overlap)
    joints: list[float] = []
    at = left
    while True:
        wanted = at + unit * (1 + variation * (2 * float(numbers.random()) - 1))
        found = _nearest_free(wanted, at + least, right - overlap, avoid, overlap)
        if found is None or wanted > right - overlap:
            return np.array(joints)
        joints.append(found)
        at = found


def _nearest_free(wanted: float, low: float, high: float, avoid: FloatArray, overlap: float) -> float | None:
    """The place between low and high nearest to one that is wanted and at least the overlap from those to avoid."""
    candidates = np.concatenate([[wanted, low], avoid - overlap, avoid + overlap])
    candidates = candidates[(candidates >= low) & (candidates <= high)]
    if len(avoid):
        off = np.abs(candidates[:, None] - avoid).min(axis=1, initial=np.inf)
        candidates = candidates[off >= overlap * (1 - 1e-9)]
    if not len(candidates):
        return None
    return float(candidates[np.argmin(np.abs(candidates - wanted))])
