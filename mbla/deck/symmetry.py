"""Section `symmetry`: the deck gives half of a structure, and the plane that mirrors it."""

from __future__ import annotations

from pydantic import Field

from mbla.deck.quantities import Direction, Length, Point
from mbla.deck.section import Section
from mbla.deck.selectors import Selector


class SymmetryPlane(Section):
    """A plane of symmetry: exactly one of x, y, z (normal along that axis), or a point and a normal.

    Blocks, supports, guides, settlements and forces given in the deck appear on both sides, images in the groups of
    what they are images of; results are those of the whole. A block with a face on the plane meets its image there,
    with the joint law that contacts gives for the two. Of several planes each mirrors what those before it have made,
    and its halves are chosen from that.
    """

    x: Length | None = Field(None, description="the plane at this x")
    y: Length | None = Field(None, description="the plane at this y")
    z: Length | None = Field(None, description="the plane at this z")
    point: Point | None = Field(None, description="a point on the plane")
    normal: Direction | None = Field(None, description="normal of the plane, to either side")
    halves: Selector | None = Field(
        None, description="blocks that are cut in two by the plane: half and image are one block"
    )
