"""Soil as rigid cells: keys that fill and the item `soil` have in common, and their rules."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Protocol

from pydantic import Field

from mbla.deck.quantities import (
    FrictionAngle,
    Length,
    Name,
    NonNegativeLength,
    NonNegativeStress,
    PositiveLength,
    PositiveUnitWeight,
)
from mbla.deck.section import ROUNDING, Section
from mbla.errors import Finding

SOIL = "soil"
"""kind of items that are soil"""
FRICTION_ANGLE = "friction angle φ of the soil"
COHESION = "cohesion c of the soil"
TENSILE_STRENGTH = "tensile strength of the soil, at most c / tan φ"
DILATANCY = "dilatancy angle ψ of the soil, at most φ; default: 0"
WALL = "law of its faces on blocks"
WATER = "ground water, drained: lifts the soil below a level and presses on blocks there; default: none"
SHARE_OF_WALL = 2.0 / 3.0
"""k of δ = k φ between soil and a wall, of precast concrete or steel sheet piles, EN 1997-1, 9.5.1(6)"""


class SoilCells(Section):
    """Soil as rigid cells: triangular prisms whose joints have the law of the soil."""

    size: PositiveLength = Field(description="length of the sides of the triangles, about")
    top: PositiveLength | None = Field(
        None,
        description="the same along the top, at most size, from where they grow downwards: a quarter of what axles "
        "stand on; default: as below",
    )


class FillCells(SoilCells):
    """Soil as rigid cells: triangular prisms, through the width, whose joints have the law of the soil."""

    beyond: NonNegativeLength = Field(
        0.0,
        description="how far the soil goes on beyond the ends of the blocks, on level ground at the foot of the last "
        "one; where it ends it is held by upright ground",
    )


class SoilWall(Section):
    """Joint law between soil and the blocks that it lies on or behind."""

    friction_angle: FrictionAngle | None = Field(
        None, description="at most that of the soil; default: two thirds of it, EN 1997-1, 9.5.1(6)"
    )
    cohesion: NonNegativeStress = Field(0.0, description="adhesion, at most the cohesion of the soil")


class SoilWater(Section):
    """Ground water at rest in the pores of soil below a level, drained: the joints of the soil carry effective stress.

    It lifts each part of the soil below the level by the weight of the water in its place, and presses on blocks, and
    on cells of soil without water, where they touch the soil below the level: in every load case, with a factor of 1.
    Faces of blocks that no such soil touches stay dry: a load `pressure` gives water that stands before them or under
    their foot.
    """

    level: Length = Field(description="height z of the water table; above the soil the soil is flooded")
    unit_weight: PositiveUnitWeight | None = Field(None, description="of the water; default: 9.81 kN/m^3")
    saturated: Name | None = Field(
        None,
        description="material of section materials, for the density of the soil below the level with the water in its "
        "pores, no less than that above; default: that above",
    )


class SoilKeys(Protocol):
    """What is asked of soil."""

    @property
    def friction_angle(self) -> float | None: ...  # noqa: D102 - as of FRICTION_ANGLE
    @property
    def cohesion(self) -> float: ...  # noqa: D102
    @property
    def tensile_strength(self) -> float: ...  # noqa: D102
    @property
    def dilatancy(self) -> float: ...  # noqa: D102
    @property
    def wall(self) -> SoilWall: ...  # noqa: D102


def soil_strengths(soil: SoilKeys) -> Iterator[Finding]:
    """Dilatancy at most the friction angle, a friction cone that is open at the tensile strength, and no wall rougher
    than the soil, which would slip within itself beside it: δ <= φ, EN 1997-1, 9.5.1(7), and adhesion <= c.
    """
    if soil.friction_angle is None:
        return
    beside = "which slips within itself beside a rougher wall"
    if (soil.wall.friction_angle or 0.0) > soil.friction_angle * (1 + ROUNDING):
        words = f"must be <= {soil.friction_angle:.6g} degrees, the friction angle of the soil, {beside}"
        yield Finding("out-of-bounds", words, "wall", "friction_angle")
    if soil.wall.cohesion > soil.cohesion * (1 + ROUNDING):
        words = f"must be <= {soil.cohesion:.6g}, the cohesion of the soil, {beside}"
        yield Finding("out-of-bounds", words, "wall", "cohesion")
    if soil.dilatancy > soil.friction_angle * (1 + ROUNDING):
        yield Finding("out-of-bounds", f"must be <= {soil.friction_angle:.6g} degrees, the friction angle", "dilatancy")
    friction = math.tan(math.radians(soil.friction_angle))
    if soil.cohesion < friction * soil.tensile_strength * (1 - ROUNDING):
        words = f"must be <= {soil.cohesion / friction:.6g}, c / tan φ, where the friction cone ends"
        yield Finding("out-of-bounds", words, "tensile_strength")


def laws_of_soil(name: str) -> tuple[str, str]:
    """Names of the joint laws of soil with that name: between its cells, and between these and other blocks."""
    return name, f"{name}.wall"
