"""Item `trilithon`."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from pydantic import Field

from mbla.deck.kinds.positions import UNIT
from mbla.deck.quantities import PositiveLength
from mbla.deck.section import rule
from mbla.errors import Finding
from mbla.model.blocks.generated import Generated, ItemContext, ItemPart
from mbla.model.blocks.item import AnyItem, ItemKind, register_item
from mbla.model.solids.polyhedra import cuboids


class TrilithonItem(AnyItem):
    """Two uprights along x and a lintel on them, centred; the left upright has its least corner at the origin.

    Members `upright` and `lintel`; labels of the uprights: `unit` 0 and 1.
    """

    upright: tuple[PositiveLength, PositiveLength, PositiveLength] = Field(
        description="extents of an upright along x, y, z"
    )
    opening: PositiveLength = Field(description="clear distance between the uprights")
    lintel: tuple[PositiveLength, PositiveLength, PositiveLength] = Field(
        description="extents of the lintel along x, y, z; longer than the opening"
    )


@rule(TrilithonItem)
def trilithon_lintel(trilithon: TrilithonItem) -> Iterator[Finding]:
    """The lintel rests on both uprights."""
    if trilithon.lintel[0] <= trilithon.opening:
        words = f"must be > {trilithon.opening:g}, the opening: the lintel rests on both uprights"
        yield Finding("out-of-bounds", words, "lintel", 0)


def generate(item: TrilithonItem, context: ItemContext) -> Generated:
    """Left upright, right upright, lintel."""
    upright, lintel = np.array(item.upright), np.array(item.lintel)
    left = np.array([[0.0, 0.0, 0.0], [upright[0] + item.opening, 0.0, 0.0]])
    middle = np.array([upright[0] + item.opening / 2, upright[1] / 2, upright[2] + lintel[2] / 2])
    least = np.array([middle - lintel / 2])
    least[0, 2] = upright[2]
    return Generated(
        (
            ItemPart(cuboids(left, left + upright), member="upright", labels={"unit": np.arange(2)}),
            ItemPart(cuboids(least, least + lintel), member="lintel"),
        )
    )


register_item(ItemKind("trilithon", TrilithonItem, generate, after="stack", positions=(UNIT,)))
