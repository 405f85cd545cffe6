"""Crushing of interfaces as stress blocks, in pieces that act side by side: conditions as functions of resultants.

A stress σ between 0 and f_c carries N = ∫σ and first moments ∫σ x. What such fields carry over a parallelogram or a
triangle is bounded by two kinds of inequalities, and by no others. With N' = N + f_t A and F = (f_c + f_t) A, for a
tensile strength f_t shifts the origin exactly, each is concave and has the dimension of a force::

    edges    Q − (N'² + 3 P²)/F ≥ 0              corners   √(Q_1 Q_2) − L^1.5/√(K F) ≥ 0

A corner holds with equality where full stress covers a triangle at it, or all but a triangle; an edge where full stress
ends on both edges of the other pair: N(y), the force of the strip at y, has its first moment at least N(y)²/2f_c from
the edge, and ∫N(y)² is least, with N and its moment along y given, where N(y) is linear.

Q, P and L are linear in the resultants r of a piece; N', Q_i = N' ∓ P_i and those of the complement, F − N' and −P, for
a parallelogram, of K = 9/8; for a triangle the forces at its corners, K = 9. Another convex outline is a fan of
triangles about its centroid, one that is not convex any triangles of its corners: fields of stress add up, so that
nothing is lost by dividing it.

In the plane stress may be taken constant across it, so that only the width of an outline along the plane counts. Where
that is constant a strip carries N' ∓ P − N'²/F ≥ 0; where it grows from zero it is a triangle that is its own mirror
image. Any width that is linear between its kinks is a sum of both.

Resultants are r = (N, Σ n x_1/ρ, Σ n x_2/ρ) about the centroid of the interface, ρ = √A, in the plane r = (N, Σ n s/ρ).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, fields, replace
from functools import cached_property

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.solids.polygons import polygons_from_rings, triangles
from mbla.program.resultants.shapes import InterfaceShapes

OF_PARALLELOGRAM, OF_TRIANGLE = 1.125, 9.0
"""K."""

THIN = 1e-9
"""Width or length of a piece, over that of the interface, up to which it is rounding."""


@dataclass(frozen=True)
class Pieces:
    """Pieces with equally many conditions; r has c components.

    owner    : (m,) interface to which each belongs
    strength : (m,) F [force]
    tension  : (m,) f_t times the area of the piece [force]
    centre   : (c, m) r of a force of 1 in its middle
    edges    : (n_edges, 3, 1 + c, m) Q, N', P as linear forms of 1 and r
    corners  : (n_corners, 3, 1 + c, m) Q_1, Q_2, L
    factor   : K
    """

    owner: IntArray
    strength: FloatArray
    tension: FloatArray
    centre: FloatArray
    edges: FloatArray
    corners: FloatArray
    factor: float

    @property
    def n_conditions(self) -> int:
        """Conditions of one piece."""
        return len(self.edges) + len(self.corners)

    def only(self, chosen: IntArray) -> Pieces:
        """Some of them."""
        named = (each.name for each in fields(self) if each.name != "factor")
        return replace(self, **{name: getattr(self, name)[..., chosen] for name in named})

    def values(self, resultants: FloatArray) -> FloatArray:
        """Of the conditions, (n_conditions, m), at r, (c, m): the lesser of Q_1 and Q_2 where one is negative."""
        (q, n, p), (first, second, lead) = self.forms(resultants)
        root = np.where((first > 0.0) & (second > 0.0), np.sqrt(np.abs(first * second)), np.minimum(first, second))
        at_edges = q - (n * n + 3.0 * p * p) / self.strength
        return np.concatenate([at_edges, root - np.maximum(lead, 0.0) ** 1.5 / self.root])

    def forms(self, resultants: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Linear forms of edges, (3, n_edges, m), and of corners, (3, n_corners, m)."""
        edges, corners = (
            constant + sum(slope * own for slope, own in zip(slopes, resultants, strict=True))
            for constant, slopes in self._linear
        )
        return edges, corners

    @cached_property
    def root(self) -> FloatArray:
        """√(K F), (m,)."""
        return np.asarray(np.sqrt(self.factor * self.strength))

    @cached_property
    def _linear(self) -> list[tuple[FloatArray, list[FloatArray]]]:
        """Constants of the forms of edges and corners, (3, k, m), and their factors of each resultant."""
        forms = [np.ascontiguousarray(own.transpose(2, 1, 0, 3)) for own in (self.edges, self.corners)]
        return [(own[0], list(own[1:])) for own in forms]


