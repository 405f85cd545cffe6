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
proportion, as the spandrels keep it. So is what goes past the last of them at slopes at which any face of a block
stands, as the upright one of an end wall. Only what goes beyond is left to the ground there and counted apart.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, summed
from mbla.deck.sections.fill import Dispersal
from mbla.model.fill.fill import FillBody
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.plane import cut, signed_areas
from mbla.model.solids.polygons import Polygons, polygons_from_loops, triangles
from mbla.model.solids.ragged import row_maxima, row_ranges
from mbla.process.late import shapely

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

    blocks : (n,) ascending, each once; none where no line of it ends on them
    shares : (n,) of the load; they add up to 1 less ``beyond``
    points : (n, 3) where each acts
    beyond : share that goes past the ends of all blocks
    met    : share that goes past those under the fill and meets faces of blocks all the same; in ``shares``, if any
    others : (m,) these blocks, ascending
    """

    blocks: IntArray
    shares: FloatArray
    points: FloatArray
    beyond: float
    met: float = 0.0
    others: IntArray = field(default_factory=lambda: np.empty(0, np.int64))


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


def spread(body: FillBody, place: FloatArray, along: FloatArray, width: float, blocks: Blocks) -> Spread:
    """Shares of a vertical load that stands on the fill at a place, (3,), whose z does not count.

    along  : (3,) unit, horizontal: the way in which it spreads, of a force also across
    width  : of a line load, across, half of it to each side of the place; 0 for a force
    blocks : of the model
    """
    law, line = body.dispersal, width > 0.0
    most = math.tan(math.radians(law.angle))
    across = np.array([-along[1], along[0], 0.0])
    slope = float(-body.normal @ across / body.normal[2]) if line else 0.0  # a line follows the top
    away = (body.triangles - place).reshape(-1, 3)
    extent = float(np.abs(np.stack([away @ along, away @ across])).max(initial=0.0))
    lifted = (0.0 if law.contact is None else law.contact / (2.0 * most)) + HAIR * extent

    def seen(points: FloatArray) -> FloatArray:
        """Points (..., 3) from the load: along, across, below its origin."""
        away = points - place
        below = float(body.tops(place)) - place[2] - away[..., 2] + slope * (away @ across) + lifted
        return np.stack([away @ along, away @ across, below], axis=-1)

    pieces, owner = _reached(seen(body.triangles), most, width)
    rows, images = _visible(pieces, line, most * (width or most))
    shares, points = _integrals(pieces, rows, images, law, width)
    ends = _bounds(images)
    kept = _between(law, *ends)
    if kept <= NOTHING or not shares.sum() > NOTHING:
        ends, kept, shares = (math.inf, -math.inf), 0.0, np.zeros(len(shares))
    met, others = (0.0, np.empty(0, np.int64)) if kept >= 1.0 - NOTHING else _met(blocks, seen, law, width, ends)
    beyond = 1.0 - kept - met if kept + met < 1.0 - NOTHING else 0.0
    landed = shares > NOTHING**2 * shares.sum()  # others have nothing left of them
    rows, shares, points = rows[landed], shares[landed], points[landed]
    found, row = np.unique(body.blocks[owner[rows]], return_inverse=True)
    total = summed(row, shares, len(found))
    means = summed(row, shares[:, None] * points, len(found)) / total[:, None]
    at = place + means[:, :1] * along + means[:, 1:2] * across
    at[:, 2] = body.tops(place) + slope * means[:, 1] + lifted - means[:, 2]
    return Spread(found, total * ((1.0 - beyond) / (total.sum() or 1.0)), at, beyond, met, others)


def _clipped(loops: FloatArray, most: float, width: float) -> tuple[FloatArray, IntArray]:
    """What of loops (n, k, 3) lines of the load reach, if nothing stands in the way, and their rows (m,)."""
    for sign in (1.0, -1.0):
        loops = cut(loops, most * loops[..., 2] - sign * loops[..., 0])
        if width > 0.0:
            loops = cut(loops, np.where(loops.any(axis=2), width / 2 - sign * loops[..., 1], -1.0))
        else:
            loops = cut(loops, most * loops[..., 2] - sign * loops[..., 1])
    left = np.flatnonzero((loops[..., 2] > 0.0).all(axis=1))
    return loops[left], left


def _met(
    blocks: Blocks, seen: Callable[[FloatArray], FloatArray], law: Dispersal, width: float, ends: tuple[float, float]
) -> tuple[float, IntArray]:
    """Share of the load between the last slope of the pieces, ``ends``, and the last one at which lines meet a face of
    any block, and the blocks there, (n,).
    """
    most, start = math.tan(math.radians(law.angle)), blocks.loop_start
    corners = seen(blocks.vertices)[blocks.loops]
    reach = most * row_maxima(corners[:, 2], start)
    near = reach > 0.0
    for axis, side in ((0, reach), (1, width / 2 if width > 0.0 else reach)):
        low, high = row_ranges(corners[:, axis], start)
        near &= (high >= -side) & (low <= side)
    faces = np.flatnonzero(near)
    counts = np.diff(start)[faces]
    columns = np.minimum(np.arange(counts.max(initial=1)), counts[:, None] - 1)
    loops, left = _clipped(corners[start[faces][:, None] + columns], most, width)
    images = _flat(loops, width > 0.0)
    seen_as_areas = np.abs(signed_areas(images)) > NOTHING * most * (width or most)  # not from their edges
    slopes, owner = images[seen_as_areas, :, 0], blocks.block_of_face[faces[left[seen_as_areas]]]
    if not len(slopes):
        return 0.0, owner
    least, most_of = slopes.min(axis=1), slopes.max(axis=1)
    share = _between(law, min(ends[0], least.min()), max(ends[1], most_of.max())) - _between(law, *ends)
    past = (least < ends[0] - NOTHING * most) | (most_of > ends[1] + NOTHING * most)
    return (share, np.unique(owner[past])) if share > NOTHING else (0.0, owner[:0])


def _reached(local: FloatArray, most: float, width: float) -> tuple[_Pieces, IntArray]:
    """What of triangles (n, 3, 3) lines of the load reach, if nothing stands in the way; and their rows (m,)."""
    loops, left = _clipped(local, most, width)
    a, b, c = local[left].transpose(1, 0, 2)
    normals = np.cross(b - a, c - a)
    slopes = -normals[:, :2] / normals[:, 2:]
    at_load = a[:, 2] - (slopes * a[:, :2]).sum(axis=1)
    return _Pieces(loops, np.column_stack([at_load, slopes])), left


def _visible(pieces: _Pieces, line: bool, size: float) -> tuple[IntArray, Polygons]:
    """Pieces that the load sees, (m,), and their images less what lies behind other pieces, (m,); ``size`` is an area
    of images, to which others are relative.
    """
    flat = _with_chords(pieces.loops) if line else _flat(pieces.loops, line)
    rows = np.flatnonzero(signed_areas(flat) > NOTHING * size)
    images = polygons_from_loops(flat[rows].reshape(-1, 2), np.arange(len(rows) + 1) * flat.shape[1])
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


def _with_chords(loops: FloatArray) -> FloatArray:
    """Images of loops (n, k, 3) under a line load, whose edges are curves: polygons of the same area, (n, m, 2).

    Between a parabola and its chords lies 1/12 of the second differences times their lengths, by which their corners
    are moved out; the first and the last of an edge by half as much again, for its ends stay.
    """
    parts = np.arange(EDGE_PARTS + 1)[:, None] / EDGE_PARTS
    points = loops[:, :, None] + parts * (np.roll(loops, -1, axis=1) - loops)[:, :, None]
    curve = _flat(points, line=True)
    weights = np.ones(EDGE_PARTS - 1)
    weights[[0, -1]] = 1.5
    curve[:, :, 1:-1] -= weights[:, None] * np.diff(curve, n=2, axis=2) / 12.0
    return curve[:, :, :-1].reshape(len(loops), EDGE_PARTS * loops.shape[1], 2)


def _flat(points: FloatArray, line: bool) -> FloatArray:
    """Images of points (..., 3) in the plane of slopes, (..., 2), which across a line load is one of places."""
    return np.stack([points[..., 0] / points[..., 2], points[..., 1] / (1.0 if line else points[..., 2])], axis=-1)


def _bounds(images: Polygons) -> tuple[float, float]:
    """Least and greatest slope along of images (n,); the wrong way round without any."""
    if not len(images):
        return math.inf, -math.inf
    least, _, greatest, _ = shapely.total_bounds(images)
    return float(least), float(greatest)


def _integrals(
    pieces: _Pieces, rows: IntArray, images: Polygons, law: Dispersal, width: float
) -> tuple[FloatArray, FloatArray]:
    """Share of the load in each image, (m,), and the mean place where it lands: along, across, depth, (m, 3)."""
    corners, image = triangles(images)
    a, b, c = corners.transpose(1, 0, 2)
    places, weights = (GAUSS[0] + 1.0) / 2, GAUSS[1] / 2
    r, s = (each.ravel() for each in np.meshgrid(places, places, indexing="ij"))
    weight = np.outer(weights * places, weights).ravel()  # r from the corner a, s along the edge from b to c
    edge = b[:, None] + s[:, None] * (c - b)[:, None]
    slopes = a[:, None] + r[:, None] * (edge - a[:, None])
    double_area = 2.0 * signed_areas(corners)
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


def _between(law: Dispersal, least: float, greatest: float) -> float:
    """Share of lines between two slopes; nothing the wrong way round."""
    return float(np.diff(_cumulative(law, np.array([least, greatest])))[0]) if least < greatest else 0.0


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
