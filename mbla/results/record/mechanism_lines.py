"""Rigid parts of a mechanism and the lines and planes between them, as objects of the JSON record."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

from mbla.model.model import Model
from mbla.results.collapse.cracks import Crack, YieldLine
from mbla.results.collapse.joint_planes import HingeLine, SlidingPlane
from mbla.results.collapse.rigid_parts import PartMotion
from mbla.results.collapse.slip_lines import SlipLine
from mbla.results.quantities.group import Field, count
from mbla.results.record.objects import Object


@dataclass(frozen=True)
class Part:
    """A rigid part."""

    model: Model
    motion: PartMotion


PART, HINGE_LINE, SLIDING_PLANE = Object[Part](), Object[HingeLine](), Object[SlidingPlane]()
_MOTION = PART.of(lambda of: of.motion)
CRACK, YIELD_LINE, SLIP_LINE = Object[Crack](), Object[YieldLine](), Object[SlipLine]()


_MOTION.fields(
    PartMotion,
    part=Field("number, from 1, the heaviest first", attribute="number"),
    blocks=Field("its blocks", by=count),
)


@PART.key("blocks of a group")
def groups(of: Part) -> dict[str, int]:
    """Its blocks by group."""
    return dict(sorted(Counter(of.model.blocks.groups[block] for block in of.motion.blocks.tolist()).items()))


_MOTION.fields(PartMotion, weight=Field("weight under standard gravity", unit="force"))


@PART.key()
def motion(of: Part) -> str:
    """Turns or moves."""
    return "turns" if of.motion.turns else "moves"


@PART.key("a coordinate", unit="length")
def axis_point(of: Part) -> list[float | None] | None:
    """Where it turns: the point of its axis nearest to its centroid."""
    return list(of.motion.axis_point) if of.motion.turns else None


_MOTION.fields(PartMotion, direction=Field("unit vector of the axis by the right hand, or of the travel", "vector"))
INTERFACES = Field("its interfaces", "interface")
HINGE_LINE.fields(
    HingeLine,
    clusters=Field("the cluster that turns, and the other; 0 is at rest", "cluster"),
    interfaces=INTERFACES,
    start=Field("start of the line", "axis", "length"),
    end=Field("its end", "axis", "length"),
    direction=Field("unit vector from start to end, for the first by the right hand", "vector"),
    rotation=Field("the largest relative angular velocity of its interfaces", unit="rotation"),
    share=Field("its largest contact speed over the largest of all"),
    slides=Field("whether closed points of it slide too"),
    crushes=Field("whether closed points of it crush too"),
    shear_power_share=Field("share of the power put in that its shear forces dissipate", rule="open"),
)
SLIDING_PLANE.fields(
    SlidingPlane,
    clusters=Field("the cluster that slides, and the other; 0 is at rest", "cluster"),
    interfaces=INTERFACES,
    area=Field("area of its interfaces", unit="area"),
    centroid=Field("their centroid", "axis", "length"),
    normal=Field("unit vector towards the cluster that slides", "vector"),
    direction=Field("unit vector in which it slides over the other", "vector"),
    twists=Field("whether it slides by turning about the normal"),
    power_share=Field("share of the power put in that is dissipated there", rule="open"),
    shear_power_share=Field("the same of the shear forces alone", rule="open"),
    share=Field("its largest contact speed over the largest of all"),
)
CRACK.fields(
    Crack,
    clusters=Field("the cluster that moves away, and the other; 0 is at rest", "cluster"),
    interfaces=INTERFACES,
    start=Field("centroid of its first interface", "axis", "length"),
    end=Field("of its last", "axis", "length"),
    area=Field("area of its interfaces", unit="area"),
    widest=Field("the contact point at which it opens most", "axis", "length"),
    share=Field("opening speed there over the largest contact speed of all"),
)
YIELD_LINE.fields(
    YieldLine,
    parts=Field("the clusters on both sides; 0 is at rest and comes second", "cluster"),
    interfaces=INTERFACES,
    off=Field("distance of the interfaces from it over its length, root of the mean square"),
)


SLIP_LINE.fields(
    SlipLine,
    clusters=Field("the cluster that moves, and that against which it does; 0 is at rest", "cluster"),
    interfaces=INTERFACES,
    start=Field("start of the line, in the middle of the width", "axis", "length"),
    end=Field("its end", "axis", "length"),
    length=Field("length along it", unit="length"),
    area=Field("area of its interfaces", unit="area"),
    share=Field("its largest contact speed over the largest of all"),
    shear_power_share=Field("share of the power put in that its shear forces dissipate", rule="open"),
)


@HINGE_LINE.key(name="length", unit="length")
@CRACK.key(name="length", unit="length")
@YIELD_LINE.key(name="length", unit="length")
def length(line: HingeLine | Crack | YieldLine) -> float:
    """Its length."""
    return line.length


@YIELD_LINE.key("a point", "a coordinate", unit="length")
def points(line: YieldLine) -> list[list[float]]:
    """Its ends and corners, the lowest end first."""
    corners: list[list[float]] = line.points.tolist()
    return corners


@YIELD_LINE.key(unit="degree")
def inclination(line: YieldLine) -> float:
    """To the horizontal, from end to end."""
    return line.inclination
