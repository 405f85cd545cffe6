"""Item `cross_vault`: two barrels that meet in groins."""

from __future__ import annotations

import numpy as np
from pydantic import Field

from mbla.arrays import FloatArray
from mbla.deck.quantities import PositiveLength
from mbla.deck.section import rule
from mbla.errors import Finding
from mbla.model.blocks.generated import Generated, ItemContext, ItemRefused
from mbla.model.blocks.vaults.mitred import (
    CORNERS,
    SHORTEST,
    HalfSection,
    MitredVaultItem,
    Webs,
    half_section,
    mitred_block,
    mitred_vault,
    register_vault,
    units_between,
)
from mbla.model.blocks.vaults.vault import check_apex

LEAST_EDGE = 1e-3
"""of the thickness: the webs of a cross vault end at least so far beyond the feet of the groins"""


class CrossVaultItem(MitredVaultItem):
    """A cross (groin) vault: two barrels that meet in vertical planes over the diagonals, the middle of the bay at the
    origin, springings at z = 0.

    The curve spans bay[0], across the webs towards +y and -y; over an oblong bay the other section is this one
    stretched along y, so that the groins stay plane. Blocks at the groins belong to both webs. An odd number of courses
    has a keystone with a course along each ridge, an even one joints along the ridges. Members `groin`, `web`,
    `keystone`; labels: `course` from the springings up, of webs `span` (0 to 3: the webs towards +x, +y, -x, -y) and
    `unit` from the groin outwards, of groins `segment` (0 to 3: the corners at +x+y, -x+y, -x-y, +x-y).
    """

    bay: tuple[PositiveLength, PositiveLength] = Field(
        description="distance along x and y between the corners where the intrados springs"
    )
    edge: PositiveLength | None = Field(
        None,
        description="how far the webs run on beyond these corners, the width of the piers: more than the thickness; "
        "default: twice the thickness, over an oblong bay that of the stretched section",
    )


rule(CrossVaultItem)(check_apex)


def edge_of(item: CrossVaultItem) -> float:
    """How far the webs run on beyond the corners of the bay."""
    stretch = item.bay[1] / item.bay[0]
    return 2 * item.thickness * max(1.0, stretch) if item.edge is None else item.edge


def generate(item: CrossVaultItem, context: ItemContext) -> Generated:
    """Groins from the springings up, four blocks in each course; units of the webs; keystone; fixed springers.

    Raises ItemRefused where the webs end before the feet of the groins.
    """
    section = half_section(item)
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
    return mitred_vault(item, section, "groin", groins, webs, mitred_block(section, -1, ends[0], ends[1]))


def _ends(item: CrossVaultItem, section: HalfSection) -> FloatArray:
    """Where the webs end along x and y from the middle, (2,)."""
    sides = np.array([1.0, section.stretch])
    feet = sides * section.joints[1, :, 0].max() - np.array(item.bay) / 2
    edge = edge_of(item)
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


def amount(item: CrossVaultItem) -> tuple[float, str]:
    """Units along the webs, as far as these run on."""
    return item.courses * (sum(item.bay) + 4 * edge_of(item)) / item.unit, "unit"


register_vault("cross_vault", CrossVaultItem, generate, amount, after="barrel_vault")
