"""Section `vehicles`: forces in a row, which loads stand or let travel."""

from __future__ import annotations

from collections.abc import Iterator

from pydantic import Field

from mbla.deck.quantities import Force, PositiveLength
from mbla.deck.section import Section, rule
from mbla.errors import Finding

WIDTH = (
    "length across the way of the vehicle over which each force is shared evenly, half to each side; "
    "default: it acts at a point"
)
CONTACT = (
    "length along the way over which each force is shared evenly, half before its place and half behind it, with "
    "width on a rectangle; in fill in place of `contact` of its dispersal; on soil of cells needed; default: none"
)
TOWARDS = "direction from the load to the blocks under it; straight down in fill"
DOWN = (0.0, 0.0, -1.0)


class Axle(Section):
    """A force that follows the first one of a vehicle."""

    behind: PositiveLength = Field(description="distance behind the first force, along the path")
    force: tuple[Force, Force, Force] = Field(description="the force; it acts where the path is drawn, with its moment")


class Wheels(Section):
    """Two wheels, one at each end of an axle, each with half of its force."""

    gauge: PositiveLength = Field(description="distance of the wheels across the way, from middle to middle")
    contact: tuple[PositiveLength, PositiveLength] | None = Field(
        None,
        description="sides, along and across the way, of the rectangle on which each wheel stands; in fill in place of "
        "`contact` of its dispersal; on soil of cells needed; default: it stands on a point",
    )


class Vehicle(Section):
    """The axles of a vehicle by their forces and distances; loads `travel` and `vehicle` name it."""

    force: tuple[Force, Force, Force] = Field(description="force of the first axle")
    axles: list[Axle] = Field(default_factory=list, max_length=100, description="the axles behind it")
    width: PositiveLength | None = Field(None, description=WIDTH)
    contact: PositiveLength | None = Field(None, description=CONTACT)
    wheels: Wheels | None = Field(None, description="or wheels: where across its way each axle stands")


@rule(Vehicle)
def width_or_wheels(vehicle: Vehicle) -> Iterator[Finding]:
    """An axle is shared over a width, or stands on wheels."""
    if vehicle.width is not None and vehicle.wheels is not None:
        yield Finding("key-of-another-choice", "give width or wheels: each says how the axles are shared", "width")
    if vehicle.contact is not None and vehicle.wheels is not None:
        words = "is that of axles without wheels: give that of wheels, along and across, as wheels: {contact: [.., ..]}"
        yield Finding("key-of-another-choice", words, "contact")
