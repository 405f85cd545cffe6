"""What walls have in common: units, bond, openings, gables, buttresses."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mbla.deck.items.item import Item
from mbla.deck.names import Name
from mbla.deck.quantities import (
    Count,
    EmbraceAngle,
    Index,
    Length,
    NonNegativeLength,
    PlanePoint,
    PositiveLength,
    Quantity,
    Switch,
    Whole,
)
from mbla.deck.section import Section


class Lintel(Section):
    """One block over an opening, through the whole wall; the courses beside it are cut around it."""

    bearing: PositiveLength = Field(description="length that rests on the wall at either side")
    courses: Count = Field(1, description="its height in courses")
    material: Name | None = Field(None, description="name of a material; that of the wall unless given")


class OpeningArch(Section):
    """Arch over an opening with a level top, joints towards one centre and skewbacks cut into the courses beside it."""

    voussoirs: Annotated[int, Whole(ge=2, le=10_000)] = Field(description="number of voussoirs")
    courses: Count = Field(1, description="its height above the springing, in courses")
    rise: NonNegativeLength = Field(0.0, description="of the intrados; 0: a flat arch, else a segment of a circle")
    embrace: EmbraceAngle | None = Field(
        None, description="of a flat arch: degrees between its end joints, below 180; 60 unless given"
    )
    material: Name | None = Field(None, description="name of a material; that of the wall unless given")


class Opening(Section):
    """Rectangular opening in the plane of a wall, its bottom and top on bed joints."""

    from_: PlanePoint = Field(alias="from", description="lower corner: distance along the wall, height")
    to: PlanePoint = Field(description="upper corner: distance along the wall, height")
    lintel: Lintel | None = Field(None, description="a block that spans the opening")
    arch: OpeningArch | None = Field(None, description="an arch that spans the opening, from its upper corners")


class Headers(Section):
    """Through-stones that tie the leaves of a running or stack bond."""

    every: Annotated[int, Whole(ge=1, le=1_000_000)] = Field(
        description="the last of every so many courses has headers"
    )
    spacing: Annotated[int, Whole(ge=1, le=1_000_000)] = Field(
        description="one of every so many units of it is a header, staggered from one such course to the next"
    )


class Irregular(Section):
    """Random units, the same on every machine: numpy's PCG64 generator, seeded."""

    seed: Index = Field(description="another number, another wall")
    variation: Annotated[float, Quantity("number", ge=0, le=0.5)] = Field(
        description="of the lengths of units, as a share of the length: uniform between 1 - variation and 1 + variation"
    )
    heights: Annotated[float, Quantity("number", ge=0, le=0.5)] = Field(
        0.0, description="the same of the heights of courses; heads and sills of openings stay where they are"
    )
    overlap: Annotated[float, Quantity("number", gt=0, le=0.25)] = Field(
        0.2, description="least distance of perpends from those of the course below, as a share of the unit length"
    )


class Gable(Section):
    """Triangle on top of a wall, over its whole length, the courses cut to its slopes."""

    rise: PositiveLength = Field(description="height of the apex above the top of the wall")
    apex: Length | None = Field(None, description="distance of the apex along the wall; the middle unless given")


class Buttress(Section):
    """Pier against a face of a wall, as high as the wall unless its courses are given."""

    at: Length = Field(description="distance of its nearer edge along the wall")
    width: PositiveLength = Field(description="along the wall")
    depth: PositiveLength = Field(description="out from the face of the wall")
    side: Literal["front", "back"] = Field(
        "back",
        description="face that it stands against: front is that at least y, of a plan that to the right of the line",
    )
    courses: Count | None = Field(None, description="height of its level part; that of the wall less the slope")
    bonded: Switch = Field(True, description="true: odd courses run through the wall; false: it stands against it")
    slope: NonNegativeLength = Field(
        0.0, description="height over which the top slopes back to the face, a whole number of courses; 0: level top"
    )


BondName = Literal["running", "stretcher", "stack", "english", "flemish", "header"]


class Masonry(Item):
    """Keys of all walls."""

    unit: tuple[PositiveLength, PositiveLength, PositiveLength] = Field(
        description="length along the wall, thickness, height of one unit"
    )
    courses: Count = Field(description="number of courses")
    leaves: Annotated[int, Whole(ge=1, le=100)] = Field(
        1, description="thickness of the wall in units; without headers the leaves are not bonded"
    )
    bond: BondName = Field(
        "running",
        description="running or stretcher: odd courses shifted by half a unit; stack: none shifted; of two leaves or "
        "more, whose headers are units laid across: english: courses of stretchers and headers in turn; flemish: "
        "stretcher and header in turn, headers centred on the stretchers below; header: headers only",
    )
    start: Literal["full", "half"] = Field(
        "full", description="first unit of the bottom course; half is a header in english and flemish bond"
    )
    headers: Headers | None = Field(None, description="through-stones of a running or stack bond; none by default")
    irregular: Irregular | None = Field(None, description="random lengths of units, of a running bond")
