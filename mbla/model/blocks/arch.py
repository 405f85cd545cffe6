"""Item `arch`: straight-edged voussoirs in one or more rings over a curve.

The left springing of the curve lies at the origin, the right one at x = span; the section in the x-z plane is carried
along +y, on a skew plan with x growing by y tan(skew).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise
from typing import Literal

import numpy as np
from pydantic import Field

from mbla.deck.kinds.positions import COURSE, RING, UNIT, VOUSSOIR
from mbla.deck.quantities import Count, EmbraceAngle, PlanePoint, PositiveLength, SideAngle, SkewAngle
from mbla.deck.section import ROUNDING, Section, rule
from mbla.errors import Finding
from mbla.model.blocks.arches.haunches import Backing, backing_width, grounds_behind, haunches, with_backing
from mbla.model.blocks.arches.sections import (
    ArchSection,
    build_section,
    check_rise,
    check_width,
    end_springer,
    ends_of,
    springer_polygons,
    springing_grounds,
    springing_joints,
    stacks,
    through,
    units_across,
    voussoir_polygons,
)
from mbla.model.blocks.curves import Curve, named_curve
from mbla.model.blocks.curves.shape_keys import SHAPES_WITH, CurveShape, range_of_rise, shape_keys
from mbla.model.blocks.curves.spline import curve_through
from mbla.model.blocks.generated import Generated, GroundPart, ItemContext, ItemPart, ItemRefused
from mbla.model.blocks.item import SPRINGERS, ItemKind, SpringingItem, register_item


class ArchPiers(Section):
    """Piers under both springings, inner faces flush with the intrados; where a springing joint is not level, a
    springer block with a level bed lies between.
    """

    height: PositiveLength = Field(description="from the base to the springing of the intrados")
    width: PositiveLength = Field(description="extent along x, outwards from the intrados")
    courses: Count = Field(description="number of courses, one block each")


class ArchItem(SpringingItem):
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
        None, description="basket: angle of each side arc in degrees; default: 60, as wide as the middle one"
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
    piers: ArchPiers | None = Field(None, description="piers under the springings; the deck's supports hold them")
    backing: Backing | None = Field(None, description="haunches over the springings")


LEAST_LENGTH = 1e-100
"""of chords through points, whose inverse and its powers a spline needs; blocks are larger by far"""


@rule(ArchItem)
def arch_shape(arch: ArchItem) -> Iterator[Finding]:
    """A semicircle is given by its span alone; a segment needs its rise or its angle, other shapes their rise."""
    yield from shape_keys(arch, arch.shape, tuple(SHAPES_WITH))
    if arch.span is not None and arch.rise is not None:
        yield from range_of_rise(arch.shape, arch.span, arch.rise, arch.side_angle, ("rise",))
    if arch.piers is not None and arch.springers != "none":
        words = f"the springings have piers or springers: leave out one of them (springers: {arch.springers})"
        yield Finding("key-of-another-choice", words, "piers")


@rule(ArchItem)
def arch_backing(arch: ArchItem) -> Iterator[Finding]:
    """Haunches are as wide as the piers, or as they say."""
    if arch.backing is not None:
        if arch.piers is not None and arch.backing.width is not None:
            yield Finding("key-of-another-choice", "is that of the piers: leave it out", "backing", "width")
        elif arch.piers is None:
            yield from backing_width(arch.backing)


@rule(ArchItem)
def arch_points(arch: ArchItem) -> Iterator[Finding]:
    """A spline over the length of its chords needs chords, and a finite sum of them."""
    points = arch.points or []
    chords = [math.hypot(other[0] - one[0], other[1] - one[1]) for one, other in pairwise(points)]
    length = sum(chords)  # infinite where beyond what a double holds
    if not math.isfinite(length):
        yield Finding("arch-shape", "the points lie too far apart to compute with: use other units", "points")
        return
    if 0 < length < LEAST_LENGTH:
        yield Finding("arch-shape", "the points lie too close together to compute with: use other units", "points")
        return
    for number, chord in enumerate(chords):
        if chord <= ROUNDING * length:
            yield Finding("arch-shape", "is the same point as the one before", "points", number + 1)


def generate(item: ArchItem, context: ItemContext) -> Generated:
    """Voussoirs ring by ring, from left to right in each; with them piers, ground or fixed blocks at the springings.

    Raises ItemRefused where the voussoirs are too few to be blocks or their joints cross, or the piers do not fit the
    springings.
    """
    springing = item.thickness if item.springing_thickness is None else item.springing_thickness
    inside = 0.5 if item.line == "centre" else 0.0
    section = build_section(_curve(item), item.voussoirs, item.rings, item.thickness, springing, inside)
    shear = float(np.tan(np.radians(item.skew)))
    voussoirs = _voussoirs(item, section, shear)
    parts, grounds = [voussoirs], tuple[GroundPart, ...]()
    if item.backing is not None:
        width = None if item.piers is None else item.piers.width
        made = haunches(item.backing, section, width, lambda _: np.array([[0.0, item.width]]), shear)
        parts.append(made[0])
        if item.springers != "none":
            grounds = grounds_behind(made[1], len(voussoirs.polyhedra), item.joint)
    if item.springers == "blocks":
        behind = through(springer_polygons(section, springing), (0.0, item.width), shear)
        parts.append(ItemPart(behind, SPRINGERS.suffix, fixed=True))
    if item.springers == "ground":
        grounds = (*springing_grounds(section, voussoirs.labels["voussoir"], item.joint, shear), *grounds)
    parts += _piers(item, item.piers, section, shear) if item.piers else ()
    return Generated(tuple(parts), grounds)


def _curve(item: ArchItem) -> Curve:
    if item.points is not None:
        return curve_through(item.points)
    assert item.span is not None  # a rule of the deck
    return named_curve(item.shape, item.span, item.rise, item.embrace, item.side_angle)


def _voussoirs(item: ArchItem, section: ArchSection, shear: float) -> ItemPart:
    """Blocks of all rings; in running bond across the width every other course begins with half a block."""
    polygons, number, ring = voussoir_polygons(section)
    even = np.linspace(0.0, item.width, item.units_across + 1)
    odd = np.concatenate([[0.0], (even[:-1] + even[1:]) / 2, [item.width]]) if item.units_across > 1 else even
    rows = [ends_of(odd if shifted else even) for shifted in (number + ring) % 2]
    made, block, unit = units_across(polygons, rows, shear)
    return ItemPart(made, member="voussoir", labels={"voussoir": number[block], "ring": ring[block], "unit": unit})


def _piers(item: ArchItem, piers: ArchPiers, section: ArchSection, shear: float) -> Iterator[ItemPart]:
    """Courses from the bottom, left and right in each; then the springer blocks where the joints are inclined."""
    joints = springing_joints(section)
    for joint in joints:
        check_rise(joint, "piers")
    if findings := list(check_width(piers.width, joints, "piers")):
        raise ItemRefused(*findings)
    (left, left_top), (right, right_top) = (joint.intrados for joint in joints)
    if right <= left:
        raise ItemRefused(Finding("arch-shape", "the piers would overlap: nothing is left of the clear span", "piers"))
    places = [(left - piers.width, left, left_top), (right, right + piers.width, right_top)]
    blocks = stacks(places, piers.height, piers.courses)
    count, across = np.arange(len(blocks)), (0.0, item.width)
    yield ItemPart(through(blocks, across, shear), member="pier", labels={"course": count // 2, "unit": count % 2})
    springers = [(side, end_springer(joint, piers.width)) for side, joint in enumerate(joints)]
    polygons = [polygon for _, polygon in springers if polygon is not None]
    if polygons:
        sides = np.array([side for side, polygon in springers if polygon is not None])
        labels = {"course": np.full(len(sides), piers.courses), "unit": sides}
        yield ItemPart(through(polygons, across, shear), member="springer", labels=labels)


def amount(item: ArchItem) -> tuple[float, str]:
    """Voussoirs, blocks of piers, and units of haunches."""
    courses = 2 * item.piers.courses if item.piers else 0
    carrying = item.voussoirs * item.rings * item.units_across + courses
    return with_backing(item.backing, carrying, "voussoirs", item.thickness + (item.span or 0.0))


register_item(
    ItemKind(
        "arch", ArchItem, generate, amount, after="walls", positions=(VOUSSOIR, RING, UNIT, COURSE), groups=(SPRINGERS,)
    )
)
