"""The units of the courses of one wall, and blocks made of them: cuboids, and prisms where a slope cuts."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.deck.kinds.positions import NONE
from mbla.model.blocks.generated import ItemPart
from mbla.model.blocks.masonry.bonds import (
    ROUNDING,
    Pattern,
    bonded,
    headers_by_number,
    least_overlap,
    pattern,
    random_joints,
    stream,
)
from mbla.model.blocks.masonry.leg import NO_UNIT, Leg, Passage, Stretch, solid_stretches
from mbla.model.solids.plane import cut as cut_off
from mbla.model.solids.polyhedra import Polyhedra, cuboids, join_polyhedra, prisms, take_polyhedra

SAME_PLACE = 1e-9
"""corners of an outline this close, relative to its extent, are one corner"""


def outline_between(stretch: Stretch, left: float, right: float, low: float, high: float) -> FloatArray:
    """Corners (n, 2) of a unit along the wall and up, counter-clockwise with the wall to the right.

    left, right : joints of the unit; low, high: bed and top of its course
    """
    corners = np.array([[left, low], [right, low], [right, high], [left, high]])
    corners = _left_of(corners, np.array([stretch.left_top, high]), np.array([stretch.left, low]))
    return _left_of(corners, np.array([stretch.right, low]), np.array([stretch.right_top, high]))


def _left_of(corners: FloatArray, start: FloatArray, end: FloatArray) -> FloatArray:
    """The part of a convex outline (n, 2) to the left of the line from start to end, each corner once."""
    direction, extent = end - start, np.ptp(corners, axis=0).max()
    side = direction[0] * (corners[:, 1] - start[1]) - direction[1] * (corners[:, 0] - start[0])
    side[np.abs(side) <= SAME_PLACE * extent * np.abs(direction).max()] = 0.0
    if not np.isfinite(side).all():  # blocks as large as that are refused by their coordinates
        return corners
    found = cut_off(corners[None], side[None])[0]
    return np.asarray(found[np.abs(found - np.roll(found, 1, axis=0)).max(axis=1) > SAME_PLACE * extent])


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


def lay_courses(leg: Leg) -> Iterator[CourseUnits]:
    """The courses of a wall from the bottom."""
    irregular = leg.item.irregular
    numbers = None if irregular is None else stream(irregular, leg.number + 1)
    below, least = np.empty(0), NO_UNIT * leg.item.unit[0]
    for course in range(leg.n_courses):
        voids = [void.at(course, leg.levels) for void in leg.voids if void.covers(course)]
        stretches = tuple(solid_stretches(leg.outside(course), [*voids, *leg.interruptions(course)], least))
        units = _course(leg, course, stretches, below, numbers)
        below = units.joints
        yield units


def _course(
    leg: Leg, course: int, stretches: tuple[Stretch, ...], below: FloatArray, numbers: np.random.Generator | None
) -> CourseUnits:
    """Units of one course; of random length with random numbers, off the joints (n,) of the course below."""
    found = pattern(leg.item, course, leg.length, leg.second(course), leg.fitted and leg.begins_at_a_corner)
    ends, outlines, joints = [np.empty((0, 2))], {}, [np.empty(0)]
    count = 0
    for stretch in stretches:
        inner = _regular(leg, course, found) if numbers is None else _random(leg, course, stretch, below, numbers)
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
    if numbers is not None:
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


def _random(leg: Leg, course: int, stretch: Stretch, below: FloatArray, numbers: np.random.Generator) -> FloatArray:
    """Joints (n,) of a stretch of random units, off those below and the faces of walls that run through there."""
    faces = [face for passage in leg.faces(course) for face in (passage.left, passage.right)]
    inside = [face for face in faces if NO_UNIT < face / leg.item.unit[0] < leg.length / leg.item.unit[0] - NO_UNIT]
    avoid = np.sort(np.concatenate([below, inside]))
    return random_joints(leg.item, stretch.left, stretch.right, avoid, numbers)


def _within(leg: Leg, stretch: Stretch, joints: FloatArray) -> FloatArray:
    """Joints that leave full units at both ends of a stretch, apart from closers cut to fit."""
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


def units_of(leg: Leg) -> ItemPart:
    """All units of a wall: course by course from the bottom, along it, leaf by leaf."""
    boxes, rows, through, outlines, start = [], [], [], {}, 0
    for course, units in enumerate(lay_courses(leg)):
        count = len(units.ends)
        heights = np.tile(leg.levels[course : course + 2], (count, 1))
        boxes.append(np.hstack([units.ends, heights]))
        rows.append(np.stack([np.full(count, course), np.arange(count)], axis=1))
        through.append(units.through)
        outlines.update({start + number: outline for number, outline in units.outlines.items()})
        start += count
    return _in_leaves(leg, np.concatenate(boxes), np.concatenate(rows), np.concatenate(through), outlines)


def _in_leaves(
    leg: Leg, boxes: FloatArray, rows: IntArray, through: BoolArray, outlines: dict[int, FloatArray]
) -> ItemPart:
    """Units split into leaves where they do not go through; boxes (n, 4) are ends along the wall and heights."""
    leaves, thickness = leg.item.leaves, leg.item.unit[1]
    counts = np.where(through, 1, leaves)
    unit = np.repeat(np.arange(len(boxes)), counts)
    leaf = np.arange(len(unit)) - np.repeat(np.cumsum(counts) - counts, counts)
    header = through[unit] & (leaves > 1)
    across = np.stack([leaf, np.where(header, leaves, leaf + 1)], axis=1) * thickness
    cut = [(int(block), outlines[int(unit[block])]) for block in np.flatnonzero(np.isin(unit, list(outlines)))]
    labels = {"course": rows[unit, 0], "unit": rows[unit, 1], "leaf": np.where(header, NONE, leaf)}
    member = np.where(header & (not leg.member), "header", leg.member)
    member = np.where(rows[unit, 0] >= leg.level_courses, leg.top_member, member)
    return ItemPart(blocks_in(leg, boxes[unit], across, cut), member=member.tolist(), labels=labels)


def blocks_in(leg: Leg, boxes: FloatArray, across: FloatArray, cut: Sequence[tuple[int, FloatArray]] = ()) -> Polyhedra:
    """Blocks at places of a wall, in the plan's coordinates.

    boxes  : (n, 4) start and end along the wall, bottom and top
    across : (n, 2) from the right face
    cut    : numbers of blocks with the outline, (k, 2) along the wall and up, that they have instead of a rectangle
    """
    corners = np.stack([leg.in_plan(boxes[:, end], across[:, end]) for end in (0, 1)])
    least = np.column_stack([corners.min(axis=0), boxes[:, 2]])
    greatest = np.column_stack([corners.max(axis=0), boxes[:, 3]])
    if not cut:
        return cuboids(least, greatest)
    numbers = np.array([number for number, _ in cut])
    uncut = np.setdiff1d(np.arange(len(boxes)), numbers)
    made = join_polyhedra(
        [cuboids(least[uncut], greatest[uncut]), prisms_in(leg, [o for _, o in cut], across[numbers])]
    )
    return take_polyhedra(made, np.argsort(np.concatenate([uncut, numbers]), kind="stable"))


def prisms_in(leg: Leg, outlines: Sequence[FloatArray], across: FloatArray) -> Polyhedra:
    """Prisms through a wall; outlines (k, 2) counter-clockwise along it and up, across (n, 2) from its right face."""
    made = prisms(outlines, across)
    s, r, z = made.vertices.T
    return replace(made, vertices=np.column_stack([leg.in_plan(s, r), z]))
