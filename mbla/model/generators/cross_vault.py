"""Generator of cross (groin) vaults; see ``mbla.model.generators.mitres`` for what happens at the groins.

The webs towards +x and -x are pieces of the barrel along x, whose courses run from the groin out to the edge. A course
with the area A of its profile, the centroid of which lies at a distance c from the middle, fills A (length to the edge
- c) in each of the two webs on its side of the ridge: sums of these are the volume.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.items.vaults import CrossVaultItem
from mbla.errors import Finding
from mbla.model.generators.amounts import Amount
from mbla.model.generators.generator import Generated, ItemRefused, Part, Site, level_ground
from mbla.model.generators.mitres import (
    CORNERS,
    SHORTEST,
    HalfSection,
    along_x,
    along_y,
    first_course,
    half_section,
    keystone,
    mitred,
    reflected,
)
from mbla.model.solids.polyhedra import Polyhedra, join_polyhedra

LEAST_EDGE = 1e-3
"""of the thickness: the webs end at least so far beyond the feet of the groins"""


@dataclass
class _Webs:
    """Units of the webs as they are made."""

    units: list[Polyhedra] = field(default_factory=list)
    labels: list[tuple[int, int, int]] = field(default_factory=list)

    def add(self, stations: FloatArray, corner: tuple[int, int], course: int, span: int) -> None:
        """Units (n, n_polygons, 4, 3) of one course of one web, from the groin outwards."""
        self.units.append(reflected(stations, corner))
        self.labels += [(course, span, unit) for unit in range(len(stations))]

    def part(self) -> list[Part]:
        """All of them, if there are any: all units of a small vault may belong to the groins."""
        if not self.units:
            return []
        course, span, unit = np.array(self.labels, dtype=np.int64).T
        return [Part(join_polyhedra(self.units), member="web", labels={"course": course, "span": span, "unit": unit})]


def amount_cross_vault(item: CrossVaultItem) -> Amount:
    """About how many units such an item has."""
    return Amount(item.courses * 2 * (sum(item.bay) / 2 + 2 * _edge(item)) / item.unit, "unit")


def _edge(item: CrossVaultItem) -> float:
    """How far the webs run on beyond the corners of the bay."""
    stretch = item.bay[1] / item.bay[0]
    return 2 * item.thickness * max(1.0, stretch) if item.edge is None else item.edge


def generate_cross_vault(item: CrossVaultItem, site: Site) -> Generated:
    """Groins from the springings up, four blocks in each course; units of the webs; keystone; fixed springers.

    Raises
    ------
    ItemRefused
        where the webs end before the feet of the groins
    """
    section = half_section(item, item.bay)
    ends = _ends(item, section)
    groins, webs = [], _Webs()
    for course in range(section.courses):
        arms = _joints(item, ends, section.profile(course), section.stretch, course)
        groins += [reflected(_groin(section, course, arms), corner) for corner in CORNERS]
        for number, corner in enumerate(CORNERS):
            _add_units(webs, section, course, arms, number, corner)
    count = np.repeat(np.arange(section.courses), 4)
    segment = np.tile(np.arange(4), section.courses)
    parts = [Part(join_polyhedra(groins), member="groin", labels={"course": count, "segment": segment})]
    if section.keystone:
        _add_ridges(webs, section, item, ends)
    parts += webs.part()
    if section.keystone:
        parts.append(Part(keystone(section), member="keystone", labels={"course": np.array([section.courses])}))
    if item.springers == "blocks":
        behind = _groin(section, -1, (ends[:1], ends[1:]))
        feet = join_polyhedra([reflected(behind, corner) for corner in CORNERS])
        parts.append(Part(feet, "_springers", fixed=True, labels={"segment": np.arange(4)}))
    grounds = (level_ground(first_course(parts), item.joint),) if item.springers == "ground" else ()
    return Generated(tuple(parts), grounds)


def _ends(item: CrossVaultItem, section: HalfSection) -> FloatArray:
    """Where the webs end along x and y from the middle, (2,)."""
    sides = np.array([1.0, section.stretch])
    feet = sides * section.distance[0].max() - np.array(item.bay) / 2
    edge = _edge(item)
    if edge < feet.max() + LEAST_EDGE * item.thickness:
        message = f"must be > {feet.max():g}: the webs end beyond the feet of the groins"
        raise ItemRefused(Finding("out-of-bounds", message, "edge"))
    return np.array(item.bay) / 2 + edge


def _joints(
    item: CrossVaultItem, ends: FloatArray, profile: FloatArray, stretch: float, course: int
) -> tuple[FloatArray, FloatArray]:
    """Upright joints of a course along x and along y, from the groin out to the edge, which is the last of them."""
    shifted = item.bond == "running" and course % 2 == 1
    found = []
    for end, stretched in zip(ends, (1.0, stretch), strict=True):
        least = stretched * profile[:, 0].max() + SHORTEST * item.unit
        # a profile beyond what a double holds is no number; its blocks are refused
        steps = np.arange(int(max(np.fmin(end - least, end), 0.0) / item.unit) + 1)[::-1] + (0.5 if shifted else 1.0)
        joints = end - item.unit * steps
        found.append(np.append(joints[joints > least], end))
    return found[0], found[1]


def _groin(section: HalfSection, course: int, arms: tuple[FloatArray, FloatArray]) -> FloatArray:
    """The block in the corner +x+y, (1, 3, 4, 3): its end along x, the mitre, its end along y."""
    profile = section.profile(course)
    ends = along_x(profile, section.stretch, arms[0][0]), along_y(profile, arms[1][0])
    return np.stack([ends[0], mitred(profile, section.stretch), ends[1]])[None]


def _add_units(
    webs: _Webs,
    section: HalfSection,
    course: int,
    arms: tuple[FloatArray, FloatArray],
    number: int,
    corner: tuple[int, int],
) -> None:
    """The units on both sides of a groin."""
    profile = section.profile(course)
    across_y = np.array([along_x(profile, section.stretch, x) for x in arms[0]])
    across_x = np.array([along_y(profile, y) for y in arms[1]])
    if len(across_y) > 1:
        webs.add(np.stack([across_y[1:], across_y[:-1]], axis=1), corner, course, 0 if corner[0] > 0 else 2)
    if len(across_x) > 1:
        webs.add(np.stack([across_x[:-1], across_x[1:]], axis=1), corner, course, 1 if corner[1] > 0 else 3)


def _add_ridges(webs: _Webs, section: HalfSection, item: CrossVaultItem, ends: FloatArray) -> None:
    """The course along the ridge of each web, from the keystone outwards."""
    course, foot = section.courses, section.distance[-1]
    profile = np.stack([foot[[0, 0, 1, 1]] * [1, -1, -1, 1], section.height[-1][[0, 0, 1, 1]]], axis=1)
    at_keystone = np.abs(profile[:, 0])
    along = _joints(item, ends, profile, section.stretch, course)
    across_y = np.array([along_x(profile, section.stretch, x) for x in [at_keystone, *along[0]]])
    across_x = np.array([along_y(profile, y) for y in [section.stretch * at_keystone, *along[1]]])
    for span, corner in enumerate(((1, 1), (1, 1), (-1, 1), (1, -1))):
        stations = (across_y[1:], across_y[:-1]) if span % 2 == 0 else (across_x[:-1], across_x[1:])
        webs.add(np.stack(stations, axis=1), corner, course, span)
