"""Rules on arches: which shape needs which keys, and the range of a rise."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

from mbla.deck import types
from mbla.deck.rules.common import ROUNDING, exactly_one, given
from mbla.deck.section import Finding, Section, rule
from mbla.deck.suggestions import listed
from mbla.errors import Message

SIDE_ANGLE = 60.0
"""of a basket arch [degrees] unless given"""

LEAST_WHOLE = 1e-100
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


@rule(types.ArchItem)
def arch_shape(arch: types.ArchItem) -> Iterator[Finding]:
    """A semicircle is given by its span alone; a segment needs its rise or its angle, other shapes their rise."""
    yield from shape_keys(arch, arch.shape, tuple(SHAPES_WITH))
    if arch.span is not None and arch.rise is not None:
        yield from range_of_rise(arch.shape, arch.span, arch.rise, arch.side_angle, ("rise",))
    if arch.joint is not None and arch.springers != "ground":
        yield ("joint",), Message("key-of-another-choice", "applies with springers: ground only")
    if arch.piers is not None and arch.springers != "none":
        yield (
            ("piers",),
            Message(
                "key-of-another-choice",
                f"the springings have piers or springers: leave out one of them (springers: {arch.springers})",
            ),
        )


@rule(types.ArchItem)
def arch_points(arch: types.ArchItem) -> Iterator[Finding]:
    """A spline over the length of its chords needs chords, and a finite sum of them."""
    points = arch.points or []
    chords = [math.hypot(other[0] - one[0], other[1] - one[1]) for one, other in pairwise(points)]
    whole = sum(chords)  # infinite where beyond what a double holds
    if not math.isfinite(whole):
        yield ("points",), Message("arch-shape", "the points lie too far apart to be told by a number: use other units")
        return
    if 0 < whole < LEAST_WHOLE:
        yield ("points",), Message("arch-shape", "the points lie too close together to compute with: use other units")
        return
    for number, chord in enumerate(chords):
        if chord <= ROUNDING * whole:
            yield ("points", number + 1), Message("arch-shape", "is the same point as the one before")


def shape_keys(section: Section, shape: str, keys: tuple[str, ...]) -> Iterator[Finding]:
    """Findings on keys of which a shape needs one, and on those that belong to other shapes."""
    for key in keys:
        shapes = SHAPES_WITH[key]
        if shape in shapes:
            if key == "rise" and shape == "segmental":
                yield from exactly_one(section, ("rise", "embrace"), " for a segmental arch")
            elif key not in OPTIONAL and key != "embrace" and not given(section, (key,)):
                yield (), Message("missing-key", f"needs {key} for shape: {shape}")
        elif given(section, (key,)):
            yield (
                (key,),
                Message(
                    "key-of-another-choice",
                    f"applies to shape: {listed(shapes)} only: leave it out, or change shape ({shape} given)",
                ),
            )


def range_of_rise(
    shape: str, span: float, rise: float, side_angle: float | None, path: tuple[str | int, ...]
) -> Iterator[Finding]:
    """A pointed arch is more than a semicircle high, a basket arch less, and high enough for its side arcs.

    No arch is so flat that its rise over its span is none.
    """
    if not rise / span:
        yield path, Message("out-of-bounds", f"is lost beside the span, {span:g}: make it larger")
        return
    if shape == "pointed" and rise <= span / 2 * (1 + ROUNDING):
        yield path, Message("out-of-bounds", f"must be > {span / 2:g}, half the span, for a pointed arch")
    if shape == "basket":
        angle = math.radians(SIDE_ANGLE if side_angle is None else side_angle)
        least = span / 2 * (1 - math.sin(angle)) / math.cos(angle)
        if rise > span / 2 * (1 + ROUNDING):
            yield path, Message("out-of-bounds", f"must be <= {span / 2:g}, half the span, for a basket arch")
        elif rise <= least * (1 + ROUNDING):
            degrees = math.degrees(angle)
            yield (
                path,
                Message(
                    "out-of-bounds",
                    f"must be > {least:g} for side arcs of {degrees:g} degrees: a larger side_angle allows a lower one",
                ),
            )
