"""How a load on top of fill spreads through it onto the blocks below.

It goes down along straight lines from where it stands, at most by the angle α to the vertical. A line at the slope t,
horizontal over vertical, |t| <= T = tan α, has the density k(t):

- boussinesq: k = 1/(1 + t²)² / (α + sin α cos α). Under a line load on an elastic half-space the stress is radial, and
  what goes down between two slopes is (q/π) [θ + sin θ cos θ], θ = atan t, through whatever surface (Boussinesq 1885;
  Timoshenko and Goodier 1951, Theory of Elasticity, art. 33); cut off at α it is divided by what is left;
- uniform: k = 1/(2 T), the same stress everywhere at a depth h within the width 2 h T, or, of a load of the length a,
  within a + 2 h T: then the lines come from a point a/(2 T) above the top.

A line load spreads to both sides and not beyond its ends, a force spreads so in both directions, by k(t) k(u). A piece
of a facet takes the lines that end on it, as a vertical force where they do on the mean: an integral over its image in
the plane of slopes, which is a polygon. Of two pieces in one line the upper one takes it.

All of the load lands: what would leave the blocks sideways, across the way in which it spreads, is kept on them in
proportion, as the spandrels keep it. What goes beyond their ends is carried by the ground there and counted apart.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, summed
from mbla.deck.sections.fill import Dispersal
from mbla.model.fill import FillBody
from mbla.model.solids.plane import cut, signed_areas

HAIR = 1e-9
"""depth over the extent of the fill to which a load that stands on a block itself is lifted, so that it has a side"""
NOTHING = 1e-9
"""area in the plane of slopes, or share of a load, that is rounding"""
EDGE_PARTS = 8
"""chords of the image of an edge under a line load, which is a curve unless the edge runs along or across the load"""
GAUSS = np.polynomial.legendre.leggauss(8)
"""points and weights between -1 and 1; the densities are smooth on images that are one wide at most"""


@dataclass(frozen=True)
class Spread:
    """Where a load lands.

    blocks : (n,) ascending, each once
    shares : (n,) of the load; they add up to 1 less ``beyond``
    points : (n, 3) where each acts
    beyond : share that goes past the ends of the blocks
    """

    blocks: IntArray
    shares: FloatArray
    points: FloatArray
    beyond: float


@dataclass(frozen=True)
class _Pieces:
    """Pieces of facets as seen from the load, lengths from where it stands: along, across, below its origin.

    loops  : (n, k, 3) corners; what no line of the load reaches is cut off
    planes : (n, 3) depth at the load and its slopes along and across
    """

    loops: FloatArray
    planes: FloatArray

    def depths(self, rows: IntArray, slopes: FloatArray, line: bool) -> FloatArray:
        """Below the origin at points of images (m, 2) of the pieces ``rows``, (m,)."""
        at_load, along, across = self.planes[rows].T
        if line:
            return np.asarray((at_load + across * slopes[:, 1]) / (1.0 - along * slopes[:, 0]))
        return np.asarray(at_load / (1.0 - along * slopes[:, 0] - across * slopes[:, 1]))


def spread(body: FillBody, place: FloatArray, along: FloatArray, width: float) -> Spread | None:
    """Shares of a vertical load that stands on the fill at a place, (3,), whose z does not count; None where all of it
    goes beyond.

    along : (3,) unit, horizontal: the way in which it spreads, of a force also across
    width : of a line load, across, half of it to each side of the place; 0 for a force
    """
    law, line = body.dispersal, width > 0.0
    most = math.tan(math.radians(law.angle))
    lifted = 0.0 if law.contact is None else law.contact / (2.0 * most)
    across = np.array([-along[1], along[0], 0.0])
    away = body.triangles - place
    local = np.stack([away @ along, away @ across, -away[..., 2]], axis=2)
    slope = float(-body.normal @ across / body.normal[2]) if line else 0.0  # a line follows the top
    extent = float(np.abs(local[..., :2]).max())
    local[..., 2] += float(body.tops(place)) - place[2] + slope * local[..., 1] + lifted + HAIR * extent
    pieces, owner = _reached(local, most, width)
    if not len(owner):
        return None
    rows, images = _visible(pieces, line, most * (width or most))
    if not len(rows):
        return None
    shares, points = _integrals(pieces, rows, images, law, width)
    ends = _cumulative(law, np.array(_bounds(images)))
    kept = float(ends[1] - ends[0])
    if kept <= NOTHING or not shares.sum() > NOTHING:
        return None
    seen = shares > NOTHING**2 * shares.sum()  # others have nothing left of them
    rows, shares, points = rows[seen], shares[seen], points[seen]
    blocks, row = np.unique(body.blocks[owner[rows]], return_inverse=True)
    total = summed(row, shares, len(blocks))
    means = summed(row, shares[:, None] * points, len(blocks)) / total[:, None]
    heights = body.tops(place) + slope * means[:, 1] + lifted + HAIR * extent - means[:, 2]
    at = place + means[:, :1] * along + means[:, 1:2] * across
    at[:, 2] = heights
    beyond = 1.0 - kept if kept < 1.0 - NOTHING else 0.0
    return Spread(blocks, total * ((1.0 - beyond) / total.sum()), at, beyond)


def _reached(local: FloatArray, most: float, width: float) -> tuple[_Pieces, IntArray]:
    """What of triangles (n, 3, 3) lines of the load reach, if nothing stands in the way; and their rows (m,)."""
    loops = local
    for sign in (1.0, -1.0):
        loops = cut(loops, most * loops[..., 2] - sign * loops[..., 0])
        if width > 0.0:
            loops = cut(loops, np.where(loops.any(axis=2), width / 2 - sign * loops[..., 1], -1.0))
        else:
            loops = cut(loops, most * loops[..., 2] - sign * loops[..., 1])
    left = np.flatnonzero((loops[..., 2] > 0.0).all(axis=1))
    a, b, c = local[left].transpose(1, 0, 2)
    normals = np.cross(b - a, c - a)
    slopes = -normals[:, :2] / normals[:, 2:]
    at_load = a[:, 2] - (slopes * a[:, :2]).sum(axis=1)
    return _Pieces(loops[left], np.column_stack([at_load, slopes])), left


def _visible(pieces: _Pieces, line: bool, size: float) -> tuple[IntArray, Any]:
    """Pieces that the load sees, (m,), and their images less what lies behind other pieces, (m,); ``size`` is an area
    of images, to which others are relative.
    """
    import shapely

    loops = pieces.loops
    if line:
        parts = np.arange(EDGE_PARTS)[:, None] / EDGE_PARTS
        on = np.roll(loops, -1, axis=1)
        loops = (loops[:, :, None] + parts * (on - loops)[:, :, None]).reshape(len(loops), -1, 3)
    flat = np.stack([loops[..., 0] / loops[..., 2], loops[..., 1] / (1.0 if line else loops[..., 2])], axis=2)
    rows = np.flatnonzero(signed_areas(flat) > NOTHING * size)
    images = np.atleast_1d(shapely.polygons(flat[rows]))
    images = np.where(shapely.is_valid(images), images, shapely.make_valid(images))
    one, other = shapely.STRtree(images).query(images, predicate="intersects")
    one, other = one[one < other], other[one < other]
    common = shapely.intersection(images[one], images[other])
    twice = shapely.area(common) > NOTHING * size
    for first, second, both in zip(one[twice], other[twice], common[twice], strict=True):
        middle = np.array([both.centroid.coords[0]] * 2)
        depths = pieces.depths(rows[[first, second]], middle, line)
        behind = first if depths[0] > depths[1] else second
        images[behind] = shapely.difference(images[behind], both)
    return rows, images


def _bounds(images: Any) -> tuple[float, float]:
    """Least and greatest slope along of images (n,)."""
    import shapely

    least, _, greatest, _ = shapely.total_bounds(images)
    return float(least), float(greatest)


def _integrals(
    pieces: _Pieces, rows: IntArray, images: Any, law: Dispersal, width: float
) -> tuple[FloatArray, FloatArray]:
    """Share of the load in each image, (m,), and the mean place where it lands: along, across, depth, (m, 3)."""
    import shapely

    parts, image = shapely.get_parts(shapely.constrained_delaunay_triangles(images), return_index=True)
    a, b, c = shapely.get_coordinates(parts).reshape(-1, 4, 2)[:, :3].transpose(1, 0, 2)
    places, weights = (GAUSS[0] + 1.0) / 2, GAUSS[1] / 2
    r, s = (each.ravel() for each in np.meshgrid(places, places, indexing="ij"))
    weight = np.outer(weights * places, weights).ravel()  # r from the corner a, s along the edge from b to c
    edge = b[:, None] + s[:, None] * (c - b)[:, None]
    slopes = a[:, None] + r[:, None] * (edge - a[:, None])
    double_area = np.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    line = width > 0.0
    density = _density(law, slopes[..., 0]) * (1.0 / width if line else _density(law, slopes[..., 1]))
    own = density * weight * double_area[:, None]
    flat = slopes.reshape(-1, 2)
    depths = pieces.depths(np.repeat(rows[image], len(weight)), flat, line)
    across = flat[:, 1] if line else flat[:, 1] * depths
    landed = np.stack([flat[:, 0] * depths, across, depths], axis=1).reshape(*own.shape, 3)
    shares = summed(image, own.sum(axis=1), len(rows))
    moments = summed(image, (own[..., None] * landed).sum(axis=1), len(rows))
    return shares, moments / np.where(shares > 0.0, shares, 1.0)[:, None]


def _density(law: Dispersal, slopes: FloatArray) -> FloatArray:
    """Density k of lines over their slopes."""
    angle = math.radians(law.angle)
    if law.law == "uniform":
        return np.full(slopes.shape, 0.5 / math.tan(angle))
    return np.asarray(1.0 / (1.0 + slopes**2) ** 2 / (angle + math.sin(angle) * math.cos(angle)))


def _cumulative(law: Dispersal, slopes: FloatArray) -> FloatArray:
    """Share of lines up to a slope, from -1/2 to 1/2: the integral of the density from the vertical."""
    angle = math.radians(law.angle)
    if law.law == "uniform":
        return np.asarray(slopes * 0.5 / math.tan(angle))
    own = np.arctan(slopes)
    return np.asarray((own + np.sin(own) * np.cos(own)) / (2.0 * (angle + math.sin(angle) * math.cos(angle))))


def beside(body: FillBody, places: FloatArray, along: FloatArray, reach: float) -> BoolArray:
    """Places (n, 3) beside the fill, farther than ``reach`` from all of it across the way along, (3,) unit."""
    across = np.array([-along[1], along[0], 0.0])
    own, sides = places @ across, body.triangles @ across
    return np.asarray((own < sides.min() - reach) | (own > sides.max() + reach))


def emerging(body: FillBody, place: FloatArray, reach: float) -> int | None:
    """Block that rises out of the fill by more than ``reach`` at a place, (3,), None where none does."""
    a, b, c = body.triangles[..., :2].transpose(1, 0, 2)
    sides = [
        signed_areas(np.stack([one, two, np.broadcast_to(place[:2], one.shape)], axis=1))
        for one, two in ((a, b), (b, c), (c, a))
    ]
    inside = (np.stack(sides) >= 0.0).all(axis=0)
    for row in np.flatnonzero(inside):
        over = body.triangles[row, 0]
        normal = np.cross(body.triangles[row, 1] - over, body.triangles[row, 2] - over)
        height = over[2] - (place[:2] - over[:2]) @ normal[:2] / normal[2]
        if height > float(body.tops(place)) + reach:
            return int(body.blocks[row])
    return None