@dataclass(frozen=True)
class Plates:
    """Places and strengths of pieces, before their conditions.

    owner : (m,)         share : (m,) of the area of the interface
    gauge : (m, d, c) from r to what the conditions are written in: (N, P_1, ...) or (N, p_1, p_2)
    centre : (m, c)
    """

    owner: IntArray
    share: FloatArray
    gauge: FloatArray
    centre: FloatArray

    @classmethod
    def of(cls, found: Iterable[tuple[int, float, FloatArray, FloatArray]], size: int, components: int) -> Plates:
        """Of pieces one by one: owner, share, gauge, centre."""
        rows = list(found)
        return cls(
            np.array([row[0] for row in rows], dtype=np.int64),
            np.array([row[1] for row in rows], dtype=np.float64),
            np.array([row[2] for row in rows], dtype=np.float64).reshape(len(rows), size, components),
            np.array([row[3] for row in rows], dtype=np.float64).reshape(len(rows), components),
        )


def pieces_in_space(
    shapes: InterfaceShapes, outlines: list[FloatArray], rows: IntArray, radii: FloatArray
) -> tuple[Plates, Plates]:
    """Parallelograms, and triangles, of the interfaces ``rows``; owners are places in it.

    outlines : (n_corners, 2) of each of these [m]
    radii    : (n_interfaces,) ρ
    """
    return _parallelograms(shapes, rows, radii), _triangles(shapes, outlines, rows, radii)


def _parallelograms(shapes: InterfaceShapes, rows: IntArray, radii: FloatArray) -> Plates:
    own = np.flatnonzero(shapes.parallelograms[rows])
    four = rows[own]
    slopes = shapes.edge_slopes()[shapes.start[four][:, None] + np.arange(4)]
    gauge = np.zeros((len(own), 3, 3))
    gauge[:, 0, 0] = 1.0
    gauge[:, 1:, 1:] = 0.5 * (slopes[:, :2] - slopes[:, 2:]) * radii[four][:, None, None]
    return Plates(own, np.ones(len(own)), gauge, np.tile([1.0, 0.0, 0.0], (len(own), 1)))


def _triangles(shapes: InterfaceShapes, outlines: list[FloatArray], rows: IntArray, radii: FloatArray) -> Plates:
    """Fans about the centroid, or any triangles of the corners where the outline is not convex."""
    found = []
    for place in np.flatnonzero(~shapes.parallelograms[rows]).tolist():
        row, x = rows[place], outlines[place] / radii[rows[place]]
        following = np.roll(x, -1, axis=0)
        loops = x[None] if len(x) == 3 else np.stack([np.zeros_like(x), x, following], axis=1)
        if not shapes.convex[row]:
            loops = triangles(polygons_from_rings(x, np.array([0, len(x)]), np.zeros(1, dtype=np.int64)))[0]
        first, second = loops[:, 1] - loops[:, 0], loops[:, 2] - loops[:, 0]
        area = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
        of_corners = np.concatenate([np.ones((len(loops), 1, 3)), loops.transpose(0, 2, 1)], axis=1)
        forces = np.linalg.inv(of_corners)
        for loop, share, corner in zip(loops, area / area.sum(), forces, strict=True):
            gauge = np.vstack([[1.0, 0.0, 0.0], corner[:2]])
            found.append((place, float(share), gauge, np.append(1.0, loop.mean(axis=0))))
    return Plates.of(found, 3, 3)


def pieces_in_plane(places: list[list[FloatArray]], radii: FloatArray) -> tuple[Plates, Plates]:
    """Strips of one width, and triangles, of outlines seen along the plane.

    places : of each interface its outlines, (n_corners, 2) counter-clockwise, the first coordinate along the plane
    radii  : (n,) ρ
    """
    strips, ramps = [], []
    for owner, (outlines, rho) in enumerate(zip(places, radii.tolist(), strict=True)):
        kinks, widths = _widths(outlines)
        area = 0.5 * float((np.diff(kinks) * widths.sum(axis=1)).sum())
        for start, end, (left, right) in zip(kinks[:-1] / rho, kinks[1:] / rho, widths / rho, strict=True):
            whole, part = min(left, right), abs(right - left)
            length, over = end - start, rho**2 / area
            middle = 0.5 * (start + end)
            if whole > THIN:
                gauge = np.array([[1.0, 0.0], [-2.0 * middle / length, 2.0 / length]])
                strips.append((owner, whole * length * over, gauge, np.array([1.0, middle])))
            if part > THIN:
                tip, base = (start, end) if right > left else (end, start)
                at_base = np.array([-tip, 1.0]) / (2.0 * (base - tip))
                centre = np.array([1.0, (tip + 2.0 * base) / 3.0])
                gauge = np.stack([np.array([1.0, 0.0]), at_base, at_base])
                ramps.append((owner, 0.5 * part * length * over, gauge, centre))
    return Plates.of(strips, 2, 2), Plates.of(ramps, 3, 2)


