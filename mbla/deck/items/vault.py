"""What the vaults have in common: curve, thickness, courses, bond."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import Field

from mbla.deck.items.item import Item
from mbla.deck.names import Name
from mbla.deck.quantities import EmbraceAngle, PositiveLength, Whole

VaultShape: TypeAlias = Literal["semicircular", "segmental", "pointed", "elliptic", "catenary"]


class VaultItem(Item):
    """Keys of every vault."""

    shape: VaultShape = Field(
        description="curve of the intrados across: semicircular; segmental with rise or embrace; or pointed, elliptic, "
        "catenary with rise"
    )
    rise: PositiveLength | None = Field(None, description="height of the intrados crown over the springings")
    embrace: EmbraceAngle | None = Field(None, description="segmental: angle between the springing joints in degrees")
    thickness: PositiveLength = Field(description="at right angles to the curve")
    courses: Annotated[int, Whole(ge=2, le=100_000)] = Field(
        description="number of courses from springing to springing, of equal lengths on the line halfway through"
    )
    unit: PositiveLength = Field(description="length of the units along their course; closing units are cut to fit")
    bond: Literal["running", "stack"] = Field("running", description="running: odd courses shifted by half a unit")
    springers: Literal["none", "ground", "blocks"] = Field(
        "none",
        description="ground: rigid ground under the springing joints; blocks: fixed blocks behind them, in group "
        "GROUP_springers; none: the deck's supports hold the vault",
    )
    joint: Name | None = Field(None, description="joint law at springings on ground; that of contacts unless given")
