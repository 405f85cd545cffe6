"""Cross (groin) and pavilion (cloister) vaults: courses mitred over the diagonals of their bay.

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

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.kinds.positions import COURSE, SEGMENT, SPAN, UNIT
from mbla.deck.quantities import PositiveLength
from mbla.deck.section import ROUNDING, rule
from mbla.errors import Finding
from mbla.model.blocks.generated import Generated, Generator, ItemPart, level_ground
from mbla.model.blocks.item import SPRINGERS, Amount, ItemKind, register_item
from mbla.model.blocks.vaults.vault import VaultItem, check_curve, vault_section
from mbla.model.solids.polyhedra import Polyhedra, chains, join_polyhedra


class MitredVaultItem(VaultItem):
    """A vault over a bay, of webs that meet over its diagonals."""

    bay: tuple[PositiveLength, PositiveLength]


LEVEL = ("semicircular", "pointed", "elliptic")
"""shapes that are upright at their springings, so that the joints there are level"""


@rule(MitredVaultItem)
def curve_over_bay(vault: MitredVaultItem) -> Iterator[Finding]:
    """The curve spans the bay along x."""
    yield from check_curve(vault, vault.bay[0])


@rule(MitredVaultItem)
def at_most_semicircular(vault: MitredVaultItem) -> Iterator[Finding]:
    """Webs that lean in below their widest place would cut each other there."""
    if vault.embrace is not None and vault.embrace > 180:
        yield Finding("out-of-bounds", "must be <= 180: two barrels meet in it", "embrace")
    half = vault.bay[0] / 2
    if vault.shape == "segmental" and vault.rise is not None and vault.rise > half * (1 + ROUNDING):
        words = f"must be <= {half:g}, half the span, for a segmental vault: two barrels meet in it"
        yield Finding("out-of-bounds", words, "rise")


@rule(MitredVaultItem)
def level_springers(vault: MitredVaultItem) -> Iterator[Finding]:
    """Where two webs meet at a springing, ground is one plane if it is level."""
    if vault.springers == "ground" and vault.shape not in LEVEL:
        words = f"springings on ground are level, those of a {vault.shape} vault slope in each web: write blocks"
        yield Finding("vault-shape", words, "springers")


CORNERS = ((1, 1), (-1, 1), (-1, -1), (1, -1))
"""signs of x and y in the four corners of the bay, counter-clockwise"""
SHORTEST = 0.25
"""least length of the arm of a mitred block beyond the mitre, in units"""


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


def half_section(item: MitredVaultItem) -> HalfSection:
    """The section of a vault, folded at the crown."""
    bay = item.bay
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


def mitred_vault(
    item: VaultItem, section: HalfSection, member: str, mitred_blocks: list[FloatArray], webs: Webs, behind: FloatArray
) -> Generated:
    """Mitred blocks (1, 3, 4, 3) of each course in all corners, units of the webs, keystone, springers, ground.

    behind : (1, 3, 4, 3) the fixed block behind the springing
    """
    around = {"course": np.repeat(np.arange(section.courses), 4), "segment": np.tile(np.arange(4), section.courses)}
    parts = [ItemPart(_in_corners(mitred_blocks), member=member, labels=around)]
    numbers = [(course, span, unit) for units, _, course, span in webs for unit in range(len(units))]
    if numbers:  # all units of a small vault may belong to the groins
        positions = dict(zip(("course", "span", "unit"), np.array(numbers, dtype=np.int64).T, strict=True))
        units = join_polyhedra([reflected(units, corner) for units, corner, _, _ in webs if len(units)])
        parts.append(ItemPart(units, member="web", labels=positions))
    if section.keystone:
        parts.append(ItemPart(_keystone(section), member="keystone", labels={"course": np.array([section.courses])}))
    first = np.flatnonzero(np.concatenate([part.labels["course"] for part in parts]) == 0)
    if item.springers == "blocks":
        parts.append(ItemPart(_in_corners([behind]), SPRINGERS.suffix, fixed=True, labels={"segment": np.arange(4)}))
    return Generated(tuple(parts), (level_ground(first, item.joint),) if item.springers == "ground" else ())


def _in_corners(blocks: Sequence[FloatArray]) -> Polyhedra:
    return join_polyhedra([reflected(block, corner) for block in blocks for corner in CORNERS])


def _keystone(section: HalfSection) -> Polyhedra:
    """The frustum between the last joints of all four webs."""
    distance, height = section.joints[-1].T
    flat = distance[:, None, None] * (np.array(CORNERS, dtype=np.float64) * [1.0, section.stretch])
    levels = np.broadcast_to(height[:, None, None], (2, 4, 1))
    return chains(np.concatenate([flat, levels], axis=2)[None])


def register_vault(name: str, section: type[MitredVaultItem], generate: Generator, amount: Amount, after: str) -> None:
    """Make a kind of mitred vaults known."""
    positions = (COURSE, SPAN, UNIT, SEGMENT)
    register_item(ItemKind(name, section, generate, amount, after=after, positions=positions, groups=(SPRINGERS,)))
