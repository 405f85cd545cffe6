"""What walls have in common: units, bond, openings, gables, buttresses."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Annotated, Literal

from pydantic import Field

from mbla.deck.quantities import (
    Count,
    EmbraceAngle,
    Index,
    Integer,
    Length,
    Name,
    NonNegativeLength,
    PlanePoint,
    PositiveLength,
    RealNumber,
    Switch,
)
from mbla.deck.section import ROUNDING, Section, rule
from mbla.errors import Finding
from mbla.model.blocks.item import AnyItem


class Lintel(Section):
    """One block over an opening, through the full wall; the courses next to it are cut around it."""

    bearing: PositiveLength = Field(description="length that rests on the wall at either side")
    courses: Count = Field(1, description="its height in courses")
    material: Name | None = Field(None, description="name of a material; default: material of the wall")


class OpeningArch(Section):
    """Arch over an opening with a level top, joints towards one centre and skewbacks cut into the adjacent courses."""

    voussoirs: Annotated[int, Integer(ge=2, le=10_000)] = Field(description="number of voussoirs")
    courses: Count = Field(1, description="its height above the springing, in courses")
    rise: NonNegativeLength = Field(0.0, description="of the intrados; 0: a flat arch, else a segment of a circle")
    embrace: EmbraceAngle | None = Field(
        None, description="of a flat arch: degrees between its end joints, below 180; default: 60"
    )
    material: Name | None = Field(None, description="name of a material; default: material of the wall")


class Opening(Section):
    """Rectangular opening in the plane of a wall, its bottom and top on bed joints."""

    from_: PlanePoint = Field(alias="from", description="lower corner: distance along the wall, height")
    to: PlanePoint = Field(description="upper corner: distance along the wall, height")
    lintel: Lintel | None = Field(None, description="a block that spans the opening")
    arch: OpeningArch | None = Field(None, description="an arch that spans the opening, from its upper corners")


class Headers(Section):
    """Through-stones that tie the leaves of a running or stack bond."""

    every: Annotated[int, Integer(ge=1, le=1_000_000)] = Field(description="n: every n-th course has headers")
    spacing: Annotated[int, Integer(ge=1, le=1_000_000)] = Field(
        description="n: every n-th unit of it is a header, staggered from one such course to the next"
    )


class Irregular(Section):
    """Random units, the same on every machine: numpy's PCG64 generator, seeded."""

    seed: Index = Field(description="another number, another wall")
    variation: Annotated[float, RealNumber("number", ge=0, le=0.5)] = Field(
        description="of the lengths of units, as a share of the length: uniform between 1 - variation and 1 + variation"
    )
    heights: Annotated[float, RealNumber("number", ge=0, le=0.5)] = Field(
        0.0, description="the same of the heights of courses; heads and sills of openings stay where they are"
    )
    overlap: Annotated[float, RealNumber("number", gt=0, le=0.25)] = Field(
        0.2, description="least distance of perpends from those of the course below, as a share of the unit length"
    )


class Gable(Section):
    """Triangle on top of a wall, over its full length, the courses cut to its slopes."""

    rise: PositiveLength = Field(description="height of the apex above the top of the wall")
    apex: Length | None = Field(None, description="distance of the apex along the wall; default: the middle")


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
        0.0, description="height over which the top slopes back to the face, an integer number of courses; 0: level top"
    )


MATERIALS = ("openings.#.lintel.material", "openings.#.arch.material")
"""key paths below a wall that name materials"""
BondName = Literal["running", "stretcher", "stack", "english", "flemish", "header"]


