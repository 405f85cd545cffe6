"""What vaults have in common: curve, thickness, courses, bond."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal, TypeAlias

import numpy as np
from pydantic import Field

from mbla.deck.quantities import EmbraceAngle, Integer, PositiveLength
from mbla.errors import Finding
from mbla.model.blocks.arches.sections import ArchSection
from mbla.model.blocks.curves import named_curve
from mbla.model.blocks.curves.shape_keys import range_of_rise, shape_keys
from mbla.model.blocks.item import SpringingItem

VaultShape: TypeAlias = Literal["semicircular", "segmental", "pointed", "elliptic", "catenary"]


class VaultItem(SpringingItem):
    """Keys of every vault."""

    shape: VaultShape = Field(
        description="curve of the intrados across: semicircular; segmental with rise or embrace; or pointed, elliptic, "
        "catenary with rise"
    )
    rise: PositiveLength | None = Field(None, description="height of the intrados crown over the springings")
    embrace: EmbraceAngle | None = Field(None, description="segmental: angle between the springing joints in degrees")
    thickness: PositiveLength = Field(description="at right angles to the curve")
    courses: Annotated[int, Integer(ge=2, le=100_000)] = Field(
        description="number of courses from springing to springing, of equal lengths on the line halfway through"
    )
    unit: PositiveLength = Field(description="length of the units along their course; closing units are cut to fit")
    bond: Literal["running", "stack"] = Field("running", description="running: odd courses shifted by half a unit")


def check_curve(vault: VaultItem, span: float) -> Iterator[Finding]:
    """A semicircle is given by its span alone, other shapes by what they need."""
    yield from shape_keys(vault, vault.shape, ("rise", "embrace"))
    if vault.rise is not None:
        yield from range_of_rise(vault.shape, span, vault.rise, None, ("rise",))


def check_apex(vault: VaultItem) -> Iterator[Finding]:
    """The apex of a pointed vault is a joint."""
    if vault.shape == "pointed" and vault.courses % 2:
        yield Finding("out-of-bounds", "must be even for a pointed vault: its apex is a joint", "courses")


def vault_section(item: VaultItem, span: float) -> ArchSection:
    """The section of a vault over a span, in one ring; its joints may cross, for its blocks are refused then."""
    curve = named_curve(item.shape, span, item.rise, item.embrace)
    parameters = curve.divide(item.courses, item.thickness / 2)
    offsets = np.broadcast_to([0.0, item.thickness], (len(parameters), 2))
    return ArchSection(curve.points(parameters, offsets), curve.forwards(parameters), None)
