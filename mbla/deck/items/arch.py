"""Item `arch`."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from mbla.deck.items.item import Item
from mbla.deck.names import Name
from mbla.deck.quantities import Count, EmbraceAngle, PositiveLength


class ArchItem(Item):
    """A circular arch with radial joints and straight-edged voussoirs, in the x-z plane, extruded along +y.

    The left intrados springing is at the origin, the right one at x = span.
    """

    shape: Literal["semicircular", "segmental"] = Field(description="semicircular, or segmental with rise or embrace")
    span: PositiveLength = Field(description="distance between the intrados springings")
    thickness: PositiveLength = Field(description="radial thickness")
    width: PositiveLength = Field(description="extent along y")
    voussoirs: Count = Field(description="number of voussoirs")
    rise: PositiveLength | None = Field(None, description="segmental: height of the intrados crown over the springings")
    embrace: EmbraceAngle | None = Field(None, description="segmental: angle between the springing joints in degrees")
    springers: Literal["none", "ground", "blocks"] = Field(
        "none",
        description="ground: rigid ground under both springing joints; blocks: a fixed block behind each, "
        "in group GROUP_springers; none: the deck's supports hold the arch",
    )
    joint: Name | None = Field(None, description="joint law at a springing on ground; that of contacts unless given")
