"""Item `stack`."""

from __future__ import annotations

from pydantic import Field

from mbla.deck.items.item import Item
from mbla.deck.quantities import Count, Length, PlanePoint, PositiveLength, PositiveNumber


class StackItem(Item):
    """Equal cuboids one on the other along +z, the lowest with its least corner at the origin. Labels: `drum`."""

    block: tuple[PositiveLength, PositiveLength, PositiveLength] = Field(description="extents of a block along x, y, z")
    count: Count = Field(description="number of blocks")
    shift: PlanePoint | None = Field(None, description="displacement along x and y of each block from the one below")
    offsets: list[Length] | None = Field(
        None, description="displacement along x of each block from the one below, count - 1 of them from the bottom"
    )
    overhang: PositiveNumber | None = Field(
        None,
        description="harmonic overhang towards +x: the k-th block from the top is shifted by overhang times "
        "length/(2k) over the one below; 1 is the most that stands",
    )
