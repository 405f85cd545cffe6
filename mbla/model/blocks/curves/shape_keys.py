"""Keys of a curve: which shape needs which, and the range of a rise."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Literal, TypeAlias

from mbla.deck.section import ROUNDING, Section, given, one_of
from mbla.deck.suggestions import listed
from mbla.errors import Finding, KeyPath

CurveShape: TypeAlias = Literal["semicircular", "segmental", "pointed", "elliptic", "catenary", "basket"]
SIDE_ANGLE = 60.0
"""of a basket arch [degrees], by default"""
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


def range_of_rise(shape: str, span: float, rise: float, side_angle: float | None, path: KeyPath) -> Iterator[Finding]:
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
