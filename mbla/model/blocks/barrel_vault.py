"""Item `barrel_vault`: courses of straight prisms along its axis, in the section of an arch.

Its volume is the area of that section times the length, with joints at equal angles d of a circle n (R2^2 - R1^2)/2
sin d.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from pydantic import Field

from mbla.arrays import FloatArray
from mbla.deck.kinds.positions import COURSE, UNIT
from mbla.deck.quantities import PositiveLength
from mbla.deck.section import rule
from mbla.errors import Finding
from mbla.model.blocks.arches.haunches import Backing, backing_width, grounds_behind, haunches, with_backing
from mbla.model.blocks.arches.sections import (
    ends_of,
    springer_polygons,
    springing_grounds,
    through,
    units_across,
    voussoir_polygons,
)
from mbla.model.blocks.generated import Generated, GroundPart, ItemContext, ItemPart
from mbla.model.blocks.item import SPRINGERS, ItemKind, register_item
from mbla.model.blocks.vaults.vault import VaultItem, check_apex, check_curve, vault_section

NO_UNIT = 1e-6
"""length of a remainder, relative to the unit, that is no unit of its own"""


class BarrelVaultItem(VaultItem):
    """A barrel vault, its axis along +y, courses along the axis, in the bond of a wall.

    The left intrados springing is at x = 0, the right one at x = span, both at z = 0, from y = 0 to length. Labels:
    `course` from the left springing, `unit` from y = 0. With haunches the vault itself is the member `barrel`.
    """

    span: PositiveLength = Field(description="distance between the intrados springings")
    length: PositiveLength = Field(description="extent along y")
    backing: Backing | None = Field(None, description="haunches over the springings, in units along y as the vault")


@rule(BarrelVaultItem)
def vault_backing(vault: BarrelVaultItem) -> Iterator[Finding]:
    """Haunches of a vault need a width."""
    if vault.backing is not None:
        yield from backing_width(vault.backing)


@rule(BarrelVaultItem)
def vault_curve(vault: BarrelVaultItem) -> Iterator[Finding]:
    """The curve spans the vault."""
    yield from check_curve(vault, vault.span)
    yield from check_apex(vault)


def generate(item: BarrelVaultItem, context: ItemContext) -> Generated:
    """Units course by course from the left springing, along +y in each; haunches.

    Raises ItemRefused where haunches do not fit.
    """
    section = vault_section(item, item.span)

    def across(course: int) -> FloatArray:
        """Both ends of each unit of a course."""
        return _ends(item, item.bond == "running" and course % 2 == 1)

    rows = [across(course) for course in range(item.courses)]
    units, course, unit = units_across(voussoir_polygons(section)[0], rows)
    barrel = ItemPart(units, member="barrel" if item.backing else "", labels={"course": course, "unit": unit})
    parts, grounds = [barrel], tuple[GroundPart, ...]()
    if item.backing is not None:
        made = haunches(item.backing, section, None, across)
        parts.append(made[0])
        if item.springers != "none":
            grounds = grounds_behind(made[1], len(units), item.joint)
    if item.springers == "blocks":
        behind = through(springer_polygons(section, item.thickness), (0.0, item.length))
        parts.append(ItemPart(behind, SPRINGERS.suffix, fixed=True))
    if item.springers == "ground":
        grounds = (*springing_grounds(section, course, item.joint), *grounds)
    return Generated(tuple(parts), grounds)


def _ends(item: BarrelVaultItem, shifted: bool) -> FloatArray:
    """Both ends of each unit of a course along y, (n, 2); the first unit is half a one where shifted."""
    first = item.unit / 2 if shifted else item.unit
    joints = first + item.unit * np.arange(int(np.ceil(item.length / item.unit)) + 1)
    inner = joints[joints < item.length - NO_UNIT * item.unit]
    return ends_of(np.concatenate([[0.0], inner, [item.length]]))


def amount(item: BarrelVaultItem) -> tuple[float, str]:
    """Units of the barrel and of haunches."""
    units, key = with_backing(item.backing, item.courses, "length", item.span + item.thickness)
    return units * (item.length / item.unit), key


register_item(
    ItemKind(
        "barrel_vault", BarrelVaultItem, generate, amount, after="dome", positions=(COURSE, UNIT), groups=(SPRINGERS,)
    )
)