def _widths(outlines: list[FloatArray]) -> tuple[FloatArray, FloatArray]:
    """Kinks of the width along the first coordinate, (n + 1,), and widths at both ends of each part, (n, 2)."""
    along = np.sort(np.concatenate([outline[:, 0] for outline in outlines]))
    least = THIN * (along[-1] - along[0])
    kinks = along[np.diff(along, prepend=-np.inf) > least]
    widths = np.zeros((len(kinks) - 1, 2))
    for outline in outlines:
        at = np.searchsorted(kinks, outline[:, 0] + least, side="right") - 1
        following = np.roll(np.arange(len(outline)), -1)
        for i, j in enumerate(following.tolist()):
            spans = np.arange(min(at[i], at[j]), max(at[i], at[j]))
            if len(spans):
                ends = np.stack([kinks[spans], kinks[spans + 1]], axis=1)
                share = (ends - outline[i, 0]) / (outline[j, 0] - outline[i, 0])
                across = outline[i, 1] + share * (outline[j, 1] - outline[i, 1])
                widths[spans] += across if at[j] < at[i] else -across
    return kinks, np.maximum(widths, 0.0)


def with_conditions(plates: Plates, kind: str, strength: FloatArray, tension: FloatArray) -> Pieces:
    """Pieces with their conditions.

    kind     : ``strip``, ``parallelogram`` or ``triangle``
    strength, tension : (n_interfaces,) F and f_t A [force]
    """
    total, pulled = strength[plates.owner] * plates.share, tension[plates.owner] * plates.share
    y = np.concatenate([np.zeros((len(total), plates.gauge.shape[1], 1)), plates.gauge], axis=2).transpose(1, 2, 0)
    one = np.zeros_like(y[0])
    one[0] = 1.0
    if kind == "strip":
        edges, corners = _of_strips(y, pulled * one), np.zeros((0, 3, *one.shape))
    elif kind == "parallelogram":
        normal = y[0] + pulled * one
        edges = np.stack([np.stack([normal - s * y[i], normal, y[3 - i]]) for i in (1, 2) for s in (1.0, -1.0)])
        corners = np.concatenate([_corners_of(normal, y[1], y[2]), _corners_of(total * one - normal, -y[1], -y[2])])
    else:
        edges, corners = np.zeros((0, 3, *one.shape)), _of_triangles(y, total * one, pulled * one)
    factor = OF_TRIANGLE if kind == "triangle" else OF_PARALLELOGRAM
    return Pieces(plates.owner, total, pulled, plates.centre.T, edges, corners, factor)


def _of_strips(y: FloatArray, pulled: FloatArray) -> FloatArray:
    normal = y[0] + pulled
    return np.stack([np.stack([normal - sign * y[1], normal, 0.0 * y[1]]) for sign in (1.0, -1.0)])


def _corners_of(normal: FloatArray, first: FloatArray, second: FloatArray) -> FloatArray:
    signs = ((1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0))
    return np.stack([np.stack([normal - s * first, normal - t * second, normal]) for s, t in signs])


def _of_triangles(y: FloatArray, total: FloatArray, pulled: FloatArray) -> FloatArray:
    normal = y[0] + pulled
    forces = [y[1] + pulled / 3.0, y[2] + pulled / 3.0]
    forces.append(normal - forces[0] - forces[1])
    pairs = ((0, 1), (1, 2), (2, 0))
    pressed = [np.stack([forces[i], forces[j], normal]) for i, j in pairs]
    left = [np.stack([total / 3.0 - forces[i], total / 3.0 - forces[j], total - normal]) for i, j in pairs]
    return np.stack([*pressed, *left])
