"""Item `column`."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from mbla.deck.items.item import Item
from mbla.deck.quantities import Count, Integer, NonNegativeLength, PositiveLength
from mbla.deck.section import Section, exactly_one_of, given, rule
from mbla.errors import Finding


@exactly_one_of("side", "radius")
class ColumnEnd(Section):
    """Block under or on the shaft of a column; one of side and radius."""

    side: PositiveLength | None = Field(None, description="side of a square block")
    radius: PositiveLength | None = Field(None, description="radius of a round block, a polygon like the drums")
    height: PositiveLength = Field(description="height")


class ColumnItem(Item):
    """A column of drums that rises along +z, the middle of its underside at the origin.

    Drums are regular polygons with a flat towards +x, and frusta where the column tapers. Labels: `drum`; members
    `base`, `drum`, `capital`.
    """

    radius: PositiveLength = Field(description="radius of the shaft at its foot")
    top_radius: PositiveLength | None = Field(
        None, description="radius of the shaft at its top; that at the foot unless given"
    )
    entasis: NonNegativeLength = Field(
        0.0, description="how far the joints at half height swell beyond the straight taper; a parabola over the height"
    )
    height: PositiveLength | None = Field(None, description="height of the shaft, with drums")
    drums: Count | None = Field(None, description="number of drums of equal height")
    drum_heights: list[PositiveLength] | None = Field(
        None, min_length=1, description="heights of the drums from the bottom, instead of height and drums"
    )
    sides: Annotated[int, Integer(ge=3, le=360)] = Field(
        24, description="sides of the polygon that stands for a circle"
    )
    polygon: Literal["equal_area", "inscribed", "circumscribed"] = Field(
        "equal_area",
        description="equal_area: as large as the circle, so that weights are exact; inscribed: corners on the circle; "
        "circumscribed: flats on the circle, so that it rocks at the radius about an edge",
    )
    base: ColumnEnd | None = Field(None, description="block under the shaft, from z = 0; the shaft stands on it")
    capital: ColumnEnd | None = Field(None, description="block on the shaft")


@rule(ColumnItem)
def column_heights(column: ColumnItem) -> Iterator[Finding]:
    """Heights of the drums one by one, or equal ones."""
    pair = ("height", "drums")
    found = given(column, pair)
    if column.drum_heights is not None:
        for key in found:
            yield Finding("one-of-several", "is what drum_heights says already: leave one of them out", key)
    elif len(found) < 2:
        yield Finding("missing-key", "needs height and drums, or drum_heights")


@rule(ColumnItem)
def column_profile(column: ColumnItem) -> Iterator[Finding]:
    """An entasis shows at joints between the ends only."""
    count = column.drums if column.drum_heights is None else len(column.drum_heights)
    if column.entasis > 0 and count == 1:
        words = "has no effect on a single drum: it is the swelling of the joints between drums"
        yield Finding("key-of-another-choice", words, "entasis")
