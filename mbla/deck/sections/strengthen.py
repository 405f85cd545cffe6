"""Section `strengthen`: ties that ``mbla strengthen`` may add, and load factors that the structure has to carry."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from mbla.deck.quantities import (
    Direction,
    Length,
    Name,
    NonNegativeNumber,
    Point,
    PositiveForce,
    PositiveLength,
    PositiveNumber,
)
from mbla.deck.section import Section, exactly_one_of, rule
from mbla.deck.sections.selectors import Selector
from mbla.deck.sections.ties import Ring, blocks_of_points
from mbla.errors import Finding

PATTERNS = ("across", "ring", "vertical", "through")
"""what lays out candidates"""


class Across(Section):
    """Ties from wall to wall through a room, from outer face to outer face, on a grid over both walls."""

    between: tuple[Selector, Selector] = Field(description="the two walls")
    along: Direction | None = Field(
        None, description="direction of the ties; default: the axis along which the walls lie furthest apart"
    )
    z: Annotated[list[Length], Field(min_length=1)] = Field(description="heights, such as those of floors")
    every: PositiveLength = Field(description="distance between them along the walls; none where they miss a block")
    pairs: Literal["opposite", "all"] = Field(
        "opposite", description="opposite: straight across; all: from each place at one wall to each at the other"
    )


class Vertical(Section):
    """Bars from the tops of walls down to their foundations."""

    down: Selector = Field(description="the blocks that they go through, from the highest at each place")
    every: PositiveLength = Field(description="distance between them, along x and y")


@exactly_one_of(*PATTERNS)
class Candidate(Section):
    """Ties that may be added, each with a capacity from nothing to `most`."""

    name: Name | None = Field(None, description="name of the ties; default: the pattern")
    across: Across | None = Field(None, description="from wall to wall")
    ring: Ring | None = Field(None, description="round a building, one at each height")
    vertical: Vertical | None = Field(None, description="down to the foundation")
    through: Annotated[list[Point], Field(min_length=2, max_length=1000)] | None = Field(
        None, description="one tie, as of ties"
    )
    on: Annotated[list[Selector], Field(min_length=2, max_length=1000)] | None = Field(
        None, description="through: the block of each point, or ground, as of ties"
    )
    cost: PositiveNumber = Field(1.0, description="of a unit of capacity over a unit of length, in any currency")
    most: PositiveForce | None = Field(None, description="greatest capacity, also once rounded up; default: any")


class StrengthenSection(Section):
    """Question of `mbla strengthen`: the cheapest capacities with which the structure carries all load cases."""

    required: dict[Name, NonNegativeNumber] = Field(
        min_length=1, description="load factor that each load case has to carry"
    )
    candidates: list[Candidate] = Field(min_length=1, description="what may be added")
    catalogue: Annotated[list[PositiveForce], Field(min_length=1)] | None = Field(
        None,
        description="capacities that can be bought, to which those found are rounded up; above the greatest, of "
        "capacities up to `most`, to the least sum of several ties side by side; default: any capacity",
    )


rule(Candidate)(blocks_of_points)


@rule(StrengthenSection)
def catalogue(section: StrengthenSection) -> Iterator[Finding]:
    """Capacities ascend; what is limited may have one of them."""
    values = section.catalogue or []
    for number in range(1, len(values)):
        if values[number] <= values[number - 1]:
            yield Finding("out-of-bounds", f"must be > {values[number - 1]:g}, the one before", "catalogue", number)
    for number, item in enumerate(section.candidates):
        if values and item.most is not None and item.most < min(values):
            words = f"must be >= {min(values):g}, the least of the catalogue"
            yield Finding("out-of-bounds", words, "candidates", number, "most")
