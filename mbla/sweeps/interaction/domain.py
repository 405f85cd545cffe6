r"""What the points prove of the safe domain: a polygon inside of it, a polygon around it, and whether they agree.

With associative flow the loads (x, y) that a structure carries are a convex set (lower-bound theorem: forces of two
states, mixed, carry the mixed loads within convex yield conditions). So

- the convex hull of points that static bounds prove safe is safe: the inner polygon. The dead load alone, at the
  origin, is such a point where the structure stands under it, and so is all of a ray on which no factor brings
  collapse;
- every mechanism bounds the whole set by a half-plane x p_x + y p_y ≤ k (:mod:`mbla.results.records.power_json`), with
  the powers p of the two loads: their intersection is the outer polygon.

The set lies between the two. Safe points beyond a half-plane, or a hull beyond the kinematic bound of a ray, would show
that a bound is wrong: an error of verification, which is told. Without associative flow there is no such theorem; the
domain drawn is that of associative flow, and the load factors of the deck's own flow rule lie inside of it.

M. A. Save, C. E. Massonnet: Plastic analysis and design of plates, shells and disks, 1972: the domain of loads that are
carried is convex in the space of the load parameters.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.thresholds import GAP_TOLERANCE
from mbla.sweeps.interaction.angles import unit_vector
from mbla.sweeps.interaction.point import Point

CROSSED = GAP_TOLERANCE
"""relative distance by which safe points may pass a bound: up to which the two bounds of a point count as one"""
FAR = 10.0
"""edge of the picture in which an unbounded domain is cut off, over the farthest point"""


@dataclass(frozen=True)
class Crossing:
    """A safe point beyond what a mechanism allows.

    angle : ray of the bound that is passed, degrees
    safe  : angle of the safe point, or of the middle of the hull's side
    share : relative distance beyond it
    """

    angle: float
    safe: float
    share: float


@dataclass(frozen=True)
class Domain:
    """Polygons about the safe domain of associative flow, counter-clockwise, corners (n, 2).

    inner     : convex hull of safe points, empty where there are none
    outer     : intersection of half-planes, within the sector of the angles; empty where there is no half-plane
    cut_off   : the outer polygon ends at an edge that no mechanism draws
    crossings : safe points beyond bounds, the worst first
    planes    : (m, 3) p_x, p_y, k of the half-planes
    """

    inner: FloatArray
    outer: FloatArray
    cut_off: bool
    crossings: tuple[Crossing, ...]
    planes: FloatArray

    @property
    def gap(self) -> float:
        """Area between the polygons over the area of the outer one; nan where it is not bounded."""
        if self.cut_off or len(self.outer) < 3:
            return float("nan")
        whole = area(self.outer)
        return 1.0 - area(self.inner) / whole if whole > 0.0 else float("nan")


def domain_of(points: Sequence[Point], pair: tuple[str, str], *, closed: bool) -> Domain | None:
    """The domain that points in the plane of two loads prove; None where none of them has bounds."""
    safe = [(point.angle, point.at(point.static_bound)) for point in points if _is_safe(point)]
    if not safe:
        return None
    corners = [place for _, place in safe]
    if any(point.standing == "yes" for point in points):
        corners.append((0.0, 0.0))
    planes, rays = half_planes(points, pair)
    size = float(np.abs(np.array(corners)).max(initial=0.0))
    corners += [point.at(FAR * size) for point in points if point.unbounded]
    inner = convex_hull(np.array(corners))
    sector = _sector([point.angle for point in points], FAR * max(size, 1e-300), closed=closed)
    outer = sector
    for plane in planes:
        outer = clipped(outer, plane)
    cut_off = bool(len(outer)) and bool((np.abs(outer) > 0.99 * FAR * size).any())
    crossings = (*_beyond_planes(safe, planes, rays), *_hull_beyond(inner, points))
    worst = tuple(sorted(crossings, key=lambda one: -one.share))
    return Domain(inner, outer if len(planes) else np.zeros((0, 2)), cut_off, worst, planes)


def half_planes(points: Sequence[Point], pair: tuple[str, str]) -> tuple[FloatArray, FloatArray]:
    """Half-planes x p_x + y p_y ≤ k as rows (m, 3), and the angles of their points (m,)."""
    rows, rays = [], []
    for point in points:
        if np.isfinite(point.kinematic_bound) and all(name in point.powers for name in pair):
            rows.append((point.powers[pair[0]], point.powers[pair[1]], point.kinematic_bound))
            rays.append(point.angle)
    return np.array(rows).reshape(-1, 3), np.array(rays)


def convex_hull(points: FloatArray) -> FloatArray:
    """Corners of the convex hull of points (n, 2), counter-clockwise; by Andrew's monotone chain."""
    ordered = sorted(set(map(tuple, points.tolist())))
    if len(ordered) < 3:
        return np.array(ordered).reshape(-1, 2)
    chains = []
    for sequence in (ordered, ordered[::-1]):
        chain: list[tuple[float, float]] = []
        for point in sequence:
            while len(chain) > 1 and _turn(chain[-2], chain[-1], point) <= 0.0:
                chain.pop()
            chain.append(point)
        chains += chain[:-1]
    return np.array(chains)


