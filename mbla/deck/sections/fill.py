"""Section `fill`: soil above arches and vaults, by its top surface and the blocks that it lies on."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Literal

from pydantic import Field

from mbla.deck.quantities import (
    Direction,
    FrictionAngle,
    Length,
    Name,
    NonNegativeStress,
    Point,
    PositiveLength,
    Share,
    SpreadAngle,
)
from mbla.deck.section import ROUNDING, Section, exactly_one_of, rule
from mbla.deck.sections.selectors import Selector
from mbla.deck.sections.soil import (
    COHESION,
    DILATANCY,
    FRICTION_ANGLE,
    TENSILE_STRENGTH,
    WALL,
    WATER,
    FillCells,
    SoilWall,
    SoilWater,
    soil_strengths,
)
from mbla.errors import Finding

UPRIGHT = 1e-6
"""cosine of the angle between the top surface and a wall, up to which it is one"""


class TopPlane(Section):
    """A sloping plane, as of a road on a gradient."""

    point: Point = Field(description="a point on it")
    normal: Direction = Field(description="normal, upwards")


class Dispersal(Section):
    """Spread of a load through the fill: along straight lines from the load down, up to the angle, with the density of
    `law`. The 1:2 rule is `law: uniform` with an angle of 26.565 degrees.
    """

    law: Literal["boussinesq", "uniform"] = Field(
        "boussinesq",
        description="boussinesq: as the vertical stress under a line load on an elastic half-space, cut off at the "
        "angle; uniform: the same everywhere within it",
    )
    angle: SpreadAngle = Field(
        30.0, description="greatest angle of the spread to the vertical, to both sides, in degrees"
    )
    contact: PositiveLength | None = Field(
        None,
        description="uniform: length of the top on which a load stands, such as 0.3 m of a wheel, of a force in "
        "both directions; the load spreads from its ends; default: none",
    )


class Passive(Section):
    """Lateral resistance of the soil at faces that move into it: a horizontal pressure between K_a and `mobilisation`
    K_p times the vertical stress of the soil under standard gravity (active and passive earth pressure). The shares
    are calibrated by tests: vary them.
    """

    friction_angle: FrictionAngle = Field(30.0, description="φ of the soil: K_p = (1 + sin φ)/(1 − sin φ) = 1/K_a")
    mobilisation: Share = Field(0.33, description="share of the passive pressure that is reached before collapse")
    cohesion: NonNegativeStress = Field(0.0, description="cohesion c of the soil, which adds 2 √K_p c")
    cohesion_mobilisation: Share = Field(
        0.01, description="share of the part of cohesion that is reached before collapse"
    )


@exactly_one_of("level", "surface")
class Fill(Section):
    """Soil on the upward faces of blocks up to a top surface: exactly one of level and surface.

    The column of soil over each piece of a face, along z, is a mass at the middle of the column, which moves with the
    block below: gravity and accelerations act on it. A face carries soil where it lies below the top surface and no
    other block lies above it. Loads that name the fill with `through` spread through it.

    With `cells` it is no mass on blocks but soil that carries and slips: rigid cells, in the group of its name, that
    fill what lies between the blocks and the top, between spandrel walls where there are any, which may rise above it
    and may be among the blocks of `on`. The blocks are prisms across one horizontal direction there. Joints between
    cells, and of cells with ground, have the law of the soil, those with other blocks that of `wall`; of
    `contacts.overrides` those with `between` hold for them. Loads act on the cells.
    """

    on: Selector = Field(description="blocks whose upward faces carry it")
    material: Name = Field(description="material of section materials, for its density")
    level: Length | None = Field(None, description="height z of a level top surface")
    surface: TopPlane | None = Field(None, description="sloping top surface")
    dispersal: Dispersal = Field(default_factory=Dispersal, description="how loads on the top spread through the fill")
    passive: Passive | None = Field(None, description="lateral resistance of the soil at sloping faces; default: none")
    cells: FillCells | None = Field(None, description="soil as rigid cells; default: a mass on the blocks")
    friction_angle: FrictionAngle | None = Field(None, description=f"cells: {FRICTION_ANGLE}; must be given")
    cohesion: NonNegativeStress = Field(0.0, description=f"cells: {COHESION}")
    tensile_strength: NonNegativeStress = Field(0.0, description=f"cells: {TENSILE_STRENGTH}")
    dilatancy: FrictionAngle = Field(0.0, description=f"cells: {DILATANCY}")
    wall: SoilWall = Field(default_factory=SoilWall, description=f"cells: {WALL}")
    water: SoilWater | None = Field(None, description=f"cells: {WATER}")


OF_CELLS = ("friction_angle", "cohesion", "tensile_strength", "dilatancy", "wall", "water")
OF_MASSES = ("dispersal", "passive")


@rule(Fill)
def mass_or_cells(fill: Fill) -> Iterator[Finding]:
    """What says how a mass on blocks is loaded and holds them says nothing about cells, which slip, and the reverse."""
    if fill.cells is not None and fill.friction_angle is None:
        yield Finding("missing-key", "needs friction_angle with cells")
    without = OF_CELLS if fill.cells is None else OF_MASSES
    words = "applies to fill with cells only" if fill.cells is None else "applies to fill without cells only"
    for key in without:
        if key in fill.model_fields_set:
            yield Finding("key-of-another-choice", words, key)


@rule(Fill)
def strengths_of_cells(fill: Fill) -> Iterator[Finding]:
    """Those of soil, where it is cells."""
    if fill.cells is not None:
        yield from soil_strengths(fill)


@rule(Passive)
def passive_above_active(passive: Passive) -> Iterator[Finding]:
    """What resists is not less than what follows."""
    sine = math.sin(math.radians(passive.friction_angle))
    least = ((1.0 - sine) / (1.0 + sine)) ** 2
    if passive.mobilisation < least * (1 - ROUNDING):
        words = f"must be >= {least:.4g}, K_a/K_p of this friction angle: else the soil pushes more than it resists"
        yield Finding("out-of-bounds", words, "mobilisation")


@rule(Dispersal)
def contact_of_uniform(dispersal: Dispersal) -> Iterator[Finding]:
    """The lines of Boussinesq come from one place."""
    if dispersal.contact is not None and dispersal.law != "uniform":
        yield Finding("key-of-another-choice", "applies to law: uniform only", "contact")


@rule(TopPlane)
def top_upwards(plane: TopPlane) -> Iterator[Finding]:
    """Fill lies below its top."""
    size = max(map(abs, plane.normal))
    if plane.normal[2] / size <= UPRIGHT:
        yield Finding("out-of-bounds", "must point upwards: fill lies below its top surface", "normal", 2)
