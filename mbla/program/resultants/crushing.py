"""Crushing of interfaces: every field of stress between nothing and the compressive strength, exactly.

A stress σ between 0 and f_c carries N = ∫σ and m = ∫σ x = (−M_2, M_1), x from the centroid. What such fields carry is
bounded, with F = f_c A, by two kinds of inequalities in linear forms of N and m; for parallelograms and triangles no
others are needed (interfaces of other outlines come in such pieces, :mod:`mbla.contacts.outlines.points`):

*Corner* (L, Q_1, Q_2; K):  L³ ≤ K Q_1 Q_2. Where full stress covers a triangle at a corner it holds with equality.
    parallelogram  L = N,      Q_i ≤ N ∓ s_i·m,         K = 9/8 F     s_i = ν_i/d_i: gauge of a pair of edges
    triangle       L = N,      Q = p_i, p_j,            K = 9 F       p_i = N/3 + m·∇λ_i: forces at the corners
    and the same of the complement to full stress, with F − N and −m in place of N and m.
*Edge* (parallelogram):  N² + 3 (s_j·m)² ≤ F (N ∓ s_i·m). Where full stress ends on both edges of the other pair it
    holds with equality: N(y), the force of the strip at y, has its first moment at least N(y)²/2f_c from the edge, and
    ∫N(y)² is least, with N and its moment along y given, where N(y) is linear.

A tensile strength f_t shifts the origin exactly: N + f_t A in place of N and f_c + f_t in place of f_c.

As second-order cones:  edge  (Q + 1, Q − 1, 2 N/√F, 2√3 P/√F);  corner, with helping unknowns g and h:
g² ≤ L, h² ≤ Q_1 Q_2, L² ≤ √K g h. As rows: α, β, γ are the multipliers of these three, q_e those of the bounds of Q.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray, starts
from mbla.program.resultants.conditions import RESULTANTS, ConditionRows, ConeRows, Entries
from mbla.program.resultants.shapes import InterfaceShapes

HEAD = 5
"""Unknowns of a corner before those of its bounds: α_0, α_1, β_0, β_1, β_2."""


@dataclass(frozen=True)
class Corners:
    """Corner conditions, in forms 1, N, M_1, M_2.

    interfaces : (n,) rows of the contacts
    unit       : (n,) force in which L, Q and K are counted
    strength   : (n,) K
    lead       : (n, 4) L
    bounds     : (n_bounds, 4) that Q_1 and Q_2 are at most
    owner      : (n_bounds,) condition of each bound, ascending
    side       : (n_bounds,) 0 or 1: of Q_1 or Q_2
    """

    interfaces: IntArray
    unit: FloatArray
    strength: FloatArray
    lead: FloatArray
    bounds: FloatArray
    owner: IntArray
    side: IntArray


@dataclass(frozen=True)
class Edges:
    """Edge conditions: (n,) rows of the contacts, and the rows of their cones, (n, 4, 4) in forms 1, N, M_1, M_2."""

    interfaces: IntArray
    cones: FloatArray


@dataclass(frozen=True)
class CrushingLimits:
    """All conditions of all interfaces that can crush.

    interfaces : (n_crushing,) rows of the contacts
    strength   : (n_crushing,) F = (f_c + f_t) A [force]
    tension    : (n_crushing,) f_t A [force]
    """

    interfaces: IntArray
    strength: FloatArray
    tension: FloatArray
    corners: Corners
    edges: Edges


def crushing_limits(shapes: InterfaceShapes, strength: FloatArray, tension: FloatArray) -> CrushingLimits:
    """Conditions of all interfaces with a finite strength.

    strength, tension : (n_interfaces,) f_c A, inf where unlimited, and f_t A [force]

    Raises ValueError where such an interface is neither a parallelogram nor a triangle.
    """
    counts = np.diff(shapes.start)
    crushing = np.isfinite(strength)
    four, three = np.flatnonzero(crushing & shapes.parallelograms), np.flatnonzero(crushing & (counts == 3))
    if len(four) + len(three) != int(crushing.sum()):
        raise ValueError("an interface that can crush is neither a parallelogram nor a triangle")
    total = strength + tension
    normal = _forms(tension, np.ones(len(strength)), np.zeros((len(strength), 2)))
    slopes = shapes.edge_slopes()
    pairs = slopes[shapes.start[four][:, None] + np.arange(4)]
    pairs = 0.5 * (pairs[:, :2] - pairs[:, 2:])  # opposite edges up to the rounding of corners
    corners = [
        *_parallelogram_corners(four, total[four], normal[four], pairs),
        *_triangle_corners(three, total[three], normal[three], _corner_forces(shapes, three, tension[three])),
    ]
    return CrushingLimits(
        interfaces=np.flatnonzero(crushing),
        strength=total[crushing],
        tension=tension[crushing],
        corners=_joined(corners),
        edges=_edges(four, total[four], normal[four], pairs),
    )


def _forms(constant: FloatArray, of_normal: FloatArray, of_moment: FloatArray) -> FloatArray:
    """Linear forms from the factors of m = (−M_2, M_1), (..., 2), as coefficients of 1, N, M_1, M_2, (..., 4)."""
    return np.stack([constant, of_normal, of_moment[..., 1], -of_moment[..., 0]], axis=-1)


def _parallelogram_corners(rows: IntArray, total: FloatArray, normal: FloatArray, pairs: FloatArray) -> list[Corners]:
    """Pairs : (n, 2, 2) slopes of the two pairs of edges."""
    n = len(rows)
    along = np.concatenate([pairs[:, :1], -pairs[:, :1], pairs[:, 1:], -pairs[:, 1:]], axis=1)
    moment = _forms(np.zeros((n, 4)), np.zeros((n, 4)), along)
    owner, side = np.repeat(np.arange(n), 4), np.tile([0, 0, 1, 1], n)
    left, unit = _complement(normal, total), total[:, None, None]
    return [
        Corners(rows, np.ones(n), 1.125 * total, normal, (normal[:, None] - moment).reshape(-1, 4), owner, side),
        Corners(rows, total, np.full(n, 1.125), left, (left[:, None] + moment / unit).reshape(-1, 4), owner, side),
    ]


def _triangle_corners(rows: IntArray, total: FloatArray, normal: FloatArray, forces: FloatArray) -> list[Corners]:
    """Forces : (n, 3, 4) of the corners."""
    n, found = len(rows), []
    owner, side = np.repeat(np.arange(n), 2), np.tile([0, 1], n)
    left = (np.array([1.0, 0.0, 0.0, 0.0]) / 3.0) - forces / total[:, None, None]
    for pair in ([0, 1], [1, 2], [2, 0]):
        found.append(Corners(rows, np.ones(n), 9.0 * total, normal, forces[:, pair].reshape(-1, 4), owner, side))
        rest = _complement(normal, total)
        found.append(Corners(rows, total, np.full(n, 9.0), rest, left[:, pair].reshape(-1, 4), owner, side))
    return found


def _complement(normal: FloatArray, total: FloatArray) -> FloatArray:
    """(F − N)/F: force that is left, in terms of the strength, (n, 4)."""
    return np.array([1.0, 0.0, 0.0, 0.0]) - normal / total[:, None]


def _corner_forces(shapes: InterfaceShapes, rows: IntArray, tension: FloatArray) -> FloatArray:
    """p_i of triangles, which together carry N and m, (n, 3, 4)."""
    x = shapes.corners[shapes.start[rows][:, None] + np.arange(3)]
    opposite = np.roll(x, -1, axis=1), np.roll(x, -2, axis=1)
    edge = opposite[1] - opposite[0]
    inward = np.stack([-edge[..., 1], edge[..., 0]], axis=-1)
    height = ((x - opposite[0]) * inward).sum(axis=-1)
    third = np.full(height.shape, 1.0 / 3.0)
    return _forms(tension[:, None] * third, third, inward / height[..., None])


def _edges(rows: IntArray, total: FloatArray, normal: FloatArray, pairs: FloatArray) -> Edges:
    n, found = len(rows), []
    one, root = np.array([1.0, 0.0, 0.0, 0.0]), np.sqrt(total)[:, None]
    moments = _forms(np.zeros((n, 2)), np.zeros((n, 2)), pairs)
    for pair in (0, 1):
        across = 2.0 * np.sqrt(3.0) * moments[:, 1 - pair] / root
        for sign in (1.0, -1.0):
            q = normal - sign * moments[:, pair]
            found.append(np.stack([q + one, q - one, 2.0 * normal / root, across], axis=1))
    cones = np.stack(found, axis=1).reshape(-1, 4, 4)
    return Edges(np.repeat(rows, 4), cones)


def _joined(parts: list[Corners]) -> Corners:
    first = np.cumsum([0, *(len(part.interfaces) for part in parts)])[:-1]
    return Corners(
        interfaces=np.concatenate([part.interfaces for part in parts]),
        unit=np.concatenate([part.unit for part in parts]),
        strength=np.concatenate([part.strength for part in parts]),
        lead=np.concatenate([part.lead for part in parts]),
        bounds=np.concatenate([part.bounds for part in parts]),
        owner=np.concatenate([part.owner + at for part, at in zip(parts, first, strict=True)]),
        side=np.concatenate([part.side for part in parts]),
    )


def values(forms: FloatArray, resultants: FloatArray, interface: IntArray) -> FloatArray:
    """Linear forms, (..., 4), at the resultants, (n_interfaces, 6), of the interfaces that they belong to."""
    chosen = resultants[interface][:, list(RESULTANTS)]
    return np.asarray(forms[..., 0] + np.einsum("n...k,nk->n...", forms[..., 1:], chosen))


def corner_values(corners: Corners, resultants: FloatArray) -> tuple[FloatArray, FloatArray]:
    """L, (n,), and the least bounds of Q_1 and Q_2, (n, 2), at resultants, (n_interfaces, 6)."""
    lead = values(corners.lead, resultants, corners.interfaces)
    bounds = values(corners.bounds, resultants, corners.interfaces[corners.owner])
    q = np.full((len(lead), 2), np.inf)
    np.minimum.at(q, (corners.owner, corners.side), bounds)
    return lead, q


def crushing_violation(limits: CrushingLimits, resultants: FloatArray) -> FloatArray:
    """Largest excess over the conditions of each interface that can crush, negative inside, (n_crushing,) [force].

    resultants : (n_interfaces, 6)
    """
    corners, edges = limits.corners, limits.edges
    lead, q = corner_values(corners, resultants)
    needed = np.sqrt(np.maximum(lead, 0.0) ** 3 / corners.strength)
    at_corners = 0.5 * (np.hypot(q[:, 0] - q[:, 1], 2.0 * needed) - q.sum(axis=1))
    cones = values(edges.cones, resultants, edges.interfaces)
    at_edges = 0.5 * (np.linalg.norm(cones[:, 1:], axis=1) - cones[:, 0])
    most = np.full(len(resultants), -np.inf)
    np.maximum.at(most, corners.interfaces, corners.unit * np.maximum(at_corners, -lead))
    np.maximum.at(most, edges.interfaces, at_edges)
    return most[limits.interfaces]


def crushing_cones(limits: CrushingLimits, rows: ConeRows) -> None:
    """Add the vectors that the conditions of all interfaces hold in cones.

    Bounds of Q;  (L + 1, L − 1, 2 g);  (φ(g + h), φ(g − h), 2 L);  (Q_1 + Q_2, Q_1 − Q_2, 2 h);  edges. The helping
    unknowns are g, h and Q of all corners.
    """
    corners, edges = limits.corners, limits.edges
    n, owner, phi, lead = len(corners.interfaces), corners.owner, corners.strength**0.25, corners.lead[:, 0]
    g, h, q = rows.helper(n), rows.helper(n), rows.helper(2 * n).reshape(n, 2)
    bound = rows.take(1, len(owner), corners.bounds[:, 0])
    rows.given.add_forms(bound, corners.interfaces[owner], corners.bounds)
    rows.helping.add(bound, q[owner, corners.side], -1.0)
    alpha = rows.take(3, n, np.column_stack([lead + 1.0, lead - 1.0, np.zeros(n)]))
    beta = rows.take(3, n, np.column_stack([np.zeros((n, 2)), 2.0 * lead]))
    gamma = rows.take(3, n, np.zeros((n, 3)))
    for place, factor in ((alpha, 1.0), (alpha + 1, 1.0), (beta + 2, 2.0)):
        rows.given.add_forms(place, corners.interfaces, factor * corners.lead)
    rows.helping.add(alpha + 2, g, 2.0)
    for row, sign in ((0, 1.0), (1, -1.0)):
        rows.helping.add(beta + row, g, phi)
        rows.helping.add(beta + row, h, sign * phi)
        rows.helping.add(gamma + row, q[:, 0], 1.0)
        rows.helping.add(gamma + row, q[:, 1], sign)
    rows.helping.add(gamma + 2, h, 2.0)
    edge = rows.take(4, len(edges.interfaces), edges.cones[:, :, 0])
    rows.given.add_forms(
        (edge[:, None] + np.arange(4)).ravel(), np.repeat(edges.interfaces, 4), edges.cones.reshape(-1, 4)
    )


def crushing_rows(limits: CrushingLimits, n_interfaces: int) -> ConditionRows:
    """The conditions of all interfaces in the form of the cone program."""
    rows = ConeRows()
    crushing_cones(limits, rows)
    multipliers = sp.csr_array(
        sp.block_diag([_corner_multipliers(limits.corners), sp.eye_array(4 * len(limits.edges.interfaces))])
    )
    motion = sp.csr_array(rows.resultants(n_interfaces).T @ multipliers)
    return ConditionRows(motion, multipliers.T @ rows.constants, multipliers, rows.cone_sizes)


def _corner_multipliers(corners: Corners) -> sp.csr_array:
    """Q ≥ 0; α with α_2 = −φ(β_0 + β_1)/2, φ = K^¼; β; γ = (Σq, Σ ± q, −φ(β_0 − β_1))/2.

    Unknowns of a condition: α_0, α_1, β_0, β_1, β_2, then q_e.
    """
    n, owner, half_phi = len(corners.interfaces), corners.owner, 0.5 * corners.strength**0.25
    first = HEAD * np.arange(n) + starts(np.bincount(owner, minlength=n))[:-1]
    q = np.arange(len(owner)) + HEAD * (owner + 1)
    cones = Entries.none()
    cones.add(np.arange(len(q)), q, 1.0)
    alpha = len(q) + 3 * np.arange(n)
    beta, gamma = alpha + 3 * n, alpha + 6 * n
    cones.add(alpha, first, 1.0)
    cones.add(alpha + 1, first + 1, 1.0)
    cones.add(beta, first + 2, 1.0)
    cones.add(beta + 1, first + 3, 1.0)
    cones.add(beta + 2, first + 4, 1.0)
    for column, sign in ((first + 2, 1.0), (first + 3, -1.0)):
        cones.add(alpha + 2, column, -half_phi)
        cones.add(gamma + 2, column, -sign * half_phi)
    cones.add(gamma[corners.owner], q, 0.5)
    cones.add(gamma[corners.owner] + 1, q, np.where(corners.side == 0, 0.5, -0.5))
    return cones.matrix((len(q) + 9 * n, HEAD * n + len(q)))
