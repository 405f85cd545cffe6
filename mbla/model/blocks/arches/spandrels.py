"""Spandrels: coursed masonry over the upper outline of arches and springers, a chain of chords from left to right.

Level courses are cut by the outline from below and by upright joints. A course between two beds exists where the
outline lies below its upper bed. Joints follow a running bond about the middle of the bridge. Three rules keep slivers
away, in units of the masonry's own size: beds keep clear of crowns; a joint that would leave a short piece at the tip
of a course is left out, the piece then being part of its neighbour; and where an entire stretch of a course would be a
sliver, above a narrow pier for example, the course on top reaches down.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.model.solids.plane import signed_areas

SAME_POINT = 1e-12
"""distance of two points, relative to the length of the bridge, that is rounding"""


@dataclass(frozen=True)
class Outline:
    """Heights over x: a chain of points (n, 2) with x that grows from point to point."""

    points: FloatArray

    def heights(self, x: FloatArray) -> FloatArray:
        """At places (n,)."""
        return np.asarray(np.interp(x, self.points[:, 0], self.points[:, 1]), dtype=np.float64)

    def crossings(self, level: float, same: float) -> FloatArray:
        """Where the chain passes a level, (n,), ascending; corners within ``same`` [length] of it count as on it."""
        x, above = self.points[:, 0], self.points[:, 1] - level
        above = np.where(np.abs(above) <= same, 0.0, above)
        one, other = above[:-1], above[1:]
        through = np.flatnonzero(one * other < 0)
        share = one[through] / (one[through] - other[through])
        between = x[through] + share * (x[through + 1] - x[through])
        # a corner on the level counts where the chain leaves it upwards or downwards there
        touching = np.flatnonzero((above == 0) & ((np.append(other, 0.0) != 0) | (np.append(0.0, one) != 0)))
        return np.sort(np.concatenate([between, x[touching]]))


def build_outline(chains: list[FloatArray]) -> Outline:
    """From the extrados (n, 2) of each arch and the ends of the bridge, in order; points listed twice count once."""
    points = np.concatenate(chains)
    extent = float(np.ptp(points[:, 0]))
    distinct = np.append(True, np.diff(points[:, 0]) > SAME_POINT * extent)
    return Outline(points[distinct])


CLEAR = 0.25
"""least distance of a bed from a crown, in heights of a unit"""
LEAST_COURSE = 0.5
"""least height of a course, in heights of a unit"""
LEAST_PIECE = 0.35
"""least length of a piece, by its area over its height, in lengths of a unit"""
LEAST_STRETCH = 0.1
"""least area of a stretch of a course between two tips, in areas of a unit"""
UPRIGHT = 0.5
"""least height of a joint in a course that ends in a tip, in heights of the course"""
SNAP = 0.02
"""beds and joints this close to a corner of the outline go through it, in units: no faces that are slivers"""
SAME = 1e-9
"""rounding, in heights of a unit, or of what is built where that is less"""


@dataclass(frozen=True)
class CoursedMasonry:
    """Length and height of a unit, and the distance that is rounding [length].

    extent : of what is built of it, at least; units may be larger
    """

    length: float
    height: float
    extent: float

    @property
    def same(self) -> float:
        """Distance of two places that are one."""
        return SAME * min(self.height, self.extent)


def bed_levels(
    outline: Outline, top: float, crowns: FloatArray, shelves: FloatArray, masonry: CoursedMasonry
) -> FloatArray:
    """Beds (n,) [length] from the springings, 0, to the top, ascending.

    crowns  : heights of extrados crowns, over which a course must have a thickness
    shelves : heights of level surfaces at the springings, best met by a bed
    """
    nominal = np.linspace(0.0, top, max(1, round(top / masonry.height)) + 1)[1:-1]
    levels = [0.0]
    for bed in nominal.tolist():
        moved = _snapped(bed, shelves, CLEAR * masonry.height)
        for crown in sorted(crowns.tolist(), reverse=True):
            if abs(moved - crown) < CLEAR * masonry.height:
                moved = crown - CLEAR * masonry.height
        moved = _snapped(moved, outline.points[:, 1], SNAP * masonry.height)
        if moved - levels[-1] >= LEAST_COURSE * masonry.height:
            levels.append(moved)
    if len(levels) > 1 and top - levels[-1] < LEAST_COURSE * masonry.height:
        levels.pop()
    return np.array([*levels, top])


@dataclass(frozen=True)
class Course:
    """Of masonry: beds low and high, upright joints (n,) ascending, pits (left, right) left by the course below.

    Over a pit the course reaches down to the outline.
    """

    low: float
    high: float
    bond: FloatArray
    pits: tuple[tuple[float, float], ...] = ()

    def floor(self, outline: Outline, places: FloatArray) -> FloatArray:
        """Height of its underside at places (n,)."""
        heights = outline.heights(places)
        return np.where(self.over_pit(places), heights, np.maximum(heights, self.low))

    def over_pit(self, places: FloatArray) -> BoolArray:
        """Which places (n,) lie over a pit, its ends included: there the outline passes the bed."""
        found = np.zeros(len(places), dtype=bool)
        for left, right in self.pits:
            found |= (places >= left) & (places <= right)
        return found


def course_pieces(
    outline: Outline, course: Course, masonry: CoursedMasonry
) -> tuple[list[FloatArray], tuple[tuple[float, float], ...]]:
    """Polygons (k, 2) of a course from left to right, counter-clockwise; and the pits that it leaves to the next."""
    same = masonry.same
    ends = outline.points[[0, -1], 0]
    marks = np.concatenate([ends[:1], outline.crossings(course.high, same), ends[1:]])
    pieces, pits = [], []
    for start, end in pairwise(marks.tolist()):
        middle = float(outline.heights(np.array([(start + end) / 2]))[0])
        if end - start <= same or middle >= course.high - same:
            continue
        entire = _piece(outline, course, start, end, same)
        if end - start < np.ptp(ends) and _area(entire) < LEAST_STRETCH * masonry.length * masonry.height:
            pits.append((start, end))
        else:
            pieces += _cut(outline, course, (start, end), masonry)
    return pieces, tuple(pits)


def coursed(
    outline: Outline, beds: FloatArray, ends: tuple[float, float], masonry: CoursedMasonry
) -> tuple[list[FloatArray], IntArray, IntArray]:
    """Polygons (k, 2) of all courses between beds (n + 1,), with course and position of each, (m,)."""
    polygons: list[FloatArray] = []
    levels, units = [], []
    pits: tuple[tuple[float, float], ...] = ()
    for course in range(len(beds) - 1):
        bond = bond_of_course(*ends, course % 2 == 1, masonry.length)
        pieces, pits = course_pieces(outline, Course(beds[course], beds[course + 1], bond, pits), masonry)
        polygons += pieces
        levels += [course] * len(pieces)
        units += list(range(len(pieces)))
    return polygons, np.array(levels, dtype=np.int64), np.array(units, dtype=np.int64)


def bond_of_course(left: float, right: float, odd: bool, length: float) -> FloatArray:
    """Joints (n,) of a running bond about the middle of the bridge, both ends excluded."""
    reach = int((right - left) / (2 * length)) + 2
    places = (left + right) / 2 + length * (np.arange(-reach, reach + 1) + (0.5 if odd else 0.0))
    return np.asarray(places[(places > left) & (places < right)], dtype=np.float64)


def _snapped(bed: float, marks: FloatArray, within: float) -> float:
    """The nearest of some heights, where it is near enough."""
    if not len(marks):
        return bed
    nearest = float(marks[np.argmin(np.abs(marks - bed))])
    return nearest if abs(nearest - bed) < within else bed


def _cut(outline: Outline, course: Course, ends: tuple[float, float], masonry: CoursedMasonry) -> list[FloatArray]:
    """A stretch of a course, cut by those joints of the bond that leave no slivers."""
    same = masonry.same
    corners = outline.points[outline.points[:, 1] > course.low + same, 0]
    places = np.array([_snapped(place, corners, SNAP * masonry.length) for place in course.bond.tolist()])
    places = places[(places > ends[0] + same) & (places < ends[1] - same)]
    places = places[~course.over_pit(places)]
    tips = course.high - outline.heights(np.array(ends)) <= same
    if tips.any():
        places = places[course.high - course.floor(outline, places) >= UPRIGHT * (course.high - course.low)]
    joints = [ends[0], *places.tolist(), ends[1]]
    while len(joints) > 2 and _short(_piece(outline, course, joints[0], joints[1], same), masonry):
        del joints[1]
    while len(joints) > 2 and _short(_piece(outline, course, joints[-2], joints[-1], same), masonry):
        del joints[-2]
    return [_piece(outline, course, a, b, same) for a, b in pairwise(joints)]


def _short(polygon: FloatArray, masonry: CoursedMasonry) -> bool:
    return _area(polygon) < LEAST_PIECE * masonry.length * float(np.ptp(polygon[:, 1]))


def _area(polygon: FloatArray) -> float:
    return float(signed_areas(polygon[None])[0])


def _piece(outline: Outline, course: Course, left: float, right: float, same: float) -> FloatArray:
    """Between two upright joints, the outline or the lower bed, and the upper bed; counter-clockwise."""
    low, high = course.low, course.high
    x, z = outline.points.T
    corners = x[(x > left + same) & (x < right - same) & ((z > low + same) | course.over_pit(x))]
    crossings = outline.crossings(low, same)
    crossings = crossings[(crossings > left + same) & (crossings < right - same)]
    lower = np.concatenate([[left], np.union1d(corners, crossings), [right]])
    heights = course.floor(outline, lower)
    heights = np.where(np.abs(heights - low) <= same, low, heights)
    chain = np.stack([lower, heights], axis=1)
    upper = [[end, high] for end, height in ((right, heights[-1]), (left, heights[0])) if high - height > same]
    return np.array([*chain.tolist(), *upper])
