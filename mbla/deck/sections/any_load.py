"""What a load of the deck says whatever its kind: on which blocks it acts, where, and times which factor."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Any

from pydantic import Field

from mbla.deck.kinds.load_key import LOAD_KEYS, LoadKey
from mbla.deck.quantities import Direction, Length, Name, Number, Point
from mbla.deck.section import Section, given, rule
from mbla.deck.sections.selectors import Selector
from mbla.errors import Finding


class HeightPattern(Section):
    """How an acceleration grows along a direction: linearly from 0 at base to 1 at top, or through points.

    Every part of a block has the factor of its own height, so that it does not matter how a structure is divided into
    blocks; an added mass that of the place where it is, and fill that of its own heights.
    """

    along: Direction = Field((0.0, 0.0, 1.0), description="direction along which heights are measured, from the origin")
    base: Length | None = Field(
        None, description="height of factor 0, as below it; default: lowest point of the loaded blocks"
    )
    top: Length | None = Field(
        None, description="height of factor 1, as above it; default: highest point of the loaded blocks"
    )
    points: list[tuple[Length, Number]] | None = Field(
        None,
        min_length=2,
        description="instead of base and top: heights and factors, straight lines between, constant beyond the ends",
    )


@rule(HeightPattern)
def height_pattern(pattern: HeightPattern) -> Iterator[Finding]:
    """From base to top, or through points with rising heights."""
    for key in given(pattern, ("base", "top")) if pattern.points is not None else []:
        yield Finding("key-of-another-choice", "does not apply together with points", key)
    if pattern.base is not None and pattern.top is not None and not pattern.base < pattern.top:
        yield Finding("out-of-bounds", f"must be > {pattern.base:g}, the base", "top")
    heights = [height for height, _ in pattern.points or []]
    for number, (below, above) in enumerate(pairwise(heights), start=1):
        if not below < above:
            yield Finding("out-of-bounds", f"must be > {below:g}, the height before it", "points", number, 0)


class AnyLoad(Section):
    """A load without its kind, which :mod:`mbla.deck.sections.loads` adds."""

    on: Selector | None = None
    through: Name | None = None
    at: Point | None = Field(None, description="point of application, carried with its moment; default: the centroid")
    pattern: HeightPattern | None = None
    factor: Number = Field(1.0, description="factor on the load")
    follows: bool = False

    @property
    def kind(self) -> str:
        """The key of its kind; empty where it has none."""
        return next((key for key in LOAD_KEYS if getattr(self, key) is not None), "")

    @property
    def facts(self) -> LoadKey:
        """What is known of its kind."""
        return LOAD_KEYS[self.kind]

    @property
    def chosen(self) -> Any:
        """What stands at the key of its kind."""
        return getattr(self, self.kind)
