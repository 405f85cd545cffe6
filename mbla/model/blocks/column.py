"""Item `column`: drums, whose circles are regular polygons.

A regular polygon of n sides with corners at distance c from its middle has the area n/2 sin(2 pi/n) c^2 and flats at
distance c cos(pi/n). It stands for a circle of radius r

    inscribed     with its corners on the circle:   c = r
    circumscribed with its flats on the circle:     c = r/cos(pi/n)
    equal_area    with the area of the circle:      c = r sqrt(2 pi/(n sin(2 pi/n)))

With s the height over the foot of the shaft relative to its full height, r0 and r1 the radii at both ends and e the
entasis, the radius at a joint is r0 + (r1 - r0) s + 4 e s (1 - s). Between its joints a drum is a frustum of a regular
polygon, of volume A h (1 + q + q^2)/3 with A the area of its lower polygon and q the ratio of its radii.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from mbla.arrays import FloatArray
from mbla.deck.kinds.positions import DRUM
from mbla.deck.quantities import Count, Integer, NonNegativeLength, PositiveLength
from mbla.deck.section import Section, exactly_one_of, given, rule
from mbla.errors import Finding
from mbla.model.blocks.generated import Generated, ItemContext, ItemPart
from mbla.model.blocks.item import AnyItem, ItemKind, register_item
from mbla.model.solids.polyhedra import chains


@exactly_one_of("side", "radius")
class ColumnEnd(Section):
    """Block under or on the shaft of a column; one of side and radius."""

    side: PositiveLength | None = Field(None, description="side of a square block")
    radius: PositiveLength | None = Field(None, description="radius of a round block, a polygon like the drums")
    height: PositiveLength = Field(description="height")


class ColumnItem(AnyItem):
    """A column of drums that rises along +z, the middle of its underside at the origin.

    Drums are regular polygons with a flat towards +x, and frusta where the column tapers. Labels: `drum`; members
    `base`, `drum`, `capital`.
    """

    radius: PositiveLength = Field(description="radius of the shaft at its foot")
    top_radius: PositiveLength | None = Field(
        None, description="radius of the shaft at its top; default: radius at its foot"
    )
    entasis: NonNegativeLength = Field(
        0.0, description="how far the joints at half height swell beyond the straight taper; a parabola over the height"
    )
    height: PositiveLength | None = Field(None, description="height of the shaft, with drums")
    drums: Count | None = Field(None, description="number of drums of equal height")
    drum_heights: list[PositiveLength] | None = Field(
        None, min_length=1, description="heights of the drums from the bottom, instead of height and drums"
    )
    sides: Annotated[int, Integer(ge=3, le=360)] = Field(
        24, description="sides of the polygon that stands for a circle"
    )
    polygon: Literal["equal_area", "inscribed", "circumscribed"] = Field(
        "equal_area",
        description="equal_area: as large as the circle, so that weights are exact; inscribed: corners on the circle; "
        "circumscribed: flats on the circle, so that it rocks at the radius about an edge",
    )
    base: ColumnEnd | None = Field(None, description="block under the shaft, from z = 0; the shaft stands on it")
    capital: ColumnEnd | None = Field(None, description="block on the shaft")


@rule(ColumnItem)
def column_heights(column: ColumnItem) -> Iterator[Finding]:
    """Heights of the drums one by one, or equal ones."""
    pair = ("height", "drums")
    found = given(column, pair)
    if column.drum_heights is not None:
        for key in found:
            yield Finding("one-of-several", "is what drum_heights says already: leave one of them out", key)
    elif len(found) < 2:
        yield Finding("missing-key", "needs height and drums, or drum_heights")


@rule(ColumnItem)
def column_profile(column: ColumnItem) -> Iterator[Finding]:
    """An entasis shows at joints between the ends only."""
    count = column.drums if column.drum_heights is None else len(column.drum_heights)
    if column.entasis > 0 and count == 1:
        words = "has no effect on a single drum: it is the swelling of the joints between drums"
        yield Finding("key-of-another-choice", words, "entasis")


PolygonKind = Literal["inscribed", "circumscribed", "equal_area"]


def corner_radius(sides: int, kind: PolygonKind) -> float:
    """Distance of the corners from the middle, relative to the radius of the circle."""
    if kind == "inscribed":
        return 1.0
    if kind == "circumscribed":
        return float(1.0 / np.cos(np.pi / sides))
    return float(np.sqrt(2.0 * np.pi / (sides * np.sin(2.0 * np.pi / sides))))


def regular_polygon(sides: int) -> FloatArray:
    """Corners (sides, 2) at distance 1, counter-clockwise, the middle of the first and last on the x axis.

    A flat faces +x, so that a push along x rocks a drum about an edge.
    """
    angles = np.pi / sides * (1.0 + 2.0 * np.arange(sides))
    return np.stack([np.cos(angles), np.sin(angles)], axis=1)


_SQUARE = regular_polygon(4) * np.sqrt(0.5)
"""of side 1"""


def generate(item: ColumnItem, context: ItemContext) -> Generated:
    """Base, drums from the bottom, and capital."""
    outline = corner_radius(item.sides, item.polygon) * regular_polygon(item.sides)
    foot = item.base.height if item.base else 0.0
    joints = foot + _joints(item)
    shaft = chains(_polygons(outline, _radii(item, joints), joints))
    parts = [ItemPart(shaft, member="drum", labels={"drum": np.arange(len(shaft))})]
    if item.base:
        parts.insert(0, _end(item.base, outline, 0.0, "base"))
    if item.capital:
        parts.append(_end(item.capital, outline, joints[-1], "capital"))
    return Generated(tuple(parts))


def _joints(item: ColumnItem) -> FloatArray:
    """Heights of the joints over the foot of the shaft, (n_drums + 1,)."""
    if item.drum_heights is not None:
        return np.concatenate([[0.0], np.cumsum(item.drum_heights)])
    assert item.height is not None  # a rule of the deck: height and drums, or drum_heights
    assert item.drums is not None
    return np.linspace(0.0, item.height, item.drums + 1)


def _radii(item: ColumnItem, joints: FloatArray) -> FloatArray:
    """Radii at the joints, (n_drums + 1,)."""
    top = item.radius if item.top_radius is None else item.top_radius
    share = (joints - joints[0]) / (joints[-1] - joints[0])
    return np.asarray(item.radius + (top - item.radius) * share + 4.0 * item.entasis * share * (1.0 - share))


def _polygons(outline: FloatArray, radii: FloatArray, heights: FloatArray) -> FloatArray:
    """Lower and upper polygon of each drum, (n_drums, 2, n_corners, 3)."""
    flat = radii[:, None, None] * outline
    level = np.broadcast_to(heights[:, None, None], (*flat.shape[:2], 1))
    polygons = np.concatenate([flat, level], axis=2)
    return np.stack([polygons[:-1], polygons[1:]], axis=1)


def _end(end: ColumnEnd, outline: FloatArray, bottom: float, member: str) -> ItemPart:
    size, flat = (end.side, _SQUARE) if end.side is not None else (end.radius, outline)
    assert size is not None  # a rule of the deck: one of side and radius
    return ItemPart(chains(_polygons(flat, np.full(2, size), np.array([bottom, bottom + end.height]))), member=member)


def amount(item: ColumnItem) -> tuple[float, str]:
    """Sides of all drums."""
    return (len(item.drum_heights or ()) + (item.drums or 0)) * item.sides, "sides"


register_item(ItemKind("column", ColumnItem, generate, amount, after="table", positions=(DRUM,)))
