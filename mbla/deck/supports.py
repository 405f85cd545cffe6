"""Section `supports`: what holds the structure."""

from __future__ import annotations

from pydantic import Field

from mbla.deck.names import Name
from mbla.deck.quantities import Direction, Length, Point
from mbla.deck.section import Section
from mbla.deck.selectors import Selector


class GroundPlane(Section):
    """A plane: exactly one of x, y, z (normal along that axis), or a point and a normal towards the structure."""

    x: Length | None = Field(None, description="the plane at this x, structure on the side of greater x")
    y: Length | None = Field(None, description="the plane at this y, structure on the side of greater y")
    z: Length | None = Field(None, description="the plane at this z, structure above")
    point: Point | None = Field(None, description="a point on the plane")
    normal: Direction | None = Field(None, description="normal of the plane, towards the structure")


class Support(Section):
    """Rigid ground under every face on a plane, or blocks that do not move."""

    ground: GroundPlane | None = Field(None, description="rigid ground")
    joint: Name | None = Field(None, description="joint law on the ground; that of contacts unless given")
    blocks: Selector | None = Field(
        None, description="blocks that do not move; with ground: the only blocks it carries"
    )