def clipped(polygon: FloatArray, plane: FloatArray) -> FloatArray:
    """The part of a convex polygon (n, 2) in a half-plane (3,), by Sutherland and Hodgman (1974)."""
    if not len(polygon):
        return polygon
    ahead = polygon @ plane[:2] - plane[2]
    corners = []
    for here, there, now, then in zip(polygon, np.roll(polygon, -1, axis=0), ahead, np.roll(ahead, -1), strict=True):
        if now <= 0.0:
            corners.append(here)
        if (now < 0.0 < then) or (then < 0.0 < now):
            corners.append(here + (there - here) * (now / (now - then)))
    return np.array(corners).reshape(-1, 2)


def area(polygon: FloatArray) -> float:
    """Area of a polygon (n, 2), positive where its corners go counter-clockwise."""
    x, y = polygon[:, 0], polygon[:, 1]
    return 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) if len(polygon) else 0.0


def _is_safe(point: Point) -> bool:
    return bool(np.isfinite(point.static_bound)) and point.static_bound >= 0.0


def _turn(a: tuple[float, float], b: tuple[float, float], c: tuple[float, float]) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _sector(angles: Sequence[float], far: float, *, closed: bool) -> FloatArray:
    """The square of that half-width, or what of it lies between the first angle and the last."""
    square = far * np.array([[1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]])
    span = angles[-1] - angles[0]
    if closed or span > 180.0:
        return square
    first, last = unit_vector(angles[0]), unit_vector(angles[-1])
    sector = clipped(square, np.array([first[1], -first[0], 0.0]))
    return clipped(sector, np.array([-last[1], last[0], 0.0]))


def _beyond_planes(
    safe: Sequence[tuple[float, tuple[float, float]]], planes: FloatArray, rays: FloatArray
) -> list[Crossing]:
    """Safe points beyond a half-plane, each with the one that it passes most."""
    if not len(planes):
        return []
    places = np.array([place for _, place in safe])
    size = np.maximum(np.abs(planes[:, 2]), np.abs(places @ planes[:, :2].T))
    beyond = (places @ planes[:, :2].T - planes[:, 2]) / np.maximum(size, 1e-300)
    most = beyond.argmax(axis=1)
    share = beyond[np.arange(len(places)), most]
    return [
        Crossing(float(rays[most[row]]), safe[row][0], float(share[row]))
        for row in np.flatnonzero(share > CROSSED).tolist()
    ]


def _hull_beyond(inner: FloatArray, points: Sequence[Point]) -> list[Crossing]:
    """Rays on which the hull of safe points reaches beyond the kinematic bound."""
    found = []
    for point in points:
        bound = point.kinematic_bound
        reach = reach_along(inner, unit_vector(point.angle))
        if np.isfinite(bound) and reach - bound > CROSSED * max(abs(bound), reach):
            found.append(Crossing(point.angle, point.angle, (reach - bound) / max(abs(bound), reach)))
    return found


def reach_along(polygon: FloatArray, way: tuple[float, float]) -> float:
    """How far a convex polygon (n, 2) reaches along a ray from the origin; -inf where the ray misses it."""
    if len(polygon) < 2:
        return -np.inf
    across = polygon @ np.array([-way[1], way[0]])
    along = polygon @ np.array(way)
    rounding = 1e-12 * float(np.abs(polygon).max(initial=0.0))
    reaches = [float(along[row]) for row in np.flatnonzero(np.abs(across) <= rounding)]
    for row in range(len(polygon)):
        other = (row + 1) % len(polygon)
        if across[row] * across[other] < 0.0:
            share = across[row] / (across[row] - across[other])
            reaches.append(float(along[row] + share * (along[other] - along[row])))
    return max((reach for reach in reaches if reach >= 0.0), default=-np.inf)
