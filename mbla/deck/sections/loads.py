"""Sections `loads` and `masses`, and the loads of `load_cases`."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Annotated, Literal, TypeAlias

from pydantic import Discriminator, Field, Tag

from mbla.deck.quantities import (
    Acceleration,
    Box,
    Direction,
    FacingAngle,
    Force,
    ForcePerLength,
    Length,
    Moment,
    Name,
    Number,
    Point,
    PositiveMass,
    Stress,
    UnitWeight,
    Vector,
    WallFrictionAngle,
)
from mbla.deck.section import EXACTLY_ONE, Section, exactly_one_of, given, rule
from mbla.deck.sections.selectors import Selector
from mbla.deck.sections.vehicles import Travel, VehicleLoad
from mbla.deck.suggestions import listed
from mbla.errors import Finding

PARALLEL = 1e-6
"""sine of the angle between a line and the direction to its blocks, up to which they are parallel"""
NEEDS_BLOCK = ("force", "moment")
"""kinds of loads that act on one block, which `on` names"""
ON_ALL_BLOCKS = {"gravity": "acts on all blocks: use acceleration", "tilt": "turns the whole structure"}
"""kinds that `on` does not apply to, and why"""
THROUGH_FILL = ("line", "vehicle", "travel")
"""kinds that may stand on fill"""
FOLLOWERS = ("force", "moment", "line", "pressure", "travel")
"""kinds that may turn with their block in a pushover"""
LIVE_ONLY = ("travel", "tilt")
"""kinds that make something else of a load case than a sum of loads"""


class HeightPattern(Section):
    """How an acceleration grows along a direction: linearly from 0 at base to 1 at top, or through points.

    Every part of a block has the factor of its own height, so that it does not matter how a structure is divided into
    blocks; an added mass that of the place where it is, and fill that of its own heights.
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


@rule(HeightPattern)
def height_pattern(pattern: HeightPattern) -> Iterator[Finding]:
    """From base to top, or through points with rising heights."""
    for key in given(pattern, ("base", "top")) if pattern.points is not None else []:
        yield Finding("key-of-another-choice", "does not apply together with points", key)
    if pattern.base is not None and pattern.top is not None and not pattern.base < pattern.top:
        yield Finding("out-of-bounds", f"must be > {pattern.base:g}, the base", "top")
    heights = [height for height, _ in pattern.points or []]
    for number, (below, above) in enumerate(pairwise(heights), start=1):
        if not below < above:
            yield Finding("out-of-bounds", f"must be > {below:g}, the height before it", "points", number, 0)


class LineLoad(Section):
    """A load along a straight line, carried by the blocks that lie under it."""

    from_: Point = Field(alias="from", description="beginning of the line")
    to: Point = Field(description="end of the line")
    force_per_length: tuple[ForcePerLength, ForcePerLength, ForcePerLength] = Field(
        description="force per length of the line; it acts where the line is drawn, with its moment"
    )
    towards: Direction = Field((0.0, 0.0, -1.0), description="direction in which the blocks under the line are sought")


@rule(LineLoad)
def line_load(line: LineLoad) -> Iterator[Finding]:
    """A line has a length, and its blocks lie aside of it."""
    run = [end - begin for begin, end in zip(line.from_, line.to, strict=True)]
    if not any(run):
        yield Finding("degenerate-line", "must not be the point from: the line has no length", "to")
    elif _parallel(run, line.towards):
        yield Finding(
            "degenerate-line", "must not run along the line: give the direction in which its blocks lie", "towards"
        )


def _parallel(a: list[float], b: tuple[float, ...]) -> bool:
    """Whether two vectors have one direction, or opposite ones; free of overflow."""
    u, v = ([each / max(map(abs, vector)) for each in vector] for vector in (a, b))
    cross = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    return sum(each**2 for each in cross) <= PARALLEL**2 * sum(each**2 for each in u) * sum(each**2 for each in v)


class PressureLoad(Section):
    """Pressure on faces: the same everywhere, or growing with depth below a level, and none above it.

    Earth pressure of soil with the unit weight γ, whose top is the `level` and carries q per area: `value` K q,
    `per_depth` K γ, `wall_friction` δ, with the coefficient K of the pressure that is normal to the wall. Coulomb's
    coefficient K_a, which is that of the whole pressure, inclined by δ, is to be multiplied by cos δ.
    """

    value: Stress = Field(
        0.0,
        description="pressure normal to the face, at the level if there is one; positive pushes against the face",
    )
    level: Length | None = Field(None, description="height z above which there is no pressure")
    per_depth: UnitWeight | None = Field(None, description="increase of the pressure with the depth below the level")
    wall_friction: WallFrictionAngle = Field(
        0.0,
        description="angle δ between what acts on the face and its normal, in degrees: the pressure p drags the face "
        "with p tan δ besides, straight down its slope, as soil does that settles along a wall; up where δ is negative",
    )
    normal: Direction | None = Field(None, description="outward normal of the faces; every face unless given")
    within: FacingAngle = Field(10.0, description="greatest angle between the normal of a face and that, in degrees")
    box: Box | None = Field(None, description="least and greatest coordinates: faces whose centroid lies inside")
    faces: Literal["free", "all"] = Field(
        "free", description="free: only what of a face no other block and no ground covers; all: covered parts too"
    )


