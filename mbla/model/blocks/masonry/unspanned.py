"""Openings with neither lintel nor arch: stones above that nothing is under."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence

from mbla.arrays import BoolArray, FloatArray
from mbla.errors import Notice
from mbla.model.blocks.masonry.additions import PlacedOpening
from mbla.model.blocks.masonry.courses import lay_courses
from mbla.model.blocks.masonry.leg import Leg
from mbla.model.wording import counted

REST = 1e-6
"""of an opening's width, by which the middle of a stone may lie beyond its bearing: rounding"""


def unspanned(leg: Leg, openings: Sequence[PlacedOpening], name: str) -> Iterator[Notice]:
    """A warning for each opening of a wall that stones above it would fall into.

    name : of the wall's blocks
    """
    for placed in openings:
        if placed.span is not None:
            continue
        course = placed.void.top
        units = next(itertools.islice(lay_courses(leg), course, None), None)
        falling = _overhang(units.ends, placed.void.left, placed.void.right) if units is not None else None
        if falling is None or not falling.any():
            continue
        alike = counted(int(falling.sum()), "stone")
        wall = f"{name}, segment {leg.number}" if leg.number else name
        words = (
            f"openings[{placed.number}] of {wall} has neither lintel nor arch, and nothing is under {alike} of course "
            f"{course} above it: they fall unless joints or their neighbours hold them; give it `lintel: {{bearing: "
            f"{leg.item.unit[0] / 2:g}}}` or `arch: {{voussoirs: 7}}`"
        )
        yield Notice("warning", "opening-not-spanned", words)


def _overhang(ends: FloatArray, left: float, right: float) -> BoolArray:
    """Which units, with ends (n, 2) along the wall, tip into a gap from left to right below them, (n,)."""
    start, end = ends.T
    middle, rest = (start + end) / 2, REST * (right - left)
    rests_left, rests_right = start < left - rest, end > right + rest
    inside = (middle > left + rest) & (middle < right - rest)
    tips: BoolArray = inside & ~(rests_left & rests_right)
    return tips
