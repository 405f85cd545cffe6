"""Item `box`."""

from __future__ import annotations

from pydantic import Field

from mbla.deck.items.item import Item
from mbla.deck.quantities import Point


class BoxItem(Item):
    """One block: a cuboid along the axes."""

    min: Point = Field(description="corner with the least coordinates")
    max: Point = Field(description="corner with the greatest coordinates")
