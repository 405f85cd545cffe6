"""From contact forces to the dual variables of the convex contact model: the slacks of all its conditions.

The helping unknowns of the conditions (see :mod:`mbla.program.resultants.torsion` and
:mod:`mbla.program.resultants.crushing`) are chosen well inside their ranges, where these have an inside.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.solids.ragged import next_item
from mbla.program.kinematic import KinematicForm
from mbla.program.resultants import ConvexProgram
from mbla.program.resultants.crushing import Corners, corner_values, values
from mbla.program.resultants.torsion import TorsionLimits
from mbla.program.yield_conditions import YieldLimits

INSIDE = 1e-10
"""Share of its range by which a helping unknown keeps off the end of it."""


def slacks_of(convex: ConvexProgram, form: KinematicForm, forces: FloatArray) -> FloatArray:
    """All cone rows of z that belong to contact forces, with helping unknowns well inside their ranges."""
    limits, rows = convex.points.limits, form.rows
    x = _points_inside(limits, forces)
    strength = limits.cohesion + limits.friction * x[:, 0]
    shear = np.column_stack([strength, x[:, 1:]])
    resultants = (convex.resultants @ x.ravel()).reshape(-1, 6)
    return np.concatenate(
        [
            x[rows.cut_off, 0] + limits.tension[rows.cut_off],
            limits.compression[rows.crushing] - x[rows.crushing, 0],
            shear[rows.dry].ravel(),
            shear[rows.frictional].ravel(),
            _torsion_slacks(convex.torsion, resultants),
            _corner_slacks(convex.crushing.corners, resultants),
            values(convex.crushing.edges.cones, resultants, convex.crushing.edges.interfaces).ravel(),
        ]
    )


def _points_inside(limits: YieldLimits, forces: FloatArray) -> FloatArray:
    x = forces.copy()
    x[:, 0] = np.minimum(np.maximum(x[:, 0], -limits.tension), limits.compression)
    return x


def _torsion_slacks(limits: TorsionLimits, resultants: FloatArray) -> FloatArray:
    """K ± M_n/ρ;  y with Σ y = V − R, Σ y q = μ m;  (R − θk/2, T − T', (1 − θ/2) k);  (V − R, T')."""
    r = resultants[limits.interfaces]
    total = limits.friction * r[:, 0] + limits.cohesion
    moment = limits.friction[:, None] * np.column_stack([-r[:, 5], r[:, 4]])
    at_corners, least = _at_corners(limits, moment)
    share = np.maximum(total - least, 0.0) * (1.0 - INSIDE)
    evenly = _even_weights(limits)
    y = at_corners + evenly * np.maximum(total - share - least, 0.0)[_owner(limits)]
    size = np.hypot(r[:, 1], r[:, 2])
    alone = np.minimum(1.0, np.maximum(total - share, 0.0) * (1.0 - INSIDE) / np.maximum(size, 1e-300))
    apart = alone[:, None] * r[:, 1:3]
    twist, theta = r[:, 3] / limits.radii, limits.thetas
    most = _largest_twist(share, np.hypot(*(r[:, 1:3] - apart).T), theta)
    k = np.abs(twist) + 0.5 * np.maximum(most - np.abs(twist), 0.0)
    curve = np.column_stack([share - 0.5 * theta * k, r[:, 1:3] - apart, (1.0 - 0.5 * theta) * k])
    rest = np.column_stack([total - share, apart])
    both = np.column_stack([k + twist, k - twist])
    return np.concatenate([both.ravel(), y, curve.ravel(), rest.ravel()])


def _owner(limits: TorsionLimits) -> IntArray:
    """Row of the limits to which each corner belongs."""
    return np.repeat(np.arange(len(limits.interfaces)), np.diff(limits.start))


def _at_corners(limits: TorsionLimits, moment: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Least forces y ≥ 0 at the corners q with Σ y q = moment, at the ends of one edge, and their sums."""
    owner, q = _owner(limits), limits.corners
    after = next_item(limits.start) if len(q) else np.zeros(0, dtype=np.int64)
    m, q_after = moment[owner], q[after]
    det = q[:, 0] * q_after[:, 1] - q[:, 1] * q_after[:, 0]
    first = (m[:, 0] * q_after[:, 1] - m[:, 1] * q_after[:, 0]) / det
    second = (q[:, 0] * m[:, 1] - q[:, 1] * m[:, 0]) / det
    inside = np.minimum(first, second)
    best = np.full(len(limits.interfaces), -np.inf)
    np.maximum.at(best, owner, inside)
    edge = np.flatnonzero(inside >= best[owner])
    edge = edge[np.unique(owner[edge], return_index=True)[1]]
    y = np.zeros(len(q))
    np.add.at(y, edge, np.maximum(first[edge], 0.0))
    np.add.at(y, after[edge], np.maximum(second[edge], 0.0))
    return y, np.asarray(np.bincount(owner, y, len(limits.interfaces)), dtype=np.float64)


def _even_weights(limits: TorsionLimits) -> FloatArray:
    """Positive weights of the corners, sum 1, whose mean is the centroid (mean value coordinates, Floater 2003)."""
    q = limits.corners
    if len(q) == 0:
        return np.zeros(0)
    after = q[next_item(limits.start)]
    cross = q[:, 0] * after[:, 1] - q[:, 1] * after[:, 0]
    half = np.tan(0.5 * np.arctan2(cross, (q * after).sum(axis=1)))
    before = np.empty_like(half)
    before[next_item(limits.start)] = half
    weight = (half + before) / np.hypot(q[:, 0], q[:, 1])
    owner = _owner(limits)
    return np.asarray(weight / np.bincount(owner, weight)[owner])


def _largest_twist(share: FloatArray, shear: FloatArray, theta: FloatArray) -> FloatArray:
    """M of the safe curve of size R at shear t."""
    room = np.maximum(share**2 - shear**2, 0.0)
    return np.asarray(
        2.0 * room / np.maximum(theta * share + np.sqrt((theta * share) ** 2 + 4 * (1 - theta) * room), 1e-300)
    )


def _corner_slacks(corners: Corners, resultants: FloatArray) -> FloatArray:
    lead, bounds, q = corner_values(corners, resultants)
    lead, q = np.maximum(lead, 0.0), np.maximum(q, 0.0) * (1.0 - INSIDE)
    h = np.sqrt(q[:, 0] * q[:, 1]) * (1.0 - INSIDE)
    g = _between(lead, corners.strength, h)
    phi = corners.strength**0.25
    alpha = np.column_stack([lead + 1.0, lead - 1.0, 2.0 * g])
    beta = np.column_stack([phi * (g + h), phi * (g - h), 2.0 * lead])
    gamma = np.column_stack([q[:, 0] + q[:, 1], q[:, 0] - q[:, 1], 2.0 * h])
    return np.concatenate([bounds - q[corners.owner, corners.side], alpha.ravel(), beta.ravel(), gamma.ravel()])


def _between(normal: FloatArray, strength: FloatArray, h: FloatArray) -> FloatArray:
    """The unknown g between its bounds N²/(√F h) and √N."""
    least = normal**2 / np.maximum(np.sqrt(strength) * h, 1e-300)
    return np.asarray(np.sqrt(np.minimum(least, np.sqrt(normal)) * np.sqrt(normal)))
