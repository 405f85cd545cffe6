"""Section `vehicles`, and the loads that stand or travel: a force, or the axles of a vehicle in a row."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from pydantic import Field

from mbla.deck.quantities import Direction, Force, Name, Point, Positions, PositiveLength
from mbla.deck.section import Section, exactly_one_of, given, rule
from mbla.errors import Finding

AXLES = (
    "forces that follow the first one, as the axles of a lorry; none acts before it is on the path and beyond its end"
)
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


@exactly_one_of("force", "vehicle")
class Travel(Section):
    """A force, or several in a row, along a path: a load case for each position, and the worst of them."""

    force: tuple[Force, Force, Force] | None = Field(
        None, description="the force; it acts where the path is drawn, with its moment"
    )
    vehicle: Name | None = Field(None, description="or a vehicle of section vehicles")
    path: list[Point] = Field(min_length=2, description="corners of the path")
    positions: Positions = Field(
        description="positions at equal distances along the path, its ends among them; with axles from the first force "
        "at the beginning of the path to the last axle at its end"
    )
    axles: list[Axle] | None = Field(None, min_length=1, max_length=100, description=AXLES)
    width: PositiveLength | None = Field(None, description=f"{WIDTH} acts at a point")
    towards: Direction = Field(DOWN, description=TOWARDS)


class VehicleLoad(Section):
    """A vehicle that stands on the structure, or on fill."""

    name: Name = Field(description="which of section vehicles")
    at: Point = Field(description="where its first axle stands")
    along: Direction = Field(
        (1.0, 0.0, 0.0), description="the way that it looks: the other axles stand behind the first one"
    )
    towards: Direction = Field(DOWN, description=TOWARDS)


@rule(Travel)
def travel(load: Travel) -> Iterator[Finding]:
    """A path goes on; a vehicle has axles of its own."""
    for number, (before, here) in enumerate(pairwise(load.path), start=1):
        if before == here:
            yield Finding("degenerate-line", "must not be the corner before it", "path", number)
    if load.vehicle is not None:
        for key in given(load, ("axles", "width")):
            yield Finding("key-of-another-choice", f"belongs to vehicles.{load.vehicle}: give it there", key)