class Masonry(AnyItem):
    """Keys of all walls."""

    unit: tuple[PositiveLength, PositiveLength, PositiveLength] = Field(
        description="length along the wall, thickness, height of one unit"
    )
    courses: Count = Field(description="number of courses")
    leaves: Annotated[int, Integer(ge=1, le=100)] = Field(
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


BONDED = ("english", "flemish", "header")
"""bonds with headers of their own"""


@rule(Masonry)
def check_bond(wall: Masonry) -> Iterator[Finding]:
    """Headers go through a wall of several leaves; random units are those of a running bond."""
    length, thickness, _ = wall.unit
    if wall.bond in BONDED:
        across = wall.leaves * thickness
        if wall.leaves == 1:
            yield Finding(
                "out-of-bounds", f"must be >= 2 in {wall.bond} bond, whose headers lie across the leaves", "leaves"
            )
        elif abs(length - across) > ROUNDING * across:
            words = f"must be {across:g} in {wall.bond} bond: a unit laid across goes through all leaves"
            yield Finding("out-of-bounds", words, "unit", 0)
        if wall.headers is not None:
            words = f"applies to running and stack bond: {wall.bond} bond has headers of its own"
            yield Finding("key-of-another-choice", words, "headers")
    elif wall.headers is not None and wall.leaves == 1:
        yield Finding("missing-key", "needs leaves >= 2 that they tie", "headers")
    if wall.irregular is not None:
        if wall.bond not in ("running", "stretcher"):
            yield Finding("key-of-another-choice", f"applies to running bond only, here is {wall.bond}", "irregular")
        if wall.start != "full":
            yield Finding("key-of-another-choice", "has no meaning with random units: leave it out", "start")


def check_opening(wall: Masonry, opening: Opening, length: float) -> Iterator[Finding]:
    """An opening has an extent and lies within the wall, as does what spans it; key paths below it."""
    height = wall.unit[2]
    limits = (length, wall.courses * height)
    for axis, (limit, what) in enumerate(zip(limits, ("length", "height"), strict=True)):
        low, high = opening.from_[axis], opening.to[axis]
        if not low < high:
            yield Finding("out-of-bounds", f"must be > {low:g}, that of from", "to", axis)
        if low < -ROUNDING * limit:
            yield Finding("out-of-bounds", "must be >= 0: the opening must lie within the wall", "from", axis)
        if high > limit * (1 + ROUNDING):
            yield Finding("out-of-bounds", f"must be <= {limit:g}, the {what} of the wall", "to", axis)
    if opening.arch is not None and opening.arch.rise > 0:
        path = ("arch", "rise")
        room, half = opening.arch.courses * height, (opening.to[0] - opening.from_[0]) / 2
        if opening.arch.rise >= min(room, half):
            words = f"must be < {min(room, half):g}: half the opening, and the height of the arch in courses"
            yield Finding("out-of-bounds", words, *path)
        elif not opening.arch.rise / half:
            yield Finding("out-of-bounds", f"is too small for half the opening, {half:g}: make it larger", *path)


def check_gable(wall: Masonry, gable: Gable, length: float) -> Iterator[Finding]:
    """The apex is above the wall; key paths below the gable."""
    if gable.apex is not None and not -ROUNDING * length <= gable.apex <= length * (1 + ROUNDING):
        yield Finding("out-of-bounds", f"must be between 0 and {length:g}, the length of the wall", "apex")


def check_buttress(wall: Masonry, buttress: Buttress, length: float) -> Iterator[Finding]:
    """A buttress is as long as the wall at most, and as high; key paths below it."""
    if buttress.at < -ROUNDING * length:
        yield Finding("out-of-bounds", "must be >= 0: the buttress must lie within the wall", "at")
    elif buttress.at + buttress.width > length * (1 + ROUNDING):
        yield Finding(
            "out-of-bounds", f"must be <= {length - buttress.at:g}, so that the buttress ends within the wall", "width"
        )
    sloped = buttress.slope / wall.unit[2]
    if not math.isfinite(sloped) or abs(sloped - round(sloped)) > ROUNDING * max(sloped, 1.0):
        yield Finding("out-of-bounds", f"must be an integer number of courses of {wall.unit[2]:g}", "slope")
    elif buttress.courses is None and round(sloped) >= wall.courses:
        yield Finding("wall-shape", "must leave a level part: it is as high as the wall", "slope")
    elif buttress.courses is not None and buttress.courses + round(sloped) > wall.courses:
        words = f"must be <= {wall.courses - round(sloped)}: with its slope it ends at the top of the wall"
        yield Finding("out-of-bounds", words, "courses")


def check_part(wall: Masonry, part: Opening | Gable | Buttress, length: float) -> Iterator[Finding]:
    """What belongs to a wall of some length; key paths below the part."""
    if isinstance(part, Opening):
        return check_opening(wall, part, length)
    return check_gable(wall, part, length) if isinstance(part, Gable) else check_buttress(wall, part, length)


@rule(Opening)
def one_span(opening: Opening) -> Iterator[Finding]:
    """A lintel or an arch."""
    if opening.lintel is not None and opening.arch is not None:
        yield Finding("one-of-several", "only one of lintel and arch may be given", "arch")


@rule(OpeningArch)
def arch_of_opening(arch: OpeningArch) -> Iterator[Finding]:
    """The embrace of a segment of a circle follows from its rise."""
    if arch.embrace is None:
        return
    if arch.rise > 0:
        words = "applies to flat arches: that of a segment of a circle follows from its rise"
        yield Finding("key-of-another-choice", words, "embrace")
    elif arch.embrace >= 180:
        yield Finding("out-of-bounds", "must be < 180: the end joints of a flat arch meet below it", "embrace")


def units_of_walls(item: Masonry, length: float, gable: float, buttresses: Sequence[Buttress]) -> float:
    """Units of walls of some length together, the highest gable a rise above them."""
    unit, width, height = item.unit
    along = item.leaves * max(length / min(unit, width if item.leaves > 1 else unit), 1.0)
    across = sum(max((buttress.depth + item.leaves * width) / unit, 1.0) for buttress in buttresses)
    return (item.courses + gable / height) * (along + across)
