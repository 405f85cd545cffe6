"""Section `vehicles`: forces in a row, which loads stand or let travel."""

from __future__ import annotations

from pydantic import Field

from mbla.deck.quantities import Force, PositiveLength
from mbla.deck.section import Section

WIDTH = (
    "length across the way of the vehicle over which each force is shared evenly, half to each side; "
    "default: it acts at a point"
)
TOWARDS = "direction from the load to the blocks under it; straight down in fill"
DOWN = (0.0, 0.0, -1.0)


class Axle(Section):
    """A force that follows the first one of a vehicle."""

    behind: PositiveLength = Field(description="distance behind the first force, along the path")
    force: tuple[Force, Force, Force] = Field(description="the force; it acts where the path is drawn, with its moment")


class Vehicle(Section):
    """The axles of a vehicle by their forces and distances; loads `travel` and `vehicle` name it."""

    force: tuple[Force, Force, Force] = Field(description="force of the first axle")
    axles: list[Axle] = Field(default_factory=list, max_length=100, description="the axles behind it")
    width: PositiveLength | None = Field(None, description=WIDTH)
