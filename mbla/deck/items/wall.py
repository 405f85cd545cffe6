"""Item `wall`."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from mbla.deck.items.item import Item
from mbla.deck.quantities import Count, PlanePoint, PositiveLength
from mbla.deck.section import Section


class Opening(Section):
    """Rectangular opening in the plane of a wall, its bottom and top on bed joints."""

    from_: PlanePoint = Field(alias="from", description="lower corner: distance along the wall, height")
    to: PlanePoint = Field(description="upper corner: distance along the wall, height")


class WallItem(Item):
    """A wall one unit thick: runs along +x from the origin, rises along +z, thickness along +y."""

    unit: tuple[PositiveLength, PositiveLength, PositiveLength] = Field(
        description="length along the wall, thickness, height of one unit"
    )
    length: PositiveLength = Field(description="length of the wall; the closing units are cut to fit")
    courses: Count = Field(description="number of courses")
    bond: Literal["running", "stack"] = Field("running", description="running: odd courses shifted by half a unit")
    start: Literal["full", "half"] = Field("full", description="first unit of the bottom course")
    openings: list[Opening] = Field(default_factory=list, description="rectangles left free")
