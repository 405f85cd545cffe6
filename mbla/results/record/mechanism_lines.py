"""Rigid parts of a mechanism and the lines and planes between them, as objects of the JSON record."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

from mbla.arrays import FloatArray
from mbla.model.model import Model
from mbla.results.collapse.cracks import Crack, YieldLine
from mbla.results.collapse.joint_planes import HingeLine, SlidingPlane
from mbla.results.collapse.rigid_parts import PartMotion
from mbla.results.record.objects import Item, Object


@dataclass(frozen=True)
class Part:
    """A rigid part."""

    model: Model
    motion: PartMotion


PART, HINGE_LINE, SLIDING_PLANE = Object[Part](), Object[HingeLine](), Object[SlidingPlane]()
CRACK, YIELD_LINE = Object[Crack](), Object[YieldLine]()


@PART.key()
def part(of: Part) -> int:
    """Number, from 1, the heaviest first."""
    return of.motion.number


@PART.key()
def blocks(of: Part) -> int:
    """Its blocks."""
    return len(of.motion.blocks)


@PART.key("blocks of a group")
def groups(of: Part) -> dict[str, int]:
    """Its blocks by group."""
    return dict(sorted(Counter(of.model.blocks.groups[block] for block in of.motion.blocks.tolist()).items()))


@PART.key(unit="force")
def weight(of: Part) -> float:
    """Weight under standard gravity."""
    return of.motion.weight


@PART.key()
def motion(of: Part) -> str:
    """Turns or moves."""
    return "turns" if of.motion.turns else "moves"


@PART.key("a coordinate", unit="length")
def axis_point(of: Part) -> list[float | None] | None:
    """Where it turns: the point of its axis nearest to its centroid."""
    return list(of.motion.axis_point) if of.motion.turns else None


@PART.key("a component")
def direction(of: Part) -> FloatArray:
    """Unit vector of the axis by the right hand, or of the travel."""
    return of.motion.direction


INTERFACES = Item("its interfaces", "number of an interface, from 0")
HINGE_LINE.fields(
    HingeLine,
    clusters=Item("the cluster that turns, and the other; 0 is at rest", "a cluster"),
    interfaces=INTERFACES,
    start=Item("start of the line", "a coordinate", "length"),
    end=Item("its end", "a coordinate", "length"),
    direction=Item("unit vector from start to end, for the first by the right hand", "a component"),
    rotation=Item("the largest relative angular velocity of its interfaces", unit="rotation"),
    share=Item("its largest contact speed over the largest of all"),
    slides=Item("whether closed points of it slide too"),
    crushes=Item("whether closed points of it crush too"),
    shear_power_share=Item("share of the power put in that its shear forces dissipate", null=True),
)
SLIDING_PLANE.fields(
    SlidingPlane,
    clusters=Item("the cluster that slides, and the other; 0 is at rest", "a cluster"),
    interfaces=INTERFACES,
    area=Item("area of its interfaces", unit="area"),
    centroid=Item("their centroid", "a coordinate", "length"),
    normal=Item("unit vector towards the cluster that slides", "a component"),
    direction=Item("unit vector in which it slides over the other", "a component"),
    twists=Item("whether it slides by turning about the normal"),
    power_share=Item("share of the power put in that is dissipated there", null=True),
    shear_power_share=Item("the same of the shear forces alone", null=True),
    share=Item("its largest contact speed over the largest of all"),
)
CRACK.fields(
    Crack,
    clusters=Item("the cluster that moves away, and the other; 0 is at rest", "a cluster"),
    interfaces=INTERFACES,
    start=Item("centroid of its first interface", "a coordinate", "length"),
    end=Item("of its last", "a coordinate", "length"),
    area=Item("area of its interfaces", unit="area"),
    widest=Item("the contact point at which it opens most", "a coordinate", "length"),
    share=Item("opening speed there over the largest contact speed of all"),
)
YIELD_LINE.fields(
    YieldLine,
    parts=Item("the clusters on both sides; 0 is at rest and comes second", "a cluster"),
    interfaces=INTERFACES,
    off=Item("distance of the interfaces from it over its length, root of the mean square"),
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
