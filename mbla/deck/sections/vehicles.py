"""Section `vehicles`: forces in a row, which loads stand or let travel."""

from __future__ import annotations

from pydantic import Field

from mbla.deck.quantities import Force, PositiveLength
from mbla.deck.section import Section

WIDTH = "each force is shared evenly over this length across the way of the vehicle, half to each side; unless given it"
TOWARDS = "direction in which the blocks under it are sought; straight down in fill"
DOWN = (0.0, 0.0, -1.0)


class Axle(Section):
    """A force that follows the first one of a vehicle."""

    behind: PositiveLength = Field(description="distance behind the first force, along the path")
    force: tuple[Force, Force, Force] = Field(description="the force; it acts where the path is drawn, with its moment")


class Vehicle(Section):
    """The axles of a vehicle by their forces and distances; loads `travel` and `vehicle` name it."""

    force: tuple[Force, Force, Force] = Field(description="force of the first axle")
    axles: list[Axle] = Field(default_factory=list, max_length=100, description="the axles behind it")
    width: PositiveLength | None = Field(None, description=f"{WIDTH} acts at a point")
