"""Item `arch`."""

from __future__ import annotations

from typing import Literal, TypeAlias

from pydantic import Field

from mbla.deck.items.item import Item
from mbla.deck.names import Name
from mbla.deck.quantities import Count, EmbraceAngle, PlanePoint, PositiveLength, SideAngle, SkewAngle
from mbla.deck.section import Section

CurveShape: TypeAlias = Literal["semicircular", "segmental", "pointed", "elliptic", "catenary", "basket"]


class ArchPiers(Section):
    """Piers under both springings, inner faces flush with the intrados; where a springing joint is not level, a
    springer block with a level bed lies between.
    """

    height: PositiveLength = Field(description="from the base to the springing of the intrados")
    width: PositiveLength = Field(description="extent along x, outwards from the intrados")
    courses: Count = Field(description="number of courses, one block each")


class ArchItem(Item):
    """An arch of straight-edged voussoirs in the x-z plane, extruded along +y.

    Its joints are normal to the line that has the shape, and divide the line through the middle of the thickness into
    equal lengths. The left springing of the line is at the origin, the right one at x = span. In a pointed arch an even
    number of voussoirs puts a joint at the apex, an odd one a keystone with an apex of its own. Blocks are the members
    `voussoir`, `springer` and `pier`; voussoirs are counted from the left (`voussoir`), from the inside (`ring`) and
    across the width (`unit`), piers and springers from the bottom (`course`) and from the left (`unit`).
    """

    shape: Literal[CurveShape, "points"] = Field(
        description="semicircular; segmental with rise or embrace; pointed (two arcs), elliptic, catenary or basket "
        "(three arcs) with rise; points: a smooth curve (cubic spline) through points"
    )
    span: PositiveLength | None = Field(
        None, description="distance between the springings of the line that has the shape; of all shapes but points"
    )
    thickness: PositiveLength = Field(description="along the joints; at the crown where springing_thickness is given")
    width: PositiveLength = Field(description="extent along y")
    voussoirs: Count = Field(description="number of voussoirs, of each ring")
    rise: PositiveLength | None = Field(
        None,
        description="height of the crown of the line over its springings: segmental, pointed (more than half the "
        "span), elliptic, catenary, basket (at most half the span)",
    )
    embrace: EmbraceAngle | None = Field(None, description="segmental: angle between the springing joints in degrees")
    side_angle: SideAngle | None = Field(
        None, description="basket: angle of each side arc in degrees, 60 unless given, as wide as the middle one"
    )
    points: list[PlanePoint] | None = Field(
        None, min_length=3, description="points: [x, z] of the line from left to right, springings included"
    )
    line: Literal["intrados", "centre"] = Field("intrados", description="the line that has the shape")
    springing_thickness: PositiveLength | None = Field(
        None, description="thickness at the springings; it grows evenly along the line from that of the crown"
    )
    rings: Count = Field(1, description="rings of equal thickness, their joints in line with each other")
    units_across: Count = Field(
        1, description="blocks across the width; from 2 on in running bond, half a block further in every other course"
    )
    skew: SkewAngle = Field(
        0.0,
        description="degrees: the plan is sheared, x by y tan(skew), so that the faces stay in planes of constant y "
        "and the joints stay parallel to the abutments (false skew; no helicoidal courses)",
    )
    springers: Literal["none", "ground", "blocks"] = Field(
        "none",
        description="ground: rigid ground under both springing joints; blocks: a fixed block behind each, "
        "in group GROUP_springers; none: the deck's supports hold the arch",
    )
    joint: Name | None = Field(None, description="joint law at a springing on ground; that of contacts unless given")
    piers: ArchPiers | None = Field(None, description="piers under the springings; the deck's supports hold them")
