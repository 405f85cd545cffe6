"""Shapes of interfaces as the convex contact model needs them: hull, rectangle or not, torsional radius, triangles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, row_of_item, starts
from mbla.assembly.ties import without_ties
from mbla.contacts.contacts import Contacts
from mbla.model.solids.convex import convex_loops, signed_areas
from mbla.model.solids.polygons import convex_hulls
from mbla.model.solids.ragged import items_of_rows, next_item, row_sums
from mbla.program.resultants.friction_curve import disc_radius, fitted_curves, rectangle_curve

STRAIGHT = 1e-6
"""Sine of the turn at a corner below which it is no corner: points on an edge are needless here."""

SQUARE_CORNERS = 1e-6
"""Relative deviation up to which an outline counts as a rectangle."""

SOLID = 1e-6
"""Relative area that holes must take to count."""


@dataclass(frozen=True)
class InterfaceShapes:
    """Interfaces in their planes, coordinates along tangent 1 and tangent 2 from the centroid [m].

    corners    : (n_corners, 2) of the convex hulls, counter-clockwise
    start      : (n_interfaces + 1,)
    convex     : (n_interfaces,) the interface is its hull, without holes
    rectangles : (n_interfaces,) the hull is a rectangle and the interface fills it
    sides      : (n_interfaces, 2) lengths of a rectangle, else zero
    axes       : (n_interfaces, 2, 2) unit vectors along both sides of a rectangle (rows)
    radii      : (n_interfaces,) torsional radius ρ [m]
    thetas     : (n_interfaces,) θ of the friction curve
    """

    corners: FloatArray
    start: IntArray
    convex: BoolArray
    rectangles: BoolArray
    sides: FloatArray
    axes: FloatArray
    radii: FloatArray
    thetas: FloatArray

    @property
    def interface_of_corner(self) -> IntArray:
        """(n_corners,)."""
        return row_of_item(self.start)

    @property
    def parallelograms(self) -> BoolArray:
        """Interfaces whose hull has four corners and parallel edges, and that fill it, (n_interfaces,)."""
        found = np.zeros(len(self.convex), dtype=bool)
        rows = np.flatnonzero(self.convex & (np.diff(self.start) == 4))
        loops = self.corners[self.start[rows][:, None] + np.arange(4)]
        off = np.linalg.norm(loops[:, 0] + loops[:, 2] - loops[:, 1] - loops[:, 3], axis=1)
        found[rows] = off <= SQUARE_CORNERS * np.linalg.norm(loops, axis=2).max(axis=1, initial=0.0)
        return found

    def edge_slopes(self) -> FloatArray:
        """ν/d of the edge that leaves each corner, (n_corners, 2) [1/m]: x is inside where 1 − x·ν/d ≥ 0 for all."""
        following = self.corners[next_item(self.start)]
        edge = following - self.corners
        outward = np.column_stack([edge[:, 1], -edge[:, 0]])
        return np.asarray(outward / (outward * self.corners).sum(axis=1)[:, None])


def local_points(contacts: Contacts) -> FloatArray:
    """Contact points along tangent 1 and tangent 2 from the centroid of their interface, (n_points, 2) [m]."""
    arm = contacts.points - contacts.centroids[contacts.interface_of_point]
    return np.asarray(np.einsum("pjx,px->pj", contacts.frames[:, 1:], arm))


def interface_shapes(contacts: Contacts) -> InterfaceShapes:
    """Shapes of all interfaces."""
    n = contacts.n_surfaces
    if n < len(contacts):
        return _with_ties(interface_shapes(without_ties(contacts)), len(contacts) - n)
    if n == 0:
        none, empty = np.zeros(0, dtype=bool), np.zeros((0, 2))
        return InterfaceShapes(empty, starts(none), none, none, empty, np.zeros((0, 2, 2)), np.zeros(0), np.zeros(0))
    outlines, outline_start = outer_boundaries(contacts)
    convex_outline = convex_loops(outlines, outline_start)
    solid = signed_areas(outlines, outline_start) <= contacts.areas * (1.0 + SOLID)
    corners, start = _hulls(outlines, outline_start, convex_outline)
    rectangles, sides, axes = _rectangles(corners, start, convex_outline & solid)
    radii, thetas = disc_radius(contacts.areas), np.ones(n)  # outlines with holes: the least that is possible
    radii[rectangles], thetas[rectangles] = rectangle_curve(sides[rectangles])[:2]
    _fit(outlines, outline_start, solid & ~rectangles & ~convex_outline, radii, thetas)
    _fit(corners, start, solid & ~rectangles & convex_outline, radii, thetas)
    return InterfaceShapes(corners, start, convex_outline & solid, rectangles, sides, axes, radii, thetas)


def _with_ties(shapes: InterfaceShapes, n_ties: int) -> InterfaceShapes:
    """Shapes with those of ties, for which a triangle stands: none has torsion or crushing."""
    triangle = np.array([[-1.0, -1.0], [2.0, -1.0], [-1.0, 2.0]])
    none = np.zeros(n_ties, dtype=bool)
    return InterfaceShapes(
        np.vstack([shapes.corners, np.tile(triangle, (n_ties, 1))]),
        np.append(shapes.start, shapes.start[-1] + 3 * np.arange(1, n_ties + 1)),
        np.append(shapes.convex, none),
        np.append(shapes.rectangles, none),
        np.vstack([shapes.sides, np.zeros((n_ties, 2))]),
        np.concatenate([shapes.axes, np.zeros((n_ties, 2, 2))]),
        np.append(shapes.radii, np.ones(n_ties)),
        np.append(shapes.thetas, np.ones(n_ties)),
    )


def outer_boundaries(contacts: Contacts) -> tuple[FloatArray, IntArray]:
    """Outer boundaries, (n_corners, 2), and their starts."""
    position = np.arange(len(contacts.points)) - contacts.point_start[contacts.interface_of_point]
    outer = position < contacts.outline[contacts.interface_of_point]
    return local_points(contacts)[outer], starts(contacts.outline.astype(np.int64))


def _hulls(outlines: FloatArray, start: IntArray, convex: BoolArray) -> tuple[FloatArray, IntArray]:
    """Convex hulls: convex outlines without the points on their edges, the hulls of the others."""
    loops = items_of_rows(start, np.flatnonzero(convex))
    straight_start = starts(np.diff(start)[convex])
    corner = _turns(outlines[loops], straight_start) > STRAIGHT
    counts = np.zeros(len(convex), dtype=np.int64)
    counts[convex] = row_sums(corner.astype(np.float64), straight_start).astype(np.int64) if convex.any() else 0
    if convex.all():
        return outlines[loops][corner], starts(counts)
    rest = np.flatnonzero(~convex)
    hull_points, hull_start = convex_hulls(outlines[items_of_rows(start, rest)], starts(np.diff(start)[rest]))
    counts[rest] = np.diff(hull_start)
    hulls_at = starts(counts)
    corners = np.zeros((hulls_at[-1], 2))
    corners[items_of_rows(hulls_at, np.flatnonzero(convex))] = outlines[loops][corner]
    corners[items_of_rows(hulls_at, rest)] = hull_points
    return corners, hulls_at


def _turns(points: FloatArray, start: IntArray) -> FloatArray:
    """Sine of the turn at each corner, positive to the left."""
    following = next_item(start)
    leaving = points[following] - points
    arriving = np.empty_like(leaving)
    arriving[following] = leaving
    cross = arriving[:, 0] * leaving[:, 1] - arriving[:, 1] * leaving[:, 0]
    return np.asarray(cross / np.maximum(np.hypot(*arriving.T) * np.hypot(*leaving.T), 1e-300))


def _rectangles(
    corners: FloatArray, start: IntArray, candidates: BoolArray
) -> tuple[BoolArray, FloatArray, FloatArray]:
    """Which hulls are rectangles, with their sides and the directions of these."""
    n = len(candidates)
    rectangles, sides, axes = np.zeros(n, dtype=bool), np.zeros((n, 2)), np.zeros((n, 2, 2))
    rows = np.flatnonzero(candidates & (np.diff(start) == 4))
    if len(rows):
        loops = corners[items_of_rows(start, rows)].reshape(-1, 4, 2)
        edges = np.roll(loops, -1, axis=1) - loops
        length = np.hypot(edges[..., 0], edges[..., 1])
        skew = np.abs((edges[:, 0] * edges[:, 1]).sum(axis=1)) / (length[:, 0] * length[:, 1])
        open_by = np.abs(edges[:, 0] + edges[:, 2]).max(axis=1) / length.max(axis=1)
        right = (skew <= SQUARE_CORNERS) & (open_by <= SQUARE_CORNERS * length.min(axis=1) / length.max(axis=1))
        chosen = rows[right]
        rectangles[chosen] = True
        first = edges[right, 0] - edges[right, 2]
        first /= np.hypot(first[:, 0], first[:, 1])[:, None]
        # both exactly at right angles, whatever the tolerance lets pass: conditions and checks rely on it
        axes[chosen] = np.stack([first, np.column_stack([-first[:, 1], first[:, 0]])], axis=1)
        sides[chosen] = 0.5 * (length[right, :2] + length[right, 2:])
    return rectangles, sides, axes


def _fit(points: FloatArray, start: IntArray, chosen: BoolArray, radii: FloatArray, thetas: FloatArray) -> None:
    """Radii and θ of the chosen outlines, in place; outlines with alike numbers of corners together."""
    counts = np.diff(start)
    for count in np.unique(counts[chosen]):
        rows = np.flatnonzero(chosen & (counts == count))
        loops = points[items_of_rows(start, rows)].reshape(len(rows), int(count), 2)
        radii[rows], thetas[rows] = fitted_curves(loops)


@dataclass(frozen=True)
class Fan:
    """Outlines in triangles: interface of each, its corners (n_triangles, 3), its share of the area."""

    interface: IntArray
    corners: IntArray
    share: FloatArray

    @classmethod
    def of(cls, shapes: InterfaceShapes) -> Fan:
        """Fans from the first corner of each outline."""
        counts = np.diff(shapes.start)
        start = starts(np.maximum(counts - 2, 0))
        interface = row_of_item(start)
        first, place = shapes.start[interface], np.arange(len(interface)) - start[interface]
        corners = np.stack([first, first + place + 1, first + place + 2], axis=1)
        x = shapes.corners[corners]
        one, two = x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]
        area = 0.5 * (one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0])
        return cls(interface, corners, area / np.bincount(interface, area, len(counts))[interface])

    @classmethod
    def of_some(cls, shapes: InterfaceShapes, rows: IntArray) -> Fan:
        """Those of the interfaces ``rows``, (n,), which are numbered in that order."""
        fan, place = cls.of(shapes), np.full(len(shapes.convex), -1)
        place[rows] = np.arange(len(rows))
        chosen = place[fan.interface] >= 0
        return cls(place[fan.interface[chosen]], fan.corners[chosen], fan.share[chosen])


def second_moments(shapes: InterfaceShapes, rows: IntArray) -> FloatArray:
    """Second moments of area of interfaces about their centroids, over the area, (n, 2, 2) [m²]."""
    fan = Fan.of_some(shapes, rows)
    x = shapes.corners[fan.corners]
    total = x.sum(axis=1)
    second = np.einsum("tci,tcj->tij", x, x) + total[:, :, None] * total[:, None, :]
    moments = np.zeros((len(rows), 2, 2))
    np.add.at(moments, fan.interface, fan.share[:, None, None] * second / 12.0)
    return moments


def mean_positive(values: FloatArray) -> FloatArray:
    """Mean over a triangle of the positive part of a linear function with given values at the corners, (..., 3)."""
    return np.asarray((corner_weights(values) * values).sum(axis=-1))


def positive_share(values: FloatArray) -> FloatArray:
    """Share of a triangle where a linear function with given values at the corners, (..., 3), is positive, (...,)."""
    low, middle, high = np.sort(values, axis=-1).T
    with np.errstate(divide="ignore", invalid="ignore"):  # of the two parts the one that is not there
        above = high / (high - low) * (high / (high - middle))
        below = low / (middle - low) * (low / (high - low))
    share = np.where(middle > 0.0, np.where(low > 0.0, 1.0, 1.0 - below), np.where(high > 0.0, above, 0.0))
    return np.asarray(share.T)


def corner_weights(values: FloatArray) -> FloatArray:
    """Mean over a triangle of the barycentric coordinates where a linear function is positive, (..., 3).

    Where only corner i is positive the part is the triangle that ends at shares t_j = v_i/(v_i − v_j) of its edges,
    with the area Π t_j and the coordinates t_j/3 of the other corners in its centroid. Where only k is not it is a
    quadrilateral, of two triangles, with the shares t_i = v_i/(v_i − v_k). No difference of near numbers is taken, so
    that parts of any size have all their digits.
    """
    positive = values > 0
    count = positive.sum(axis=-1, keepdims=True)
    single = np.where(count == 1, positive, (count == 2) & ~positive)
    apex = np.where(single, values, 0.0).sum(axis=-1, keepdims=True)
    over = np.where(count == 1, apex, values)
    span = np.where(count == 1, apex - values, values - apex)
    t = np.divide(over, span, out=np.zeros_like(values), where=~single & (span != 0.0))
    total, product = t.sum(axis=-1, keepdims=True), np.where(single, 1.0, t).prod(axis=-1, keepdims=True)
    triangle = product * np.where(single, 3.0 - total, t)
    others = total - t + t * (2.0 - t) - 2.0 * product + t * product
    quadrilateral = np.where(single, total**2 - product - product * total, others)
    return np.asarray(np.select([count == 1, count == 2, count == 3], [triangle, quadrilateral, 1.0]) / 3.0)
