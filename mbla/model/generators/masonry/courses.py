"""The units of the courses of one wall."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.model.generators.masonry.irregular import random_joints, stream
from mbla.model.generators.masonry.leg import NO_UNIT, Leg, Passage
from mbla.model.generators.masonry.outline import outline_between
from mbla.model.generators.masonry.pattern import ROUNDING, Pattern, bonded, headers_by_number, least_overlap, pattern
from mbla.model.generators.masonry.stretches import Stretch, solid_stretches


@dataclass(frozen=True)
class CourseUnits:
    """Units of a course from its start to its end.

    ends     : (n, 2) along the wall
    through  : (n,) whether a unit goes through all leaves
    outlines : of units that a slope cuts, (k, 2) along the wall and up, by their number
    joints   : (m,) joints between units
    """

    ends: FloatArray
    through: BoolArray
    outlines: dict[int, FloatArray]
    joints: FloatArray


@dataclass
class _Laying:
    """What is kept from one course to the next: random numbers, joints of the course below."""

    numbers: np.random.Generator | None
    below: FloatArray = field(default_factory=lambda: np.empty(0))


def lay_courses(leg: Leg) -> Iterator[CourseUnits]:
    """The courses of a wall from the bottom; equal ones are laid once."""
    irregular = leg.item.irregular
    laying = _Laying(None if irregular is None else stream(irregular, leg.number + 1))
    laid: dict[object, CourseUnits] = {}
    least = NO_UNIT * leg.item.unit[0]
    for course in range(leg.n_courses):
        voids = [void.at(course, leg.levels) for void in leg.voids if void.covers(course)]
        stretches = tuple(solid_stretches(leg.outside(course), [*voids, *leg.interruptions(course)], least))
        if irregular is not None or any(stretch.sloped for stretch in stretches):
            units = _course(leg, course, stretches, laying)
        else:
            headers = leg.item.headers
            key = (leg.second(course), course % (2 * headers.every) if headers else 0, leg.faces(course), stretches)
            if key not in laid:
                laid[key] = _course(leg, course, stretches, laying)
            units = laid[key]
        laying.below = units.joints
        yield units


def _course(leg: Leg, course: int, stretches: tuple[Stretch, ...], laying: _Laying) -> CourseUnits:
    found = pattern(leg.item, course, leg.length, leg.second(course), leg.fitted and leg.begins_at_a_corner)
    ends, outlines, joints = [np.empty((0, 2))], {}, [np.empty(0)]
    count = 0
    for stretch in stretches:
        inner = _random(leg, course, stretch, laying) if laying.numbers is not None else _regular(leg, course, found)
        inner = _within(leg, stretch, inner)
        edges = np.concatenate([[stretch.left], inner, [stretch.right]])
        joints.append(inner)
        ends.append(np.stack([edges[:-1], edges[1:]], axis=1))
        if stretch.sloped:
            low, high = leg.levels[course], leg.levels[course + 1]
            for number in range(len(edges) - 1):
                outline = outline_between(stretch, edges[number], edges[number + 1], low, high)
                outlines[count + number] = outline
        count += len(edges) - 1
    units = np.concatenate(ends)
    middles = np.minimum(units.mean(axis=1), found.joints[-1])
    through = found.through_at(middles)
    if laying.numbers is not None:
        through = headers_by_number(leg.item, course, len(units))
    return CourseUnits(units, through, outlines, np.concatenate(joints))


def _regular(leg: Leg, course: int, found: Pattern) -> FloatArray:
    """Joints of the bond, off the faces of walls that run through the next courses."""
    joints = found.joints
    for passage in leg.faces(course) if leg.fitted else ():
        joints = _off_faces(leg, joints, passage)
    return np.unique(joints)


def _off_faces(leg: Leg, joints: FloatArray, passage: Passage) -> FloatArray:
    """Joints closer than the overlap to a face of a wall moved into it, where that wall has none of this one's."""
    overlap = least_overlap(leg.item)
    middle = (passage.left + passage.right) / 2
    near = overlap * (1 - ROUNDING)
    at_start, at_end = passage.left <= near, passage.right >= leg.length - near
    if not at_start:
        joints = np.where(np.abs(joints - passage.left) < near, min(passage.left + overlap, middle), joints)
    if not at_end:
        joints = np.where(np.abs(joints - passage.right) < near, max(passage.right - overlap, middle), joints)
    return joints


def _random(leg: Leg, course: int, stretch: Stretch, laying: _Laying) -> FloatArray:
    assert laying.numbers is not None
    faces = [face for passage in leg.faces(course) for face in (passage.left, passage.right)]
    inside = [face for face in faces if NO_UNIT < face / leg.item.unit[0] < leg.length / leg.item.unit[0] - NO_UNIT]
    avoid = np.sort(np.concatenate([laying.below, inside]))
    return random_joints(leg.item, stretch.left, stretch.right, avoid, laying.numbers)


def _within(leg: Leg, stretch: Stretch, joints: FloatArray) -> FloatArray:
    """Joints that leave whole units at both ends of a stretch, apart from closers cut to fit."""
    unit = leg.item.unit[0]
    overlap = least_overlap(leg.item) * (1 - ROUNDING)
    fitted = leg.fitted or bonded(leg.item)
    least = overlap if fitted else NO_UNIT * unit
    keep = _clear_of(joints - stretch.left, stretch.left_top - stretch.left, least, unit)
    keep &= _clear_of(stretch.right - joints, stretch.right - stretch.right_top, least, unit)
    joints = joints[keep]
    if fitted and len(joints):
        joints = joints[np.concatenate([[True], np.diff(joints) >= overlap])]
    return joints


def _clear_of(distance: FloatArray, slope: float, least: float, unit: float) -> BoolArray:
    """Whether joints at a distance from an end leave a unit there.

    slope : by how much the course is shorter at its top than at its bed; a joint under the slope cuts off a wedge,
            which is to be half a unit at its bed, and one near its upper end would leave a splinter
    """
    if slope == 0:
        return distance > least
    steep = distance > slope + 0.25 * unit
    under: BoolArray = (distance >= 0.5 * unit) & (distance < slope - 0.125 * unit)
    return steep | under
