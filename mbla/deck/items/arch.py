"""Item `arch`: which shape needs which keys, and the range of a rise."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise
from typing import Literal, TypeAlias

from pydantic import Field

from mbla.deck.items.item import SpringingItem
from mbla.deck.quantities import Count, EmbraceAngle, Length, PlanePoint, PositiveLength, SideAngle, SkewAngle
from mbla.deck.section import ROUNDING, Section, given, one_of, rule
from mbla.deck.suggestions import listed
from mbla.errors import Finding

CurveShape: TypeAlias = Literal["semicircular", "segmental", "pointed", "elliptic", "catenary", "basket"]


class ArchPiers(Section):
    """Piers under both springings, inner faces flush with the intrados; where a springing joint is not level, a
    springer block with a level bed lies between.
    """

    height: PositiveLength = Field(description="from the base to the springing of the intrados")
    width: PositiveLength = Field(description="extent along x, outwards from the intrados")
    courses: Count = Field(description="number of courses, one block each")


class Backing(Section):
    """Haunches on both sides: coursed masonry on the extrados up to a level top, between upright backs, in one block
    through the width of an arch, in the bond of a barrel vault. Member `backing`, with `course` from the bottom and
    `unit` from the left. They stand on the piers, over the width of these, or from the springing of the extrados
    outwards on what the deck's supports give there, with `springers` on ground of their own.
    """

    top: Length = Field(description="height z of their top, over the springings of the line that has the shape")
    unit: tuple[PositiveLength, PositiveLength] = Field(
        description="length and height of a unit; courses are evened out to fit"
    )
    width: PositiveLength | None = Field(
        None, description="extent beyond the springing of the extrados; with piers it is theirs"
    )


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
    piers: ArchPiers | None = Field(None, description="piers under the springings; the deck's supports hold them")
    backing: Backing | None = Field(None, description="haunches over the springings")


SIDE_ANGLE = 60.0
"""of a basket arch [degrees] unless given"""
LEAST_LENGTH = 1e-100
"""of chords through points, whose inverse and its powers a spline needs; blocks are larger by far"""
SHAPES_WITH = {
    "span": ("semicircular", "segmental", "pointed", "elliptic", "catenary", "basket"),
    "rise": ("segmental", "pointed", "elliptic", "catenary", "basket"),
    "embrace": ("segmental",),
    "side_angle": ("basket",),
    "points": ("points",),
}
"""The shapes that a key applies to."""
OPTIONAL = ("side_angle",)
"""Keys that a shape may leave out."""


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


def backing_width(backing: Backing) -> Iterator[Finding]:
    """Without piers haunches need a width."""
    if backing.width is None:
        yield Finding("missing-key", "needs width", "backing")


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


def shape_keys(section: Section, shape: str, keys: tuple[str, ...]) -> Iterator[Finding]:
    """Findings on keys of which a shape needs one, and on those that belong to other shapes."""
    for key in keys:
        shapes = SHAPES_WITH[key]
        if shape in shapes:
            if key == "rise" and shape == "segmental":
                yield from one_of(section, ("rise", "embrace"), " for shape: segmental")
            elif key not in OPTIONAL and key != "embrace" and not given(section, (key,)):
                yield Finding("missing-key", f"needs {key} for shape: {shape}")
        elif given(section, (key,)):
            words = f"applies to shape: {listed(shapes)} only: leave it out, or change shape ({shape} given)"
            yield Finding("key-of-another-choice", words, key)


def range_of_rise(
    shape: str, span: float, rise: float, side_angle: float | None, path: tuple[str | int, ...]
) -> Iterator[Finding]:
    """A pointed curve is more than a semicircle high, a basket less, and high enough for its side arcs.

    None is so flat that its rise over its span is none.
    """
    if not rise / span:
        yield Finding("out-of-bounds", f"is too small for the span, {span:g}: make it larger", *path)
        return
    if shape == "pointed" and rise <= span / 2 * (1 + ROUNDING):
        yield Finding("out-of-bounds", f"must be > {span / 2:g}, half the span, for shape: pointed", *path)
    if shape == "basket":
        angle = math.radians(SIDE_ANGLE if side_angle is None else side_angle)
        least = span / 2 * (1 - math.sin(angle)) / math.cos(angle)
        if rise > span / 2 * (1 + ROUNDING):
            yield Finding("out-of-bounds", f"must be <= {span / 2:g}, half the span, for shape: basket", *path)
        elif rise <= least * (1 + ROUNDING):
            degrees = math.degrees(angle)
            words = f"must be > {least:g} for side arcs of {degrees:g} degrees: a larger side_angle allows a lower one"
            yield Finding("out-of-bounds", words, *path)
