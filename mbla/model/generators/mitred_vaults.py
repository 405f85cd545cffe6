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
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.items.vaults import CrossVaultItem, PavilionVaultItem, VaultItem
from mbla.errors import Finding
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

    joints   : (n_courses + 2, 2, 2) of the intrados and extrados point of each joint the distance from the middle, and
               z; the first of them lies behind the springing joint by the thickness
    stretch  : bay[1]/bay[0]
    keystone : whether the last joint is that of a keystone rather than the crown itself
    """

    joints: FloatArray
    stretch: float
    keystone: bool

    @property
    def courses(self) -> int:
        """Number of courses up to the last joint."""
        return len(self.joints) - 2

    def profile(self, course: int) -> FloatArray:
        """The four points of a course, (4, 2): distance, height; from the intrados below round by the one above.

        The course -1 lies behind the springing joint.
        """
        low, high = self.joints[course + 1 : course + 3]
        return np.stack([low[0], high[0], high[1], low[1]])


def half_section(item: VaultItem, bay: tuple[float, float]) -> HalfSection:
    """The section of a vault over a bay, folded at the crown."""
    section = vault_section(item, bay[0])
    joints = section.joints[: item.courses // 2 + 1] * [-1.0, 1.0] + [bay[0] / 2, 0.0]
    if item.courses % 2 == 0:
        joints[-1, :, 0] = 0.0
    behind = joints[:1] + item.thickness * section.forwards[0] * [1.0, -1.0]
    return HalfSection(np.concatenate([behind, joints]), bay[1] / bay[0], item.courses % 2 == 1)


def station(profile: FloatArray, x: float | FloatArray, y: float | FloatArray) -> FloatArray:
    """The heights of a profile at places of the plan, (4, 3); x and y for all its points or for each."""
    return np.stack([np.broadcast_to(x, 4), np.broadcast_to(y, 4), profile[:, 1]], axis=1)


def mitred_block(section: HalfSection, course: int, x: float, y: float) -> FloatArray:
    """The block in the corner +x+y, (1, 3, 4, 3): its end along x, the mitre over the diagonal, its end along y."""
    profile = section.profile(course)
    across, along = profile[:, 0], section.stretch * profile[:, 0]
    return np.stack([station(profile, x, along), station(profile, across, along), station(profile, across, y)])[None]


def units_between(
    profile: FloatArray, stretch: float, x: FloatArray | list[FloatArray], y: FloatArray | list[FloatArray]
) -> tuple[FloatArray, FloatArray]:
    """Units of a course along x and along y between upright joints (n,) each, (n - 1, 2, 4, 3)."""
    along_x = np.array([station(profile, at, stretch * profile[:, 0]) for at in x])
    along_y = np.array([station(profile, profile[:, 0], at) for at in y])
    return np.stack([along_x[1:], along_x[:-1]], axis=1), np.stack([along_y[:-1], along_y[1:]], axis=1)


def reflected(stations: FloatArray, corner: tuple[int, int]) -> Polyhedra:
    """Chains (n, n_polygons, n_corners, 3) in the corner +x+y, reflected to another corner."""
    turned = stations * [corner[0], corner[1], 1]
    return chains(turned[:, :, ::-1] if corner[0] * corner[1] < 0 else turned)


Webs: TypeAlias = list[tuple[FloatArray, tuple[int, int], int, int]]
"""units (n, 2, 4, 3) of a course in the corner +x+y, in their order, the corner they are reflected to, course, span"""


def _vault(
    item: VaultItem, section: HalfSection, member: str, mitred_blocks: list[FloatArray], webs: Webs, behind: FloatArray
) -> Generated:
    """Mitred blocks (1, 3, 4, 3) of each course in all corners, units of the webs, keystone, springers, ground.

    behind : (1, 3, 4, 3) the fixed block behind the springing
    """
    around = {"course": np.repeat(np.arange(section.courses), 4), "segment": np.tile(np.arange(4), section.courses)}
    parts = [Part(_in_corners(mitred_blocks), member=member, labels=around)]
    numbers = [(course, span, unit) for units, _, course, span in webs for unit in range(len(units))]
    if numbers:  # all units of a small vault may belong to the groins
        positions = dict(zip(("course", "span", "unit"), np.array(numbers, dtype=np.int64).T, strict=True))
        units = join_polyhedra([reflected(units, corner) for units, corner, _, _ in webs if len(units)])
        parts.append(Part(units, member="web", labels=positions))
    if section.keystone:
        parts.append(Part(_keystone(section), member="keystone", labels={"course": np.array([section.courses])}))
    first = np.flatnonzero(np.concatenate([part.labels["course"] for part in parts]) == 0)
    if item.springers == "blocks":
        parts.append(Part(_in_corners([behind]), "_springers", fixed=True, labels={"segment": np.arange(4)}))
    return Generated(tuple(parts), (level_ground(first, item.joint),) if item.springers == "ground" else ())


def _in_corners(blocks: Sequence[FloatArray]) -> Polyhedra:
    return join_polyhedra([reflected(block, corner) for block in blocks for corner in CORNERS])


def _keystone(section: HalfSection) -> Polyhedra:
    """The frustum between the last joints of all four webs."""
    distance, height = section.joints[-1].T
    flat = distance[:, None, None] * (np.array(CORNERS, dtype=np.float64) * [1.0, section.stretch])
    levels = np.broadcast_to(height[:, None, None], (2, 4, 1))
    return chains(np.concatenate([flat, levels], axis=2)[None])


# --- cross vaults ---------------------------------------------------------------------------------------------------


def _edge(item: CrossVaultItem) -> float:
    """How far the webs run on beyond the corners of the bay."""
    stretch = item.bay[1] / item.bay[0]
    return 2 * item.thickness * max(1.0, stretch) if item.edge is None else item.edge


def generate_cross_vault(item: CrossVaultItem, site: Site) -> Generated:
    """Groins from the springings up, four blocks in each course; units of the webs; keystone; fixed springers.

    Raises ItemRefused where the webs end before the feet of the groins.
    """
    section = half_section(item, item.bay)
    ends = _ends(item, section)
    groins, webs = [], Webs()
    for course in range(section.courses):
        profile = section.profile(course)
        x, y = _joints_outwards(item, ends, profile, section.stretch, course)
        groins.append(mitred_block(section, course, x[0], y[0]))
        along_x, along_y = units_between(profile, section.stretch, x, y)
        for corner in CORNERS:
            webs.append((along_x, corner, course, 0 if corner[0] > 0 else 2))
            webs.append((along_y, corner, course, 1 if corner[1] > 0 else 3))
    if section.keystone:
        webs += _ridges(section, item, ends)
    return _vault(item, section, "groin", groins, webs, mitred_block(section, -1, ends[0], ends[1]))


def _ends(item: CrossVaultItem, section: HalfSection) -> FloatArray:
    """Where the webs end along x and y from the middle, (2,)."""
    sides = np.array([1.0, section.stretch])
    feet = sides * section.joints[1, :, 0].max() - np.array(item.bay) / 2
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


def _ridges(section: HalfSection, item: CrossVaultItem, ends: FloatArray) -> Webs:
    """The course along the ridge of each web, from the keystone outwards."""
    last = section.joints[-1]
    profile = last[[0, 0, 1, 1]] * [[1, 1], [-1, 1], [-1, 1], [1, 1]]
    side = np.abs(profile[:, 0])
    x, y = _joints_outwards(item, ends, profile, section.stretch, section.courses)
    units = units_between(profile, section.stretch, [side, *x], [section.stretch * side, *y])
    corners = ((1, 1), (1, 1), (-1, 1), (1, -1))
    return [(units[span % 2], corner, section.courses, span) for span, corner in enumerate(corners)]


# --- pavilion vaults ------------------------------------------------------------------------------------------------


def generate_pavilion_vault(item: PavilionVaultItem, site: Site) -> Generated:
    """Hips from the springings up, four blocks in each course; units of the webs; keystone; fixed springers."""
    section = half_section(item, item.bay)
    hips, webs = [], Webs()
    for course in range(section.courses):
        x, y = _joints_between(item, section, course)
        hips.append(_hip(section, course, x[-1], y[-1]))
        along_x, along_y = units_between(section.profile(course), section.stretch, x, y)
        for span, units in enumerate((along_y, along_x[::-1]) * 2):  # counter-clockwise
            webs.append((units if span < 2 else units * [-1.0, -1.0, 1.0], (1, 1), course, span))
    return _vault(item, section, "hip", hips, webs, _hip(section, -1, 0.0, 0.0))


def _hip(section: HalfSection, course: int, x: float, y: float) -> FloatArray:
    """The block in the corner +x+y, (1, 3, 4, 3): its end along y, the mitre, its end along x."""
    return mitred_block(section, course, x, y)[:, ::-1]


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
