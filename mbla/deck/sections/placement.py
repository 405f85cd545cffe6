"""Where things of the deck stand: steps of a transform, and copies."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from pydantic import Field

from mbla.deck.quantities import Angle, Direction, Integer, Point, PositiveNumber
from mbla.deck.section import ByShape, Section, exactly_one_of


class Rotation(Section):
    """Rotation by an angle about an axis, right-handed."""

    axis: Direction = Field(description="direction of the axis")
    angle: Angle = Field(description="degrees")
    about: Point = Field((0.0, 0.0, 0.0), description="point on the axis")


class Reflection(Section):
    """Mirror image in a plane."""

    normal: Direction = Field(description="normal of the plane")
    point: Point = Field((0.0, 0.0, 0.0), description="point on the plane")


@exactly_one_of()
class TransformStep(Section):
    """One step of a transform: exactly one of its keys."""

    translate: Point | None = Field(None, description="displacement")
    rotate: Rotation | None = Field(None, description="rotation about an axis")
    scale: PositiveNumber | None = Field(None, description="factor on all coordinates, about the origin")
    mirror: Reflection | None = Field(None, description="reflection in a plane")


Transform: TypeAlias = Annotated[TransformStep | list[TransformStep], ByShape("list")]


@exactly_one_of("translate", "rotate")
class Repetition(Section):
    """Copies of an item, each moved on from the one before; exactly one of translate and rotate."""

    count: Annotated[int, Integer(ge=2, le=100_000)] = Field(description="how many there are, the first included")
    translate: Point | None = Field(None, description="displacement from each copy to the next")
    rotate: Rotation | None = Field(None, description="rotation from each copy to the next")


Repeat: TypeAlias = Annotated[Repetition | list[Repetition], ByShape("list")]
