"""Section `supports`: what holds the structure."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mbla.deck.names import Name
from mbla.deck.quantities import Direction, Length, Point, Switch
from mbla.deck.section import Section
from mbla.deck.selectors import Selector


class GroundPlane(Section):
    """A plane: exactly one of x, y, z (normal along that axis), or a point and a normal towards the structure."""

    x: Length | None = Field(None, description="the plane at this x, structure on the side of greater x")
    y: Length | None = Field(None, description="the plane at this y, structure on the side of greater y")
    z: Length | None = Field(None, description="the plane at this z, structure above")
    point: Point | None = Field(None, description="a point on the plane")
    normal: Direction | None = Field(None, description="normal of the plane, towards the structure")


class Turn(Section):
    """A rotation about a line."""

    axis: Direction = Field(description="direction of the line; the rotation is right-handed about it")
    about: Point = Field(description="a point on the line")


Component = Literal["x", "y", "z", "rx", "ry", "rz"]
"""Displacement along an axis, or rotation about it."""


class Support(Section):
    """Rigid ground under every face on a plane, blocks that do not move, or blocks that may move in given ways only."""

    ground: GroundPlane | None = Field(None, description="rigid ground")
    joint: Name | None = Field(None, description="joint law on the ground; that of contacts unless given")
    blocks: Selector | None = Field(
        None, description="blocks that do not move, or only as told; with ground: the only blocks it carries"
    )
    fixed: Annotated[list[Component], Field(min_length=1)] | None = Field(
        None,
        description="which displacements, and rotations about the centroid, are held: all six unless given; the "
        "support takes whatever force that needs, in both senses and without friction",
    )
    slide: Direction | None = Field(None, description="the blocks may slide along this direction, both ways")
    turn: Turn | None = Field(
        None, description="the blocks may turn about this line, both ways; with slide: they may do both"
    )
    together: Switch | None = Field(
        None,
        description="true: the blocks move as one rigid body, with fixed: about their common centroid; each by itself "
        "unless given",
    )
