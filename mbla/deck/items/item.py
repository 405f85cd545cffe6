"""What every item of `blocks` has: a group, a material, a transform, copies."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal, TypeAlias

from pydantic import Discriminator, Field, Tag

from mbla.deck.quantities import Angle, Direction, Integer, Name, Point, PositiveNumber
from mbla.deck.section import Section, exactly_one_of, rule, shape
from mbla.errors import Finding


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


Transform: TypeAlias = Annotated[
    Annotated[TransformStep, Tag("mapping")] | Annotated[list[TransformStep], Tag("list")],
    Discriminator(lambda value: "mapping" if shape(value) == "mapping" else "list"),
]


@exactly_one_of("translate", "rotate")
class Repetition(Section):
    """Copies of an item, each moved on from the one before; exactly one of translate and rotate."""

    count: Annotated[int, Integer(ge=2, le=100_000)] = Field(description="how many there are, the first included")
    translate: Point | None = Field(None, description="displacement from each copy to the next")
    rotate: Rotation | None = Field(None, description="rotation from each copy to the next")


Repeat: TypeAlias = Annotated[
    Annotated[Repetition, Tag("mapping")] | Annotated[list[Repetition], Tag("list")],
    Discriminator(lambda value: "mapping" if shape(value) == "mapping" else "list"),
]


class Item(Section):
    """What every item of `blocks` has."""

    group: Name | None = Field(None, description="name that selectors use; the item's kind unless given")
    material: Name = Field(description="name of a material")
    transform: Transform = Field(
        default_factory=list, description="a step, or a list of steps applied in order to the item's own geometry"
    )
    repeat: Repeat = Field(
        default_factory=list,
        description="copies, made after the transform, all in the same group; of a list each step repeats what the "
        "steps before it have made",
    )


class SpringingItem(Item):
    """What springs from its supports: arches, domes and vaults."""

    springers: Literal["none", "ground", "blocks"] = Field(
        "none",
        description="ground: rigid ground under the springing joints; blocks: fixed blocks behind them, in group "
        "GROUP_springers; none: the deck's supports hold the structure",
    )
    joint: Name | None = Field(None, description="joint law at springings on ground; that of contacts unless given")


@rule(SpringingItem)
def joint_of_ground(item: SpringingItem) -> Iterator[Finding]:
    """The joint law of a ground needs a ground."""
    if item.joint is not None and item.springers != "ground":
        yield Finding("key-of-another-choice", "applies with springers: ground only", "joint")
