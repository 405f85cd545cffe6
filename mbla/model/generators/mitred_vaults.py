"""Generators of cross (groin) and pavilion (cloister) vaults: courses mitred over the diagonals of their bay.

Both vaults are two barrels over the same bay. Let X and Z be a point of the section across x, X its distance from the
middle, and q = bay[1]/bay[0] how much longer the bay is along y. The other section is the same stretched by q: X and
q X are both on the diagonal, at the same height, and so a joint of one barrel meets the same joint of the other exactly
above the diagonal. A block there has three profiles in a chain, one at its end in each web and the mitre between them,
and all its faces are plane, since each contains the direction of its web. What is made lies in the corner at +x+y and
is reflected to the other three.

Of a *cross vault* the webs towards +x and -x are pieces of the barrel along x, whose courses run from the groin out to
the edge. A course with the area A of its profile, the centroid of which lies at a distance c from the middle, fills A
(length to the edge - c) in each of the two webs on its side of the ridge. Of a *pavilion vault* it goes round the bay
and fills 8 q A c. Sums of these, and the keystone, are the volumes.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.items.vaults import CrossVaultItem, PavilionVaultItem, VaultItem
from mbla.errors import Finding
from mbla.model.generators.amounts import Amount
from mbla.model.generators.arch_sections import vault_section
from mbla.model.generators.generator import Generated, ItemRefused, Part, Site, level_ground
from mbla.model.solids.polyhedra import Polyhedra, chains, join_polyhedra

CORNERS = ((1, 1), (-1, 1), (-1, -1), (1, -1))
"""signs of x and y in the four corners of the bay, counter-clockwise"""
SHORTEST = 0.25
"""least length of the arm of a mitred block beyond the mitre, in units"""
LEAST_EDGE = 1e-3
"""of the thickness: the webs of a cross vault end at least so far beyond the feet of the groins"""


@dataclass(frozen=True)
class HalfSection:
    """Half of the section across x, from the springing up to the crown or to the keystone.

    distance, height : (n_courses + 1, 2) of the intrados and extrados point of each joint from the middle, and z
    back             : (2,) from the springing joint backwards by the thickness: distance, height
    stretch          : bay[1]/bay[0]
    keystone         : whether the last joint is that of a keystone rather than the crown itself
    """

    distance: FloatArray
    height: FloatArray
    back: FloatArray
    stretch: float
    keystone: bool

    @property
    def courses(self) -> int:
        """Number of courses up to the last joint."""
        return len(self.distance) - 1

    def profile(self, course: int) -> FloatArray:
        """The four points of a course, (4, 2): distance, height; from the intrados below round by the one above.

        The course -1 lies behind the springing joint.
        """
        low = self._joint(course)
        high = self._joint(course + 1)
        return np.stack([low[0], high[0], high[1], low[1]])

    def _joint(self, number: int) -> FloatArray:
        joint = np.stack([self.distance[max(number, 0)], self.height[max(number, 0)]], axis=1)
        return joint + self.back if number < 0 else joint


def half_section(item: VaultItem, bay: tuple[float, float]) -> HalfSection:
    """The section of a vault over a bay, folded at the crown."""
    section = vault_section(item, bay[0])
    half = section.joints[: item.courses // 2 + 1]
    distance, height = bay[0] / 2 - half[..., 0], half[..., 1].copy()
    if item.courses % 2 == 0:
        distance[-1] = 0.0
    back = item.thickness * section.forwards[0] * [1.0, -1.0]
    return HalfSection(distance, height, back, bay[1] / bay[0], item.courses % 2 == 1)


def along_y(profile: FloatArray, y: float | FloatArray) -> FloatArray:
    """A profile across x at a place along y, (4, 3); y for all its points or for each."""
    return np.stack([profile[:, 0], np.broadcast_to(y, 4), profile[:, 1]], axis=1)


def along_x(profile: FloatArray, stretch: float, x: float | FloatArray) -> FloatArray:
    """A profile across y at a place along x, (4, 3)."""
    return np.stack([np.broadcast_to(x, 4), stretch * profile[:, 0], profile[:, 1]], axis=1)


def mitred(profile: FloatArray, stretch: float) -> FloatArray:
    """The profile over the diagonal, (4, 3)."""
    return along_y(profile, stretch * profile[:, 0])


def reflected(stations: FloatArray, corner: tuple[int, int]) -> Polyhedra:
    """Chains (n, n_polygons, n_corners, 3) in the corner +x+y, reflected to another corner."""
    turned = stations * [corner[0], corner[1], 1]
    return chains(turned[:, :, ::-1] if corner[0] * corner[1] < 0 else turned)


@dataclass
class _Webs:
    """Units of the webs as they are made."""

    units: list[Polyhedra] = field(default_factory=list)
    labels: list[tuple[int, int, int]] = field(default_factory=list)

    def add(self, stations: FloatArray, corner: tuple[int, int], course: int, span: int) -> None:
        """Units (n, n_polygons, 4, 3) of one course of one web, in their order."""
        if len(stations):
            self.units.append(reflected(stations, corner))
            self.labels += [(course, span, unit) for unit in range(len(stations))]


def _vault(
    item: VaultItem,
    section: HalfSection,
    member: str,
    mitred_blocks: Sequence[FloatArray],
    webs: _Webs,
    behind: FloatArray,
    closed: bool,
) -> Generated:
    """Mitred blocks (1, 3, 4, 3) of each course in all corners, units of the webs, keystone, springers, ground.

    behind : (1, 3, 4, 3) the fixed block behind the springing; closed : whether there is a keystone
    """
    around = {"course": np.repeat(np.arange(section.courses), 4), "segment": np.tile(np.arange(4), section.courses)}
    parts = [Part(_in_corners(mitred_blocks), member=member, labels=around)]
    if webs.units:  # all units of a small vault may belong to the groins
        course, span, unit = np.array(webs.labels, dtype=np.int64).T
        positions = {"course": course, "span": span, "unit": unit}
        parts.append(Part(join_polyhedra(webs.units), member="web", labels=positions))
    if closed:
        parts.append(Part(_keystone(section), member="keystone", labels={"course": np.array([section.courses])}))
    first = np.flatnonzero(np.concatenate([part.labels["course"] for part in parts]) == 0)
    if item.springers == "blocks":
        parts.append(Part(_in_corners([behind]), "_springers", fixed=True, labels={"segment": np.arange(4)}))
    return Generated(tuple(parts), (level_ground(first, item.joint),) if item.springers == "ground" else ())


def _in_corners(blocks: Sequence[FloatArray]) -> Polyhedra:
    return join_polyhedra([reflected(block, corner) for block in blocks for corner in CORNERS])


def _keystone(section: HalfSection) -> Polyhedra:
    """The frustum between the last joints of all four webs."""
    flat = section.distance[-1][:, None, None] * (np.array(CORNERS, dtype=np.float64) * [1.0, section.stretch])
    height = np.broadcast_to(section.height[-1][:, None, None], (2, 4, 1))
    return chains(np.concatenate([flat, height], axis=2)[None])


def _mitred_block(section: HalfSection, course: int, x: float, y: float) -> FloatArray:
    """The block in the corner +x+y, (1, 3, 4, 3): its end along x, the mitre, its end along y."""
    profile = section.profile(course)
    ends = along_x(profile, section.stretch, x), along_y(profile, y)
    return np.stack([ends[0], mitred(profile, section.stretch), ends[1]])[None]


# --- cross vaults ---------------------------------------------------------------------------------------------------


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
        arms = _joints_outwards(item, ends, section.profile(course), section.stretch, course)
        groins.append(_mitred_block(section, course, arms[0][0], arms[1][0]))
        for corner in CORNERS:
            _add_units(webs, section, course, arms, corner)
    if section.keystone:
        _add_ridges(webs, section, item, ends)
    behind = _mitred_block(section, -1, ends[0], ends[1])
    return _vault(item, section, "groin", groins, webs, behind, section.keystone)


def _ends(item: CrossVaultItem, section: HalfSection) -> FloatArray:
    """Where the webs end along x and y from the middle, (2,)."""
    sides = np.array([1.0, section.stretch])
    feet = sides * section.distance[0].max() - np.array(item.bay) / 2
    edge = _edge(item)
    if edge < feet.max() + LEAST_EDGE * item.thickness:
        message = f"must be > {feet.max():g}: the webs end beyond the feet of the groins"
        raise ItemRefused(Finding("out-of-bounds", message, "edge"))
    return np.array(item.bay) / 2 + edge


def _joints_outwards(
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


def _add_units(
    webs: _Webs, section: HalfSection, course: int, arms: tuple[FloatArray, FloatArray], corner: tuple[int, int]
) -> None:
    """The units on both sides of a groin, from there outwards."""
    profile = section.profile(course)
    across_y = np.array([along_x(profile, section.stretch, x) for x in arms[0]])
    across_x = np.array([along_y(profile, y) for y in arms[1]])
    webs.add(np.stack([across_y[1:], across_y[:-1]], axis=1), corner, course, 0 if corner[0] > 0 else 2)
    webs.add(np.stack([across_x[:-1], across_x[1:]], axis=1), corner, course, 1 if corner[1] > 0 else 3)


def _add_ridges(webs: _Webs, section: HalfSection, item: CrossVaultItem, ends: FloatArray) -> None:
    """The course along the ridge of each web, from the keystone outwards."""
    course, foot = section.courses, section.distance[-1]
    profile = np.stack([foot[[0, 0, 1, 1]] * [1, -1, -1, 1], section.height[-1][[0, 0, 1, 1]]], axis=1)
    at_keystone = np.abs(profile[:, 0])
    along = _joints_outwards(item, ends, profile, section.stretch, course)
    across_y = np.array([along_x(profile, section.stretch, x) for x in [at_keystone, *along[0]]])
    across_x = np.array([along_y(profile, y) for y in [section.stretch * at_keystone, *along[1]]])
    for span, corner in enumerate(((1, 1), (1, 1), (-1, 1), (1, -1))):
        stations = (across_y[1:], across_y[:-1]) if span % 2 == 0 else (across_x[:-1], across_x[1:])
        webs.add(np.stack(stations, axis=1), corner, course, span)


# --- pavilion vaults ------------------------------------------------------------------------------------------------


def amount_pavilion_vault(item: PavilionVaultItem) -> Amount:
    """About how many units such an item has."""
    return Amount(item.courses * sum(item.bay) / item.unit, "unit")


def generate_pavilion_vault(item: PavilionVaultItem, site: Site) -> Generated:
    """Hips from the springings up, four blocks in each course; units of the webs; keystone; fixed springers."""
    section = half_section(item, item.bay)
    hips, webs = [], _Webs()
    for course in range(section.courses):
        joints = _joints_between(item, section, course)
        hips.append(_hip(section, course, joints[0][-1], joints[1][-1]))
        for span in range(4):
            webs.add(_units(section, course, joints, span), (1, 1), course, span)
    return _vault(item, section, "hip", hips, webs, _hip(section, -1, 0.0, 0.0), closed=True)


def _hip(section: HalfSection, course: int, x: float, y: float) -> FloatArray:
    """The block in the corner +x+y, (1, 3, 4, 3): its end along y, the mitre, its end along x."""
    return _mitred_block(section, course, x, y)[:, ::-1]


def _joints_between(item: PavilionVaultItem, section: HalfSection, course: int) -> tuple[FloatArray, FloatArray]:
    """Upright joints of a course along x and along y, increasing; the arms of the hips end at the first and last."""
    shifted = item.bond == "running" and course % 2 == 1
    found = []
    for stretched in (1.0, section.stretch):
        reach = stretched * section.profile(course)[:, 0].min() - SHORTEST * item.unit
        reach = np.fmin(reach, max(item.bay))  # infinite, or no number, where a radius is beyond what a double holds
        steps = np.arange(int(max(reach, 0.0) / item.unit) + 1) + (0.5 if shifted else 0.0)
        right = item.unit * steps[item.unit * steps <= reach]
        found.append(np.unique(np.concatenate([-right, right])) if len(right) else np.zeros(1))
    return found[0], found[1]


def _units(section: HalfSection, course: int, joints: tuple[FloatArray, FloatArray], span: int) -> FloatArray:
    """The units of a course between two hips, counter-clockwise, (n, 2, 4, 3)."""
    profile = section.profile(course)
    if span % 2 == 0:
        stations = np.array([along_y(profile, y) for y in joints[1]])
    else:
        stations = np.array([along_x(profile, section.stretch, x) for x in joints[0][::-1]])
    ordered = np.stack([stations[:-1], stations[1:]], axis=1)
    return np.asarray(ordered if span < 2 else ordered * [-1.0, -1.0, 1.0])
