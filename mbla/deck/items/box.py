"""Item `box`."""

from __future__ import annotations

from collections.abc import Iterator

from pydantic import Field

from mbla.deck.items.item import Item
from mbla.deck.quantities import Point, corners_in_order
from mbla.deck.section import rule
from mbla.errors import Finding


class BoxItem(Item):
    """One block: a cuboid along the axes."""

    min: Point = Field(description="corner with the least coordinates")
    max: Point = Field(description="corner with the greatest coordinates")


@rule(BoxItem)
def box_extent(box: BoxItem) -> Iterator[Finding]:
    """Corners in order, none equal."""
    yield from corners_in_order(box.min, box.max, "max")
