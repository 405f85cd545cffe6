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
from mbla.errors import Finding

UPRIGHT = 1e-6
"""cosine of the angle between the top surface and a wall, up to which it is one"""


class TopPlane(Section):
    """A plane that slopes, as of a road on a gradient."""

    point: Point = Field(description="a point on it")
    normal: Direction = Field(description="normal, upwards")


class Dispersal(Section):
    """How a load on top of the fill spreads on its way down: along straight lines from where it stands, as far as the
    angle, in the ways of `law`. The 1:2 rule is `law: uniform` with an angle of 26.565 degrees.
    """

    law: Literal["boussinesq", "uniform"] = Field(
        "boussinesq",
        description="boussinesq: as the vertical stress under a line load on an elastic half-space, cut off at the "
        "angle; uniform: the same everywhere within it",
    )
    angle: SpreadAngle = Field(30.0, description="to both sides of the vertical, in degrees; nothing beyond")
    contact: PositiveLength | None = Field(
        None,
        description="uniform: length over which a load stands on the top, such as 0.3 m of a wheel, of a force in both "
        "directions; it spreads from there; none unless given",
    )


class Passive(Section):
    """How the soil resists faces that move into it: horizontally, with a share of the passive earth pressure at most,
    and with the active one at least, K_a to `mobilisation` times K_p of the vertical stress that its weight makes under
    standard gravity. The shares are a matter of calibration by tests: vary them.
    """

    friction_angle: FrictionAngle = Field(30.0, description="φ of the soil: K_p = (1 + sin φ)/(1 − sin φ) = 1/K_a")
    mobilisation: Share = Field(0.33, description="share of the passive pressure that is reached before collapse")
    cohesion: NonNegativeStress = Field(0.0, description="c of the soil, which adds 2 √K_p c")
    cohesion_mobilisation: Share = Field(0.01, description="share of that part")


@exactly_one_of("level", "surface")
class Fill(Section):
    """Soil on the upward faces of blocks up to a top surface: exactly one of level and surface.

    The column of soil over each piece of a face, along z, is a mass that moves with the block under it, at the middle
    of the column: gravity and accelerations act on it. A face carries it where no other block lies above it; of a face
    that the top surface cuts only what is below. Loads that name the fill with `through` spread in it.
    """

    on: Selector = Field(description="blocks whose upward faces carry it")
    material: Name = Field(description="material of section materials, for its density")
    level: Length | None = Field(None, description="height z of its top, where that is level")
    surface: TopPlane | None = Field(None, description="its top, where that slopes")
    dispersal: Dispersal = Field(default_factory=Dispersal, description="how loads on top of it spread")
    passive: Passive | None = Field(None, description="it holds sloping faces sideways too; it does not unless given")


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
