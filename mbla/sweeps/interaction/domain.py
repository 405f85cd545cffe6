r"""What the points prove of the safe domain: a polygon inside of it, a polygon around it, and whether they agree.

With associative flow the loads (x, y) that a structure carries are a convex set (lower-bound theorem: forces of two
states, mixed, carry the mixed loads within convex yield conditions). So

- the convex hull of points that static bounds prove safe is safe: the inner polygon. The dead load alone, at the
  origin, is such a point where the structure stands under it, and so is all of a ray on which no factor brings
  collapse;
- every mechanism bounds the entire set by a half-plane x p_x + y p_y ≤ k (:mod:`mbla.results.record.json_record`), with
  the powers p of the two loads: their intersection is the outer polygon.

The set lies between the two. Safe points beyond a half-plane would show that a bound is wrong: an error of
verification, which is reported. Without associative flow there is no such theorem; the domain drawn is that of
associative flow, and the load factors of the deck's own flow rule lie inside of it.

M. A. Save, C. E. Massonnet: Plastic analysis and design of plates, shells and disks, 1972: the domain of loads that are
carried is convex in the space of the load parameters.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely

from mbla.arrays import FloatArray
from mbla.solution.thresholds import GAP_TOLERANCE
from mbla.sweeps.answers import Answer, Answers, answers_of, numbers_of
from mbla.sweeps.design.directions import horizontal
from mbla.sweeps.interaction.question import InteractionQuestion
from mbla.sweeps.tables.sweep_table import SweepTable

CROSSED = GAP_TOLERANCE
"""relative distance by which safe points may pass a bound: up to which the two bounds of a point count as one"""
FAR = 10.0
"""edge of the picture in which an unbounded domain is cut off, over the farthest point"""


@dataclass(frozen=True)
class RayPoints:
    """The points of a diagram.

    factors       : load factors by the deck's flow rule
    ways          : (n, 2) cosine and sine of each angle
    static, kinematic : (n,) bounds of associative flow; nan where there are none
    powers        : (n, 2) of the two live loads in the mechanism of the kinematic bound; nan where they are not known
    stands        : the structure stands under the dead load alone
    """

    factors: Answers
    ways: FloatArray
    static: FloatArray
    kinematic: FloatArray
    powers: FloatArray
    stands: bool

    @property
    def known(self) -> FloatArray:
        """(n,) verified load factors; nan where there is none."""
        return np.where(self.factors.good, self.factors.values, np.nan)

    @property
    def places(self) -> FloatArray:
        """(n, 2) coordinates in the diagram of the verified load factors."""
        return np.asarray(self.known[:, None] * self.ways)


def points_of(table: SweepTable, question: InteractionQuestion) -> RayPoints:
    """The points of the table of a diagram."""
    columns = {column.name: column for column in table.of_role("result")}

    def figures(name: str) -> FloatArray:
        return numbers_of(columns[name], table[name]) if name in columns else np.full(len(table), np.nan)

    return RayPoints(
        factors=answers_of(table, columns["load_factor"]),
        ways=np.array([horizontal(angle, 1.0) for angle in question.angles]),
        static=figures("static_bound"),
        kinematic=figures("kinematic_bound"),
        powers=np.stack([figures(f"powers.{name}") for name in question.pair or ("", "")], axis=1),
        stands="yes" in table["standing.verdict"].tolist(),
    )


@dataclass(frozen=True)
class Domain:
    """Polygons of shapely about the safe domain of associative flow.

    inner   : convex hull of safe points
    outer   : intersection of half-planes, within the sector of the angles; empty where there is no half-plane
    cut_off : the outer polygon ends at an edge that no mechanism draws
    crossed : largest relative distance of a safe point beyond a half-plane; 0 where none is
    closed  : the angles go all around
    """

    inner: Any
    outer: Any
    cut_off: bool
    crossed: float
    closed: bool

    @property
    def gap(self) -> float:
        """Area between the polygons over the area of the outer one; nan where it is not bounded."""
        bounded = not self.cut_off and self.outer.area > 0.0
        return 1.0 - self.inner.area / self.outer.area if bounded else float("nan")

    @property
    def everywhere(self) -> float | None:
        """What associative flow carries at least at every angle, those between the points among them.

        The distance of the inner polygon's nearest side from the origin; None where it does not lie around the origin,
        or where a bound is in doubt.
        """
        origin = shapely.Point(0.0, 0.0)
        around = self.closed and not self.crossed and self.inner.contains(origin) and self.inner.area > 0.0
        return float(self.inner.exterior.distance(origin)) if around else None


def domain_of(points: RayPoints, question: InteractionQuestion) -> Domain | None:
    """The domain that points in the plane of two loads prove; None where none of them has bounds."""
    safe = points.static >= 0.0
    if not question.pair or not safe.any():
        return None
    corners = points.static[safe, None] * points.ways[safe]
    if points.stands:
        corners = np.vstack([corners, np.zeros(2)])
    far = FAR * max(float(np.abs(corners).max()), 1e-300)
    corners = np.vstack([corners, far * points.ways[points.factors.of(Answer.UNBOUNDED)]])
    bounded = np.isfinite(points.kinematic) & np.isfinite(points.powers).all(axis=1)
    planes = np.column_stack([points.powers, points.kinematic])[bounded]
    outer = far * np.array([[1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]])
    if not question.closed and question.angles[-1] - question.angles[0] <= 180.0:  # the sector of the angles
        (first, last) = points.ways[0], points.ways[-1]
        outer = clipped(clipped(outer, np.array([first[1], -first[0], 0.0])), np.array([-last[1], last[0], 0.0]))
    for plane in planes:
        outer = clipped(outer, plane)
    along = corners @ planes[:, :2].T
    size = np.maximum(np.maximum(np.abs(planes[:, 2]), np.abs(along)), 1e-300)
    crossed = float(((along - planes[:, 2]) / size).max(initial=0.0))
    return Domain(
        inner=shapely.MultiPoint(corners).convex_hull,
        outer=shapely.Polygon(outer if len(planes) and len(outer) > 2 else None),
        cut_off=bool((np.abs(outer) > 0.99 * far).any()),
        crossed=crossed if crossed > CROSSED else 0.0,
        closed=question.closed,
    )


def corners_of(shape: Any) -> FloatArray:
    """Corners (n, 2) of a polygon, counter-clockwise, each once; the ends of what has no area."""
    if shape.geom_type != "Polygon":
        return np.asarray(shapely.get_coordinates(shape))
    return np.asarray(shapely.get_coordinates(shapely.orient_polygons(shape))[:-1])


def clipped(polygon: FloatArray, plane: FloatArray) -> FloatArray:
    """The part of a convex polygon (n, 2) in a half-plane (3,), by Sutherland and Hodgman (1974)."""
    ahead = polygon @ plane[:2] - plane[2]
    corners = []
    for here, there, now, then in zip(polygon, np.roll(polygon, -1, axis=0), ahead, np.roll(ahead, -1), strict=True):
        if now <= 0.0:
            corners.append(here)
        if (now < 0.0 < then) or (then < 0.0 < now):
            corners.append(here + (there - here) * (now / (now - then)))
    return np.array(corners).reshape(-1, 2)
