"""Blocks of a wall from what its courses are: cuboids, and prisms where a slope cuts."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.model.generators.generator import Part
from mbla.model.generators.masonry.courses import lay_courses
from mbla.model.generators.masonry.leg import Leg
from mbla.model.solids.blocks import NONE
from mbla.model.solids.polyhedra import Polyhedra, cuboids, join_polyhedra, polyhedra_from_lists, take_polyhedra


def units_of(leg: Leg) -> Part:
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
) -> Part:
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
    return Part(blocks_in(leg, boxes[unit], across, cut), member=member.tolist(), labels=labels)


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
    whole = np.setdiff1d(np.arange(len(boxes)), numbers)
    made = join_polyhedra(
        [cuboids(least[whole], greatest[whole]), prisms(leg, [outline for _, outline in cut], across[numbers])]
    )
    return take_polyhedra(made, np.argsort(np.concatenate([whole, numbers]), kind="stable"))


def prisms(leg: Leg, outlines: Sequence[FloatArray], across: FloatArray) -> Polyhedra:
    """Prisms through a wall, faces outwards; outlines counter-clockwise along the wall and up."""
    vertices, faces = [], []
    for outline, (near, far) in zip(outlines, across, strict=True):
        n = len(outline)
        sides = [leg.in_plan(outline[:, 0], np.full(n, place)) for place in (near, far)]
        vertices.append(np.column_stack([np.concatenate(sides), np.tile(outline[:, 1], 2)]))
        ring = list(range(n))
        after = [*ring[1:], 0]
        # from the right face an outline is counter-clockwise
        around = [[j, i, i + n, j + n] for i, j in zip(ring, after, strict=True)]
        faces.append([ring, [i + n for i in reversed(ring)], *around])
    return polyhedra_from_lists(vertices, faces)
