r"""What the points prove of the safe domain: a polygon inside of it, a polygon around it, and whether they agree.

With associative flow the loads (x, y) that a structure carries are a convex set (lower-bound theorem: forces of two
states, mixed, carry the mixed loads within convex yield conditions). So

- the convex hull of points that static bounds prove safe is safe: the inner polygon. The dead load alone, at the
  origin, is such a point where the structure stands under it, and so is all of a ray on which no factor brings
  collapse;
- every mechanism bounds the whole set by a half-plane x p_x + y p_y ≤ k (:mod:`mbla.results.record.json_record`), with
  the powers p of the two loads: their intersection is the outer polygon.

The set lies between the two. Safe points beyond a half-plane, or a hull beyond the kinematic bound of a ray, would show
that a bound is wrong: an error of verification, which is told. Without associative flow there is no such theorem; the
domain drawn is that of associative flow, and the load factors of the deck's own flow rule lie inside of it.

M. A. Save, C. E. Massonnet: Plastic analysis and design of plates, shells and disks, 1972: the domain of loads that are
carried is convex in the space of the load parameters.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import shapely

from mbla.arrays import FloatArray
from mbla.solution.solution import Status
from mbla.solution.thresholds import GAP_TOLERANCE
from mbla.sweeps.design.directions import horizontal
from mbla.sweeps.plan import DONE, Outcome

RESULTS = (
    "status",
    "verified",
    "load_factor",
    "associative_load_factor",
    "static_bound",
    "kinematic_bound",
    "standing.verdict",
    "mechanism.class",
)
"""what of the record of a load case a diagram is made from, beside the powers of a pair of loads"""
POWER = "powers."
NAN = math.nan


@dataclass(frozen=True)
class Point:
    """The answer at an angle in degrees.

    answered     : verified: there is a load factor, or it is verified that there is none
    exit_code    : that a run of this point alone ends with
    status       : of the load case; empty where it was not solved at all
    load_factor  : by the deck's flow rule, nan where there is none
    associative  : by associative flow, with its bounds; nan where there are none
    standing     : verdict on the dead load alone; empty where there is none
    mechanism    : class of the mechanism in a word; empty where there is none
    powers       : of live loads in the mechanism of the kinematic bound, by load case
    reason       : in one line, empty where there is nothing to say
    """

    angle: float
    answered: bool
    exit_code: int
    status: str
    load_factor: float
    associative: float
    static_bound: float
    kinematic_bound: float
    standing: str = ""
    mechanism: str = ""
    powers: Mapping[str, float] = field(default_factory=dict)
    reason: str = ""
    seconds: float = NAN

    @property
    def has_factor(self) -> bool:
        """Whether a verified load factor is there."""
        return self.answered and not math.isnan(self.load_factor)

    @property
    def unbounded(self) -> bool:
        """Whether it is verified that the load never brings collapse."""
        return self.answered and self.status == Status.UNBOUNDED

    def at(self, factor: float) -> tuple[float, float]:
        """Coordinates in the diagram at a load factor on this ray."""
        cosine, sine = horizontal(self.angle, 1.0)
        return factor * cosine, factor * sine


def point_of(angle: float, outcome: Outcome) -> Point:
    """The point that an outcome is."""
    results: Mapping[str, Any] = outcome.results

    def figure(name: str) -> float:
        value = results.get(name)
        return NAN if value is None else float(value)

    return Point(
        angle=angle,
        answered=outcome.state == DONE,
        exit_code=outcome.exit_code,
        status=results.get("status") or "",
        load_factor=figure("load_factor"),
        associative=figure("associative_load_factor"),
        static_bound=figure("static_bound"),
        kinematic_bound=figure("kinematic_bound"),
        standing=results.get("standing.verdict") or "",
        mechanism=results.get("mechanism.class") or "",
        powers={
            name.removeprefix(POWER): float(value)
            for name, value in results.items()
            if name.startswith(POWER) and value is not None
        },
        reason=" ".join(outcome.reason.split()),
        seconds=outcome.seconds,
    )


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
    """Corners of the convex hull of points (n, 2), counter-clockwise; its two ends where it has no area."""
    hull = shapely.convex_hull(shapely.multipoints(points))
    if hull.geom_type != "Polygon":
        return np.array(sorted(shapely.get_coordinates(hull).tolist())).reshape(-1, 2)
    corners: FloatArray = shapely.get_coordinates(shapely.orient_polygons(hull))[:-1]
    return np.roll(corners, -int(np.lexsort(corners.T[::-1])[0]), axis=0)


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


def _sector(angles: Sequence[float], far: float, *, closed: bool) -> FloatArray:
    """The square of that half-width, or what of it lies between the first angle and the last."""
    square = far * np.array([[1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]])
    span = angles[-1] - angles[0]
    if closed or span > 180.0:
        return square
    first, last = horizontal(angles[0], 1.0), horizontal(angles[-1], 1.0)
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
        reach = reach_along(inner, horizontal(point.angle, 1.0))
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


SAME = 1e-5
"""relative difference up to which load factors are one: to which a solved one may be uncertain"""


@dataclass(frozen=True)
class Extreme:
    """A load factor and the angles at which it is found, degrees."""

    load_factor: float
    angles: tuple[float, ...]


def extremes(points: Sequence[Point]) -> tuple[Extreme, Extreme] | None:
    """The least and the greatest of the verified load factors; None where there is none."""
    known = [point for point in points if point.has_factor]
    if not known:
        return None
    return _extreme(known, min(point.load_factor for point in known)), _extreme(
        known, max(point.load_factor for point in known)
    )


def _extreme(points: Sequence[Point], value: float) -> Extreme:
    room = SAME * max(abs(value), 1e-300)
    return Extreme(value, tuple(point.angle for point in points if abs(point.load_factor - value) <= room))


def everywhere(domain: Domain | None, *, closed: bool) -> float | None:
    """What associative flow carries at least at every angle, those between the points among them.

    The distance of the inner polygon's nearest side from the origin; None where it does not lie around the origin, or
    where a bound is in doubt.
    """
    if domain is None or not closed or domain.crossings or len(domain.inner) < 3:
        return None
    here, there = domain.inner, np.roll(domain.inner, -1, axis=0)
    sides = there - here
    outside = (here[:, 0] * there[:, 1] - here[:, 1] * there[:, 0]) / np.linalg.norm(sides, axis=1)
    return float(outside.min()) if outside.min() > 0.0 else None
