"""Item `box`."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from pydantic import Field

from mbla.deck.quantities import Point, corners_in_order
from mbla.deck.section import rule
from mbla.errors import Finding
from mbla.model.blocks.generated import Generated, ItemContext, ItemPart
from mbla.model.blocks.item import AnyItem, ItemKind, register_item
from mbla.model.solids.polyhedra import cuboids


class BoxItem(AnyItem):
    """One block: a cuboid along the axes."""

    min: Point = Field(description="corner with the least coordinates")
    max: Point = Field(description="corner with the greatest coordinates")


@rule(BoxItem)
def box_extent(box: BoxItem) -> Iterator[Finding]:
    """Corners in order, none equal."""
    yield from corners_in_order(box.min, box.max, "max")


def generate(item: BoxItem, context: ItemContext) -> Generated:
    """The cuboid between two corners."""
    return Generated((ItemPart(cuboids(np.array([item.min]), np.array([item.max]))),))


register_item(ItemKind("box", BoxItem, generate))
