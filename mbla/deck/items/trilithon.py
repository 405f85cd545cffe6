"""Item `trilithon`."""

from __future__ import annotations

from collections.abc import Iterator

from pydantic import Field

from mbla.deck.items.item import Item
from mbla.deck.quantities import PositiveLength
from mbla.deck.section import rule
from mbla.errors import Finding


class TrilithonItem(Item):
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
