"""Item `polyhedron`."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from mbla.deck.items.item import Item
from mbla.deck.quantities import Index, Point


class PolyhedronItem(Item):
    """One block: a closed polyhedron with planar faces, convex or not."""

    vertices: list[Point] = Field(min_length=4, description="corner points")
    faces: list[Annotated[list[Index], Field(min_length=3)]] = Field(
        min_length=4, description="corners of each face in order, as indices of vertices from 0; any orientation"
    )
