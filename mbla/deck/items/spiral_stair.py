"""Item `spiral_stair`."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from mbla.deck.items.item import Item
from mbla.deck.quantities import Count, Integer, Name, NonNegativeLength, PositiveLength, Quantity
from mbla.deck.section import rule
from mbla.errors import Finding


class SpiralStairItem(Item):
    """A spiral stair of cantilevered treads about the z axis, rising counter-clockwise from z = 0.

    Each tread begins at the angle of its number times `angle`, rests with its front on the back of the one below, and
    reaches into a wall at its outer end. Arcs are straight between the angles at which treads begin and end. Labels:
    `tread`, of the wall too.
    """

    treads: Annotated[int, Integer(ge=2, le=100_000)] = Field(description="number of treads")
    inner_radius: PositiveLength = Field(description="radius of the well")
    outer_radius: PositiveLength = Field(description="radius of the face of the wall")
    rise: PositiveLength = Field(description="height from tread to tread")
    angle: Annotated[float, Quantity("angle", gt=0, le=120)] = Field(description="from tread to tread, degrees")
    overlap: Annotated[float, Quantity("angle", gt=0, lt=60)] = Field(
        description="angle over which a tread rests on the one below, degrees; less than angle"
    )
    rebate: NonNegativeLength = Field(
        0.0,
        description="how far a tread reaches down behind the one below: they meet in an upright joint of that height "
        "too; less than rise, 0 for treads that only lie on each other",
    )
    built_in: NonNegativeLength = Field(0.0, description="length of the treads beyond the face of the wall")
    wall: Literal["none", "shelf", "pocket"] = Field(
        "none",
        description="shelf: fixed blocks under the ends of the treads but the lowest, in group GROUP_wall; pocket: "
        "also on top of them, so that the ends are clamped; none: the deck's supports hold the treads",
    )
    facets: Count = Field(1, description="straight pieces of the arc between the overlaps of a tread")
    foot: Literal["none", "ground"] = Field("none", description="ground: rigid ground under the lowest tread")
    joint: Name | None = Field(None, description="joint law on ground; that of contacts unless given")


@rule(SpiralStairItem)
def stair_extents(stair: SpiralStairItem) -> Iterator[Finding]:
    """Radii in order; a tread is longer than it overlaps the next, and higher than its rebate."""
    if stair.outer_radius <= stair.inner_radius:
        yield Finding("out-of-bounds", f"must be > {stair.inner_radius:g}, the inner radius", "outer_radius")
    if stair.overlap >= stair.angle:
        yield Finding("out-of-bounds", f"must be < {stair.angle:g}, the angle from tread to tread", "overlap")
    if stair.rebate >= stair.rise:
        yield Finding("out-of-bounds", f"must be < {stair.rise:g}, the rise", "rebate")


@rule(SpiralStairItem)
def stair_supports(stair: SpiralStairItem) -> Iterator[Finding]:
    """A wall holds what is built into it."""
    if stair.wall != "none" and stair.built_in == 0:
        yield Finding("missing-key", "needs built_in: the wall holds the ends of treads that reach into it", "wall")
    if stair.joint is not None and stair.foot != "ground":
        yield Finding("key-of-another-choice", "applies with foot: ground only", "joint")
