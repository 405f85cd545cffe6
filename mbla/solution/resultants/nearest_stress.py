"""The nearest resultants that fields of stress between nothing and the strength can carry, and how they follow.

Where a lies outside, the nearest point z is what full stress over the part that closes by d carries, and a − z is along
d: with h the support function of what can be carried,

    ∇h(d) + t d = a,   ‖d‖ = 1,   t ≥ 0

Newton's method finds d and t; ∇h and ∇²h are in ``full_stress``. With q = t d, whose support function
has t times smaller second derivatives, dz/da = ∇²h(q) (1 + ∇²h(q))⁻¹. Inside z = a.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.solution.resultants.full_stress import StressFields

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
