"""Generator of columns of drums: circles as regular polygons.

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

from typing import Literal

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.items.column import ColumnEnd, ColumnItem
from mbla.model.generators.generator import Generated, Part, Site
from mbla.model.solids.polyhedra import chains

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


def generate_column(item: ColumnItem, site: Site) -> Generated:
    """Base, drums from the bottom, and capital."""
    outline = corner_radius(item.sides, item.polygon) * regular_polygon(item.sides)
    foot = item.base.height if item.base else 0.0
    joints = foot + _joints(item)
    shaft = chains(_polygons(outline, _radii(item, joints), joints))
    parts = [Part(shaft, member="drum", labels={"drum": np.arange(len(shaft))})]
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
    radii: FloatArray = item.radius + (top - item.radius) * share + 4.0 * item.entasis * share * (1.0 - share)
    return radii


def _polygons(outline: FloatArray, radii: FloatArray, heights: FloatArray) -> FloatArray:
    """Lower and upper polygon of each drum, (n_drums, 2, n_corners, 3)."""
    flat = radii[:, None, None] * outline
    level = np.broadcast_to(heights[:, None, None], (*flat.shape[:2], 1))
    polygons = np.concatenate([flat, level], axis=2)
    return np.stack([polygons[:-1], polygons[1:]], axis=1)


def _end(end: ColumnEnd, outline: FloatArray, bottom: float, member: str) -> Part:
    size, flat = (end.side, _SQUARE) if end.side is not None else (end.radius, outline)
    assert size is not None  # a rule of the deck: one of side and radius
    return Part(chains(_polygons(flat, np.full(2, size), np.array([bottom, bottom + end.height]))), member=member)