@rule(PressureLoad)
def pressure_load(pressure: PressureLoad) -> Iterator[Finding]:
    """A depth needs a level, an angle a normal."""
    if pressure.per_depth is not None and pressure.level is None:
        yield Finding("missing-key", "needs a level from which depth is measured", "per_depth")
    if "within" in pressure.model_fields_set and pressure.normal is None:
        yield Finding("key-of-another-choice", "applies with normal only", "within")
    if not {"value", "per_depth"} & pressure.model_fields_set:
        yield Finding("missing-key", "needs a value, or a level and per_depth")


class Tilt(Section):
    """Tilting table: the structure turns with its supports until it collapses; the answer is an angle."""

    axis: Direction = Field(
        description="axis about which the table turns, by the right hand: about [0, 1, 0] it tips towards +x"
    )


Gravity: TypeAlias = Annotated[
    Annotated[Literal["none"], Tag("name")] | Annotated[tuple[Acceleration, Acceleration, Acceleration], Tag("list")],
    Discriminator(lambda value: "name" if isinstance(value, str) else "list"),
]


KINDS = (
    "gravity",
    "acceleration",
    "force",
    "moment",
    "line",
    "pressure",
    "vehicle",
    "table",
    "loads",
    "travel",
    "tilt",
)


@exactly_one_of(*KINDS)
class Load(Section):
    """One load of exactly one kind; dead or live, save `travel` and `tilt`, which are live only."""

    gravity: Gravity | None = Field(
        None,
        description="gravitational acceleration, in the deck's unit of length per s^2, in place of 9.81 m/s^2 along "
        "-z; `none` among the dead loads of a structure without weight",
    )
    acceleration: Vector | None = Field(
        None, description="mass-proportional load in units of g = 9.81 m/s^2, pointing where it pushes"
    )
    force: tuple[Force, Force, Force] | None = Field(None, description="force on one block")
    moment: tuple[Moment, Moment, Moment] | None = Field(None, description="moment on one block")
    line: LineLoad | None = Field(None, description="load along a line")
    pressure: PressureLoad | None = Field(None, description="pressure on faces")
    vehicle: VehicleLoad | None = Field(None, description="a vehicle that stands")
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
    through: Name | None = Field(
        None,
        description="line, vehicle, travel: the fill on which they stand, straight over or under where they are drawn, "
        "and in which they spread; their forces are vertical",
    )
    at: Point | None = Field(
        None, description="point of application, carried with its moment; the centroid unless given"
    )
    pattern: HeightPattern | None = Field(None, description="acceleration: factor by height; 1 everywhere unless given")
    factor: Number = Field(1.0, description="factor on the load")
    follows: bool = Field(
        False,
        description="in a pushover: the load turns with its block, as a pressure does; else it keeps its direction. Of "
        "force, moment, line, pressure and travel",
    )


@rule(Load)
def load_keys(load: Load) -> Iterator[Finding]:
    """Where a load acts, as far as that applies."""
    kind = next(iter(given(load, EXACTLY_ONE[Load])), "")
    if kind in NEEDS_BLOCK and load.on is None:
        yield Finding("one-block-only", f"a {kind} needs `on`, the block it acts on")
    if load.at is not None and kind != "force":
        yield Finding("key-of-another-choice", "applies to a force only", "at")
    if load.on is not None and kind in ON_ALL_BLOCKS:
        yield Finding("key-of-another-choice", f"does not apply to {kind}, which {ON_ALL_BLOCKS[kind]}", "on")
    if load.on is not None and kind == "loads":
        words = "does not apply to named loads: each of them says itself on which blocks it acts"
        yield Finding("key-of-another-choice", words, "on")
    if load.on is not None and load.table is not None:
        yield Finding("key-of-another-choice", "does not apply to a table, whose rows name their blocks", "on")
    if load.pattern is not None and kind != "acceleration":
        yield Finding("key-of-another-choice", "applies to acceleration only", "pattern")
    if load.follows and kind not in FOLLOWERS:
        yield Finding("key-of-another-choice", f"applies to {listed(FOLLOWERS)} only", "follows")
    if load.through is not None:
        yield from _through_fill(load, kind)
    if kind == "tilt" and load.factor != 1.0:
        yield Finding("key-of-another-choice", "does not apply to tilt: gravity turns as it is", "factor")


def _through_fill(load: Load, kind: str) -> Iterator[Finding]:
    if kind not in THROUGH_FILL:
        yield Finding("key-of-another-choice", f"applies to {listed(THROUGH_FILL)} only", "through")
        return
    if load.on is not None:
        yield Finding(
            "key-of-another-choice", "does not apply with through: the fill says on which blocks it lies", "on"
        )
    if load.follows:
        yield Finding("key-of-another-choice", "does not apply with through: fill does not turn with blocks", "follows")
    if "towards" in getattr(load, kind).model_fields_set:
        words = "does not apply with through: in fill a load spreads straight down"
        yield Finding("key-of-another-choice", words, kind, "towards")


class AddedMass(Section):
    """A mass that blocks carry along: gravity and accelerations act on it as on the blocks."""

    mass: PositiveMass = Field(description="the mass, all together")
    on: Selector = Field(description="blocks that share it in proportion to their volumes, at their centroids")
    at: Point | None = Field(None, description="where it is, for a mass on one block; its centroid unless given")
