"""Item `soil`: a polygon with a width, as rigid cells that fit the blocks beside it.

It is made after all other items (:mod:`mbla.model.soil`), so that its cells have corners where blocks beside it have.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

from pydantic import Field

from mbla.deck.kinds.positions import BlockPosition
from mbla.deck.quantities import FrictionAngle, NonNegativeStress, PlanePoint, PositiveLength
from mbla.deck.section import rule
from mbla.deck.sections.soil import (
    COHESION,
    DILATANCY,
    FRICTION_ANGLE,
    TENSILE_STRENGTH,
    WALL,
    WATER,
    SoilCells,
    SoilWall,
    SoilWater,
    soil_strengths,
)
from mbla.errors import Finding
from mbla.model.blocks.generated import Generated, ItemContext
from mbla.model.blocks.item import AnyItem, ItemKind, register_item

CELL = BlockPosition("cell", "cell of soil", 10)


class SoilItem(AnyItem):
    """Soil as rigid cells: a polygon in the x-z plane, from y = 0 to the width, behind walls and under footings.
    Labels: `cell`.

    Joints between cells, and of cells with ground, have the law of the soil, those with other blocks that of `wall`; of
    `contacts.overrides` those with `between` hold for them. Where it is cut off, ground of `supports` holds it.
    """

    outline: Annotated[list[PlanePoint], Field(min_length=3)] = Field(description="corners x, z in order")
    width: PositiveLength = Field(description="extent along y, from 0")
    cells: SoilCells = Field(description="how large the cells are")
    friction_angle: FrictionAngle = Field(description=FRICTION_ANGLE)
    cohesion: NonNegativeStress = Field(0.0, description=COHESION)
    tensile_strength: NonNegativeStress = Field(0.0, description=TENSILE_STRENGTH)
    dilatancy: FrictionAngle = Field(0.0, description=DILATANCY)
    wall: SoilWall = Field(default_factory=SoilWall, description=WALL)
    water: SoilWater | None = Field(None, description=WATER)


rule(SoilItem)(soil_strengths)


@rule(SoilItem)
def one_soil(soil: SoilItem) -> Iterator[Finding]:
    """Copies would not fit the blocks beside them."""
    if soil.repeat:
        yield Finding("key-of-another-choice", "does not apply to soil: give an item for each", "repeat")


def generate(item: SoilItem, context: ItemContext) -> Generated:
    """Nothing yet: its cells fit the blocks of all other items."""
    return Generated(())


register_item(ItemKind("soil", SoilItem, generate, positions=(CELL,), materials=("water.saturated",)))
