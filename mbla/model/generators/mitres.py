"""Courses of cross and pavilion vaults, mitred over the diagonals of their bay.

Both vaults are two barrels over the same bay. Let X and Z be a point of the section across x, X its distance from the
middle, and q = bay[1]/bay[0] how much longer the bay is along y. The other section is the same stretched by q: X and
q X are both on the diagonal, at the same height, and so a joint of one barrel meets the same joint of the other exactly
above the diagonal. A block there has three profiles in a chain, one at its end in each web and the mitre between them,
and all its faces are plane, since each contains the direction of its web.

What is made here lies in the corner at +x+y and is reflected to the other three.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.deck.items.vaults import VaultItem
from mbla.model.generators.arch_sections import vault_section
from mbla.model.generators.generator import Part
from mbla.model.solids.chains import chains
from mbla.model.solids.polyhedra import Polyhedra

CORNERS = ((1, 1), (-1, 1), (-1, -1), (1, -1))
"""signs of x and y in the four corners of the bay, counter-clockwise"""
SHORTEST = 0.25
"""least length of the arm of a mitred block beyond the mitre, in units"""


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


def keystone(section: HalfSection) -> Polyhedra:
    """The frustum between the last joints of all four webs."""
    signs = np.array([[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]]) * [1.0, section.stretch]
    flat = section.distance[-1][:, None, None] * signs
    height = np.broadcast_to(section.height[-1][:, None, None], (2, 4, 1))
    return chains(np.concatenate([flat, height], axis=2)[None])


def first_course(parts: Sequence[Part]) -> IntArray:
    """The blocks of the first course, (n,), counted through all parts."""
    return np.flatnonzero(np.concatenate([part.labels["course"] for part in parts]) == 0)
