"""Crushing of interfaces with convex outlines: a rectangular stress block around the force point.

Full compressive stress f_c over an area centred on the force point p carries N = f_c A'. For a rectangle a × b this is
the rectangle that the eccentricity leaves, for other convex outlines the homothetic copy (both safe; the first exact
for an eccentricity along one side)::

    N³ ≤ F Q_1 Q_2,   Q_1 ≤ N ∓ 2 m_1/a,   Q_2 ≤ N ∓ 2 m_2/b,   F = f_c A,   m = N p = (−M_2, M_1)
    N³ ≤ F Q²,        Q ≤ N − m·ν_e/d_e for all edges e

as second-order cones, with helping unknowns g and h:  g² ≤ N,  h² ≤ Q_1 Q_2,  N² ≤ √F g h  (h = Q for other outlines),
the last one scaled by F^¼. A tensile strength f_t shifts the origin exactly: N + f_t A in place of N and f_c + f_t in
place of f_c.

How safe: the exact stress block under a biaxial eccentricity is the part of the interface cut off by a line that has
its centroid at p. For a rectangle it bears between 1 and 9/8 of what is allowed here: 9/8 where both eccentricities are
a sixth of the side or more and the part is a triangle at a corner, 4.5 u v against 4 u v with u, v the distances of p
from the sides; 1 where one eccentricity is zero. Of other outlines no such bound holds: near the middle of an edge of a
triangle the homothetic copy shrinks with the square of the distance from it, the exact part with the distance.

As rows: α, β, γ are the multipliers of the three cones, q_e those of the bounds of Q.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.model.ragged import items_of_rows
from mbla.program.convex.conditions import M1, M2, ConditionRows, Entries, N, joined
from mbla.program.convex.shapes import InterfaceShapes


@dataclass(frozen=True)
class CrushingLimits:
    """Interfaces with convex outlines and a compressive strength; rectangles, or all others.

    interfaces : (n,) rows of the contacts
    strength   : (n,) F = (f_c + f_t) A [force]
    tension    : (n,) f_t A [force]
    slopes     : (n_slopes, 2) [1/m], Q ≤ N' − slope·m, interface by interface; the first two of a rectangle bound Q_1
    start      : (n + 1,) first slope of each
    """

    interfaces: IntArray
    strength: FloatArray
    tension: FloatArray
    slopes: FloatArray
    start: IntArray


def crushing_limits(
    shapes: InterfaceShapes, strength: FloatArray, tension: FloatArray
) -> tuple[CrushingLimits, CrushingLimits]:
    """Limits of rectangles, and of other convex outlines; strength (inf: none) and tension, (n_interfaces,)."""
    applies = np.isfinite(strength) & shapes.convex
    slopes = shapes.edge_slopes()
    rectangular = np.flatnonzero(applies & shapes.rectangles)
    along = 2.0 / shapes.sides[rectangular, :, None] * shapes.axes[rectangular]
    pairs = np.stack([along[:, 0], -along[:, 0], along[:, 1], -along[:, 1]], axis=1)
    slopes[shapes.start[rectangular][:, None] + np.arange(4)] = pairs

    def limits(chosen: BoolArray) -> CrushingLimits:
        rows = np.flatnonzero(chosen)
        start = np.concatenate([[0], np.cumsum(np.diff(shapes.start)[rows])]).astype(np.int64)
        total = strength[rows] + tension[rows]
        return CrushingLimits(rows, total, tension[rows], slopes[items_of_rows(shapes.start, rows)], start)

    return limits(applies & shapes.rectangles), limits(applies & ~shapes.rectangles)


def crushing_rows(rectangles: CrushingLimits, others: CrushingLimits, n_interfaces: int) -> ConditionRows:
    """The condition of all interfaces in the form of the cone program."""
    return joined([_rows(rectangles, n_interfaces, 5), _rows(others, n_interfaces, 4)])


def _rows(limits: CrushingLimits, n_interfaces: int, head: int) -> ConditionRows:
    """Unknowns of an interface: α_0, α_1, β_0, β_2, for rectangles β_1 too, then q_e."""
    n = len(limits.interfaces)
    first = head * np.arange(n) + limits.start[:-1]
    owner = np.repeat(np.arange(n), np.diff(limits.start))
    q = np.arange(len(owner)) + head * (owner + 1)
    alpha, beta_0, beta_2 = first[:, None] + np.arange(2), first + 2, first + 3
    n_unknowns = head * n + len(owner)

    of_normal = np.ones(n_unknowns)  # coefficient of N in Gᵀζ
    of_normal[beta_0], of_normal[beta_2] = 0.0, 2.0
    interface = np.empty(n_unknowns, dtype=np.int64)
    for columns in (alpha[:, 0], alpha[:, 1], beta_0, beta_2):
        interface[columns] = np.arange(n)
    interface[q] = owner
    if head == 5:
        of_normal[first + 4], interface[first + 4] = 0.0, np.arange(n)
    cost = of_normal * limits.tension[interface]
    cost[alpha[:, 0]] += 1.0
    cost[alpha[:, 1]] -= 1.0

    motion, row = Entries.none(), 6 * limits.interfaces
    motion.add(row[interface] + N, np.arange(n_unknowns), of_normal)
    motion.add(row[owner] + M1, q, -limits.slopes[:, 1])
    motion.add(row[owner] + M2, q, limits.slopes[:, 0])
    cones, sizes = (_rectangle_cones if head == 5 else _other_cones)(limits, first, owner, q)
    shape = (int(sizes.sum()), n_unknowns)
    return ConditionRows(motion.matrix((6 * n_interfaces, n_unknowns)), cost, cones.matrix(shape), sizes)


def _rectangle_cones(limits: CrushingLimits, first: IntArray, owner: IntArray, q: IntArray) -> tuple[Entries, IntArray]:
    """Q ≥ 0; α with α_2 = −φ(β_0 + β_1)/2, φ = F^¼; β; γ = (Σq, Σ ± q, −φ(β_0 − β_1))/2."""
    n, half_phi = len(first), 0.5 * limits.strength**0.25
    cones = Entries.none()
    cones.add(np.arange(len(q)), q, 1.0)
    alpha = len(q) + 3 * np.arange(n)
    beta, gamma = alpha + 3 * n, alpha + 6 * n
    cones.add(alpha, first, 1.0)
    cones.add(alpha + 1, first + 1, 1.0)
    cones.add(beta, first + 2, 1.0)
    cones.add(beta + 1, first + 4, 1.0)
    cones.add(beta + 2, first + 3, 1.0)
    for column, sign in ((first + 2, 1.0), (first + 4, -1.0)):
        cones.add(alpha + 2, column, -half_phi)
        cones.add(gamma + 2, column, -sign * half_phi)
    of_first_side = np.where((np.arange(len(q)) - limits.start[owner]) < 2, 0.5, -0.5)
    cones.add(gamma[owner], q, 0.5)
    cones.add(gamma[owner] + 1, q, of_first_side)
    sizes = np.concatenate([np.ones(len(q)), np.full(3 * n, 3)]).astype(np.int64)
    return cones, sizes


def _other_cones(limits: CrushingLimits, first: IntArray, owner: IntArray, q: IntArray) -> tuple[Entries, IntArray]:
    """Q ≥ 0; α with α_2 = −φ(β_0 + β_1)/2; β with β_1 = β_0 − Σq/φ."""
    n, phi = len(first), limits.strength**0.25
    cones = Entries.none()
    cones.add(np.arange(len(q)), q, 1.0)
    alpha = len(q) + 3 * np.arange(n)
    beta = alpha + 3 * n
    cones.add(alpha, first, 1.0)
    cones.add(alpha + 1, first + 1, 1.0)
    cones.add(alpha + 2, first + 2, -phi)
    cones.add(alpha[owner] + 2, q, 0.5)
    cones.add(beta, first + 2, 1.0)
    cones.add(beta + 1, first + 2, 1.0)
    cones.add(beta[owner] + 1, q, -1.0 / phi[owner])
    cones.add(beta + 2, first + 3, 1.0)
    sizes = np.concatenate([np.ones(len(q)), np.full(2 * n, 3)]).astype(np.int64)
    return cones, sizes
