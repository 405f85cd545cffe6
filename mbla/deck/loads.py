"""Sections `loads` and `load_cases`: loads that stay, and loads that the load factor multiplies."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import Discriminator, Field, Tag

from mbla.deck.names import Name
from mbla.deck.quantities import (
    Acceleration,
    Direction,
    FacingAngle,
    Force,
    ForcePerLength,
    Length,
    Moment,
    Number,
    Point,
    Positions,
    PositiveLength,
    Stress,
    UnitWeight,
)
from mbla.deck.section import Section
from mbla.deck.selectors import Selector
from mbla.deck.supports import Turn


class HeightPattern(Section):
    """How an acceleration grows along a direction: linearly from 0 at base to 1 at top, or through points.

    Every part of a block has the factor of its own height, so that it does not matter how a structure is divided into
    blocks; an added mass that of the place where it is.
    """

    along: Direction = Field((0.0, 0.0, 1.0), description="direction along which heights are measured, from the origin")
    base: Length | None = Field(
        None, description="height of factor 0, as below it; lowest point of the blocks loaded unless given"
    )
    top: Length | None = Field(
        None, description="height of factor 1, as above it; highest point of the blocks loaded unless given"
    )
    points: list[tuple[Length, Number]] | None = Field(
        None,
        min_length=2,
        description="instead of base and top: heights and factors, straight lines between, constant beyond the ends",
    )


class LineLoad(Section):
    """A load along a straight line, carried by the blocks that lie under it."""

    from_: Point = Field(alias="from", description="beginning of the line")
    to: Point = Field(description="end of the line")
    force_per_length: tuple[ForcePerLength, ForcePerLength, ForcePerLength] = Field(
        description="force per length of the line; it acts where the line is drawn, with its moment"
    )
    towards: Direction = Field(
        (0.0, 0.0, -1.0), description="direction in which the blocks under the line are looked for"
    )


class PressureLoad(Section):
    """Pressure on faces: the same everywhere, or growing with depth below a level, and none above it."""

    value: Stress = Field(0.0, description="pressure, at the level if there is one; positive pushes against the face")
    level: Length | None = Field(None, description="height z above which there is no pressure")
    per_depth: UnitWeight | None = Field(None, description="increase of the pressure with the depth below the level")
    normal: Direction | None = Field(None, description="outward normal of the faces; every face unless given")
    within: FacingAngle = Field(10.0, description="greatest angle between the normal of a face and that, in degrees")
    box: tuple[Point, Point] | None = Field(
        None, description="least and greatest coordinates: faces whose centroid lies inside"
    )
    faces: Literal["free", "all"] = Field(
        "free", description="free: only what of a face no other block and no ground covers; all: covered parts too"
    )


class Axle(Section):
    """A force that follows the first one of a travelling load."""

    behind: PositiveLength = Field(description="distance behind the first force, along the path")
    force: tuple[Force, Force, Force] = Field(description="the force; it acts where the path is drawn, with its moment")


class Travel(Section):
    """A force, or several in a row, along a path: a load case for each position, and the worst of them."""

    force: tuple[Force, Force, Force] = Field(description="the force; it acts where the path is drawn, with its moment")
    path: list[Point] = Field(min_length=2, description="corners of the path")
    positions: Positions = Field(
        description="positions at equal distances along the path, its ends among them; with axles from the first force "
        "at the beginning of the path to the last axle at its end"
    )
    axles: list[Axle] | None = Field(
        None,
        min_length=1,
        max_length=100,
        description="forces that follow the first one, as the axles of a lorry; none acts before it is on the path and "
        "beyond its end",
    )
    towards: Direction = Field((0.0, 0.0, -1.0), description="direction in which the block under it is looked for")


class Tilt(Section):
    """Tilting table: the structure turns with its supports until it collapses; the answer is an angle."""

    axis: Direction = Field(
        description="axis about which the table turns, by the right hand: about [0, 1, 0] it tips towards +x"
    )


Gravity: TypeAlias = Annotated[
    Annotated[Literal["none"], Tag("name")] | Annotated[tuple[Acceleration, Acceleration, Acceleration], Tag("list")],
    Discriminator(lambda value: "name" if isinstance(value, str) else "list"),
]


class Load(Section):
    """One load of exactly one kind; dead or live, save `travel` and `tilt`, which are live only."""

    gravity: Gravity | None = Field(
        None,
        description="gravitational acceleration, in the deck's unit of length per s^2, in place of 9.81 m/s^2 along "
        "-z; `none` among the dead loads of a structure without weight",
    )
    acceleration: Direction | None = Field(
        None, description="mass-proportional load in units of g = 9.81 m/s^2, pointing where it pushes"
    )
    force: tuple[Force, Force, Force] | None = Field(None, description="force on one block")
    moment: tuple[Moment, Moment, Moment] | None = Field(None, description="moment on one block")
    line: LineLoad | None = Field(None, description="load along a line")
    pressure: PressureLoad | None = Field(None, description="pressure on faces")
    loads: Name | None = Field(None, description="the loads of that name in section loads, all of them")
    travel: Travel | None = Field(None, description="force at one position after the other")
    tilt: Tilt | None = Field(None, description="gravity turns; the only load of its list")
    table: str | None = Field(
        None,
        min_length=1,
        description="CSV file, relative to the deck: a header line with the columns group,index,fx,fy,fz, optionally "
        "x,y,z (where the force acts; the centroid unless given) and mx,my,mz (moment); then a row for each force",
    )
    on: Selector | None = Field(
        None,
        description="force, moment: the block; other kinds: the only blocks that they may act on, all unless given",
    )
    at: Point | None = Field(
        None, description="point of application, carried with its moment; the centroid unless given"
    )
    pattern: HeightPattern | None = Field(None, description="acceleration: factor by height; 1 everywhere unless given")
    factor: Number = Field(1.0, description="factor on the load")


class SettlementSection(Section):
    """A support that gives way: blocks that `supports` fixes move as one rigid body, in one way only."""

    on: Selector = Field(description="the blocks that give way; `supports` fixes them otherwise")
    direction: Direction | None = Field(
        None, description="the way they go: [0, 0, -1] for a support that sinks, horizontal for one that spreads"
    )
    turn: Turn | None = Field(None, description="or the line about which they turn")


class LoadCaseSection(Section):
    """Dead loads stay, live loads are multiplied by the load factor; or a support gives way under the dead loads."""

    dead: list[Load] | None = Field(
        None, description="what acts beside gravity, which is 9.81 m/s^2 along -z unless a load `gravity` is among them"
    )
    live: list[Load] | None = Field(None, min_length=1, description="the loads that the load factor multiplies")
    settlement: SettlementSection | None = Field(
        None,
        description="in place of live: a support that gives way, free of other supports; the answer is the mechanism "
        "and the reaction with which the support meets it, the least that equilibrium allows; negative where the "
        "support must be pushed that way, as with springings that close in. The load factor is the loss of reaction, "
        "from that of the structure at rest on, over the weight of the free blocks",
    )
