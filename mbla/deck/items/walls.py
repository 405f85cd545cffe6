"""Item `walls`: walls along the lines of a plan, bonded where they meet."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from mbla.deck.items.masonry import Buttress, Gable, Masonry, Opening
from mbla.deck.quantities import Index, PlanePoint, Switch
from mbla.deck.section import Section


class CrossWall(Section):
    """A straight wall besides the main line; an end that lies on another wall is bonded into it."""

    from_: PlanePoint = Field(alias="from", description="where it begins: x, y")
    to: PlanePoint = Field(description="where it ends: x, y")


class SegmentOpening(Opening):
    """Opening in one wall of a plan; distances along it are from the first point of its line."""

    segment: Index = Field(description="which wall: segments of the plan from 0, then the cross walls")


class SegmentGable(Gable):
    """Gable on one wall of a plan, over its whole length with the corners."""

    segment: Index = Field(description="which wall: segments of the plan from 0, then the cross walls")


class SegmentButtress(Buttress):
    """Buttress against one wall of a plan."""

    segment: Index = Field(description="which wall: segments of the plan from 0, then the cross walls")


class WallsItem(Masonry):
    """Walls along the lines of a plan, on the ground at z = 0, bonded at corners and junctions: of two walls that meet
    one runs through in even courses, that along x, the other in odd courses. Lines run along x or y.
    """

    plan: list[PlanePoint] = Field(min_length=2, description="corners of the main line: x, y of each")
    closed: Switch = Field(False, description="whether the line returns to its first point")
    cross_walls: list[CrossWall] = Field(default_factory=list, description="further walls, for T- and cross-plans")
    side: Literal["left", "right", "centre"] = Field(
        "left", description="where the walls stand, seen along their lines; left is inside where they turn left"
    )
    openings: list[SegmentOpening] = Field(default_factory=list, description="rectangles left free")
    gables: list[SegmentGable] = Field(default_factory=list, description="triangles on top of walls")
    buttresses: list[SegmentButtress] = Field(default_factory=list, description="piers against faces of walls")
