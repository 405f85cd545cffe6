"""Full stress over the part of an interface that closes: what it carries, and how that changes with the motion.

An interface that closes by q, dual to (N', M_1/ρ, M_2/ρ), closes its points by c(x) = g·q, with g(x) = (1, x_2/ρ,
−x_1/ρ), x from the centroid. By normality it carries full stress where c > 0, none elsewhere::

    forces = f_c ∫ g over c > 0,      d forces = f_c ∫ g gᵀ/‖∇c‖ over the line c = 0  ·  dq

Triangles make the outline up; over each the integrals have closed forms.

The nearest resultants that fields of stress between nothing and the strength can carry, and how they follow.

Where a lies outside, the nearest point z is what full stress over the part that closes by d carries, and a − z is along
d: with h the support function of what can be carried,

    ∇h(d) + t d = a,   ‖d‖ = 1,   t ≥ 0

Newton's method finds d and t; With q = t d, whose support function
has t times smaller second derivatives, dz/da = ∇²h(q) (1 + ∇²h(q))⁻¹. Inside z = a.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.program.resultants.shapes import Fan, InterfaceShapes, corner_weights

BISECTIONS = 48
"""Of an interval in which the line that ends full stress lies, or a direction."""


@dataclass(frozen=True)
class StressFields:
    """Interfaces whose resultants (N', M_1/ρ, M_2/ρ) fields of stress carry, in triangles.

    strength : (n,) F [force]
    lengths  : (n,) ρ [m]
    owner    : (n_triangles,) interface of each
    force    : (n_triangles,) its share of the strength [force]
    arms     : (n_triangles, 3, 3) g with lengths over ρ at its corners
    """

    strength: FloatArray
    lengths: FloatArray
    owner: IntArray
    force: FloatArray
    arms: FloatArray

    @classmethod
    def of(cls, shapes: InterfaceShapes, rows: IntArray, strength: FloatArray) -> StressFields:
        """Interfaces ``rows``, (n,), of the given strengths, (n,)."""
        fan = Fan.of_some(shapes, rows)
        owner, x = fan.interface, shapes.corners[fan.corners]
        lengths = shapes.radii[rows]
        x = x / lengths[owner][:, None, None]
        arms = np.stack([np.ones(x.shape[:2]), x[..., 1], -x[..., 0]], axis=-1)
        return cls(strength, lengths, owner, strength[owner] * fan.share, arms)

    @property
    def scale(self) -> FloatArray:
        """From N', M_1, M_2 to forces, (n, 3)."""
        return np.column_stack([np.ones(len(self.lengths)), 1.0 / self.lengths, 1.0 / self.lengths])

    def take(self, rows: IntArray) -> StressFields:
        """Some of them, rows ascending."""
        place = np.full(len(self.lengths), -1)
        place[rows] = np.arange(len(rows))
        kept = place[self.owner] >= 0
        own = place[self.owner[kept]]
        return StressFields(self.strength[rows], self.lengths[rows], own, self.force[kept], self.arms[kept])

    def carried(self, closing: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Forces of full stress where they close by q, dual to them, (n, 3) both; what they grow by, (n, 3, 3)."""
        at_corners = np.einsum("tci,ti->tc", self.arms, closing[self.owner])
        carried = self.force[:, None] * np.einsum("tc,tci->ti", corner_weights(at_corners), self.arms)
        along = self.force[:, None, None] * _along_the_line(self.arms, at_corners)
        n = len(self.lengths)
        forces = np.stack([np.bincount(self.owner, carried[:, i], n) for i in range(3)], axis=1)
        flat = np.stack([np.bincount(self.owner, part, n) for part in along.reshape(-1, 9).T], axis=1)
        return forces.astype(np.float64), flat.reshape(n, 3, 3).astype(np.float64)

    def power(self, closing: FloatArray) -> FloatArray:
        """Power of full stress where they close by q, (n, 3), the most that any field of stress has, (n,)."""
        return np.asarray((self.carried(closing)[0] * closing).sum(axis=1))

    def elastic_slopes(self, forces: FloatArray) -> FloatArray:
        """Rotations that an elastic section would have under moments of (n, 3) forces, up to a factor, (n, 2)."""
        total = self.arms.sum(axis=1)[:, 1:]
        moments = np.einsum("tci,tcj->tij", self.arms[..., 1:], self.arms[..., 1:]) + total[:, :, None] * total[:, None]
        second = np.zeros((len(self.lengths), 2, 2))
        np.add.at(second, self.owner, self.force[:, None, None] * moments)
        return np.asarray(np.linalg.solve(second, forces[:, 1:, None])[..., 0])

    def closing_over(self, turning: FloatArray, share: FloatArray) -> FloatArray:
        """Motions q that turn as given, (n, 2), and close over the given shares of the area, (n, 3)."""
        closing = np.column_stack([np.zeros(len(share)), turning])
        reach = np.zeros(len(share))
        np.maximum.at(reach, self.owner, np.abs(np.einsum("tci,ti->tc", self.arms, closing[self.owner])).max(axis=1))
        lower, upper = -reach, reach.copy()
        for _ in range(BISECTIONS):
            closing[:, 0] = 0.5 * (lower + upper)
            more = self.carried(closing)[0][:, 0] > share * self.strength
            lower, upper = np.where(more, lower, closing[:, 0]), np.where(more, closing[:, 0], upper)
        return closing


def _along_the_line(arms: FloatArray, closing: FloatArray) -> FloatArray:
    """∫ g gᵀ/‖∇c‖ over the line c = 0 through triangles, over their area, (n, 3, 3); nothing where it misses them.

    The line cuts the edges at the corner whose sign no other has; its length over ‖∇c‖ is twice the area times c there
    over the product of the differences of c along both.
    """
    positive = closing > 0
    alone = np.where(positive.sum(axis=1, keepdims=True) == 1, positive, ~positive)
    cut = alone.sum(axis=1) == 1
    apex, t = np.argmax(alone, axis=1), np.arange(len(closing))
    one, two = (apex + 1) % 3, (apex + 2) % 3
    at, ends, product = closing[t, apex], [], np.ones(len(closing))
    for other in (one, two):
        span = np.where(cut, at - closing[t, other], 1.0)
        product *= span
        ends.append(arms[t, apex] + (at / span)[:, None] * (arms[t, other] - arms[t, apex]))
    weight = np.where(cut, 2.0 * np.abs(at) / np.abs(product), 0.0)
    sums = [np.einsum("ti,tj->tij", place, place) for place in (*ends, 0.5 * (ends[0] + ends[1]))]
    return np.asarray(weight[:, None, None] * (sums[0] + sums[1] + 4.0 * sums[2]) / 6.0)


MOST_STEPS = 60
HALVINGS = 12
"""Of one step of Newton's method."""

NEAREST = 1e-13
"""What is left of the equation, over the size of a and the strength, at which it is solved."""

LEAST = 1e-12
"""Distance t, over that size, that matrices are formed with at least."""

SOME = 1e-3
"""Share of the area that closes and that opens at least at the start."""


def nearest_stress(
    fields: StressFields, wanted: FloatArray, outside: BoolArray, near: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """The nearest forces z, (n, 3), dz/da, (n, 3, 3), and d where a lies outside, (n, 3).

    wanted  : (n, 3) a
    outside : (n,) those that no field of stress carries
    near    : (n, 3) d of something near it, zero where none is known
    """
    nearest, follows, d = wanted.copy(), np.broadcast_to(np.eye(3), (len(wanted), 3, 3)).copy(), near.copy()
    rows = np.flatnonzero(outside)
    if len(rows):
        chosen, a = fields.take(rows), wanted[rows]
        first, known = d[rows], np.any(near[rows] != 0.0, axis=1)
        new = np.flatnonzero(~known)
        if len(new):
            first[new] = _first(chosen.take(new), a[new])
        nearest[rows], follows[rows], d[rows] = _at_the_border(chosen, a, first)
    return nearest, follows, d


def _at_the_border(
    fields: StressFields, wanted: FloatArray, d: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    carried, curvature = fields.carried(d)
    t = np.maximum((d * (wanted - carried)).sum(axis=1), 0.0)
    least = LEAST * (np.abs(wanted).max(axis=1) + fields.strength)
    rows, part = np.arange(len(d)), fields
    for _ in range(MOST_STEPS):
        off = wanted[rows] - carried[rows] - t[rows, None] * d[rows]
        size = np.linalg.norm(off, axis=1)
        going = size > NEAREST / LEAST * least[rows]
        if not going.any():
            break
        if not going.all():
            rows, part, off, size = rows[going], part.take(np.flatnonzero(going)), off[going], size[going]
        step = _step(curvature[rows], np.maximum(t[rows], least[rows]), d[rows], off)
        moved = _nearer(part, wanted[rows], d[rows], t[rows], step, size)
        d[rows], t[rows], carried[rows], curvature[rows], nearer = moved
        rows, part = rows[nearer], part.take(np.flatnonzero(nearer))
    follows = np.linalg.solve(np.maximum(t, least)[:, None, None] * np.eye(3) + curvature, curvature)
    return carried, follows, d


def _step(curvature: FloatArray, t: FloatArray, d: FloatArray, off: FloatArray) -> FloatArray:
    """Newton's step of d and t, (n, 4); d keeps its length."""
    matrix = np.zeros((len(d), 4, 4))
    matrix[:, :3, :3] = curvature + t[:, None, None] * np.eye(3)
    matrix[:, :3, 3] = matrix[:, 3, :3] = d
    return np.asarray(np.linalg.solve(matrix, np.column_stack([off, np.zeros(len(d))])[..., None])[..., 0])


def _nearer(
    fields: StressFields, wanted: FloatArray, d: FloatArray, t: FloatArray, step: FloatArray, before: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray, BoolArray]:
    """Direction, distance and what is carried, moved by the largest of a few shares of the step; who came nearer."""
    share = np.ones(len(d))
    for _ in range(HALVINGS):
        moved = d + share[:, None] * step[:, :3]
        moved = moved / np.linalg.norm(moved, axis=1)[:, None]
        carried, curvature = fields.carried(moved)
        distance = np.maximum(t + share * step[:, 3], 0.0)
        off = np.linalg.norm(wanted - carried - distance[:, None] * moved, axis=1)
        far = off > (1.0 - 1e-4 * share) * before
        if not far.any():
            break
        share = np.where(far, 0.5 * share, share)
    return moved, distance, carried, curvature, off < before


def _first(fields: StressFields, wanted: FloatArray) -> FloatArray:
    """Unit vectors d, (n, 3): full stress towards the force, over as much of the area as it takes.

    The line that ends it is taken across the force as in an elastic section; what the force exceeds the whole
    strength by, or falls short of none, decides with.
    """
    share = wanted[:, 0] / fields.strength
    turning = fields.elastic_slopes(wanted)
    closing = fields.closing_over(turning, np.clip(share, SOME, 1.0 - SOME))
    straight = np.where(share > 0.5, 1.0, -1.0)[:, None] * np.array([1.0, 0.0, 0.0])
    d = np.where(np.any(turning != 0.0, axis=1)[:, None], closing, straight)
    return np.asarray(d / np.linalg.norm(d, axis=1)[:, None])
