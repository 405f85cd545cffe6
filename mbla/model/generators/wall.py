"""Generator of walls one unit thick: running and stack bond, openings, closing units cut to fit."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.tree import KeyPath
from mbla.deck.types import Opening, WallItem
from mbla.model.generators.generator import Generated, ItemRefused, Part, Site
from mbla.model.polyhedra import cuboids

NO_UNIT = 1e-6
"""length of a remainder, relative to the unit, that is no unit of its own"""
MOST_UNITS = 2_000_000
"""a slip in the units of length asks for far more"""


@dataclass(frozen=True)
class _Void:
    """An opening on the wall's own grid: from left to right [length], courses bottom <= course < top."""

    left: float
    right: float
    bottom: int
    top: int


def generate_wall(item: WallItem, site: Site) -> Generated:
    """Units course by course from the bottom, along +x in each; x along the wall, y through it, z up.

    Raises
    ------
    ItemRefused
        for openings off the bed joints, too many units, or where nothing is left of the wall
    """
    findings: list[tuple[KeyPath, str]] = []
    about = item.courses * item.length / item.unit[0]
    if about > MOST_UNITS:
        raise ItemRefused([(("length",), f"makes about {about:.0e} units; at most {MOST_UNITS:,} can be handled")])
    voids = []
    for number, opening in enumerate(item.openings):
        found = list(_check_opening(item, opening, site.tolerance))
        findings += [(("openings", number, *path), message) for path, message in found]
        if not found:
            voids.append(_void(item, opening))
    if findings:
        raise ItemRefused(findings)
    rows: dict[tuple[bool, tuple[_Void, ...]], FloatArray] = {}
    spans, courses, positions = [], [], []
    for course in range(item.courses):
        shifted = item.bond == "running" and (course % 2 == 1) != (item.start == "half")
        shifted = shifted or (item.bond == "stack" and item.start == "half")
        here = tuple(void for void in voids if void.bottom <= course < void.top)
        key = (shifted, here)
        if key not in rows:
            rows[key] = _units_of_course(item, shifted, here)
        spans.append(rows[key])
        courses.append(np.full(len(rows[key]), course))
        positions.append(np.arange(len(rows[key])))
    units, level = np.concatenate(spans), np.concatenate(courses)
    if not len(units):
        raise ItemRefused([(("openings",), "nothing is left of the wall")])
    _, thickness, height = item.unit
    flat = np.zeros(len(units))
    least = np.stack([units[:, 0], flat, level * height], axis=1)
    greatest = np.stack([units[:, 1], flat + thickness, (level + 1) * height], axis=1)
    labels = {"course": level, "unit": np.concatenate(positions), "leaf": np.zeros_like(level)}
    return Generated((Part(cuboids(least, greatest), labels=labels),))


def _units_of_course(item: WallItem, shifted: bool, voids: tuple[_Void, ...]) -> FloatArray:
    """Left and right end of each unit of a course, (n, 2): the bond cut at both ends and at the openings."""
    unit = item.unit[0]
    first = 0.5 * unit if shifted else unit
    joints = first + unit * np.arange(max(int(np.ceil((item.length - first) / unit)), 0) + 1)
    pieces = []
    for left, right in _solid_stretches(item.length, voids, NO_UNIT * unit):
        inner = joints[(joints > left + NO_UNIT * unit) & (joints < right - NO_UNIT * unit)]
        ends = np.concatenate([[left], inner, [right]])
        pieces.append(np.stack([ends[:-1], ends[1:]], axis=1))
    return np.concatenate(pieces) if pieces else np.empty((0, 2))


def _solid_stretches(length: float, voids: tuple[_Void, ...], least: float) -> Iterator[tuple[float, float]]:
    """Stretches of a course between its ends and openings, left to right; openings may overlap each other."""
    left = 0.0
    for void in sorted(voids, key=lambda void: void.left):
        if void.left - left > least:
            yield left, void.left
        left = max(left, void.right)
    if length - left > least:
        yield left, length


def _void(item: WallItem, opening: Opening) -> _Void:
    height = item.unit[2]
    return _Void(opening.from_[0], opening.to[0], round(opening.from_[1] / height), round(opening.to[1] / height))


def _check_opening(item: WallItem, opening: Opening, tolerance: float) -> Iterator[tuple[KeyPath, str]]:
    """Bottom and top of an opening lie on bed joints, or so close that they mean them; key paths below it."""
    height = item.unit[2]
    for key, value in (("from", opening.from_[1]), ("to", opening.to[1])):
        if abs(value - round(value / height) * height) > tolerance * height:
            below = int(value // height)
            yield (key, 1), f"must lie on a bed joint; the nearest are {below * height:g} and {(below + 1) * height:g}"
    if round(opening.to[1] / height) == round(opening.from_[1] / height):
        yield ("to", 1), "must be at least a course above from"
    if opening.to[0] - opening.from_[0] <= NO_UNIT * item.unit[0]:
        yield ("to", 0), "the opening is too narrow to separate two units"
