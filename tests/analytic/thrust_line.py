"""Thrust lines of a circular arch as a linear program in three unknowns: force on its right springer, and its place.

Across joint i the arch left of it pushes what is right of it with the force on the springer plus the weights between.
The thrust line passes the joint inside where this force has moments of opposite signs about the ends of the joint, and
friction holds where |T| <= μ N.
"""

from __future__ import annotations

import numpy as np
from scipy.optimize import linprog

from mbla.arrays import FloatArray


def springer_thrusts(span: float, t: float, width: float, n: int, mu: float, weight: float) -> dict[str, float]:
    """Least and greatest horizontal thrust, and least vertical force, of a semicircular arch on its right springer.

    weight : per volume
    """
    angles = np.linspace(np.pi, 0.0, n + 1)
    radial = np.column_stack([np.cos(angles), np.sin(angles)])
    inner, outer = span / 2 * radial, (span / 2 + t) * radial
    weights, centroids = voussoirs(inner, outer, width * weight)
    rows, room = _inside(inner, outer, radial, weights, centroids, mu)
    # unknowns: force on the right springer (Fx, Fz) and moment about the origin there
    bounds = [(None, None)] * 3

    def least(cost: list[float]) -> float:
        found = linprog(cost, A_ub=rows, b_ub=room, bounds=bounds, method="highs")
        assert found.status == 0
        assert found.fun is not None
        return float(found.fun)

    return {"least": least([1, 0, 0]), "greatest": -least([-1, 0, 0]), "vertical": least([0, -1, 0])}


def voussoirs(inner: FloatArray, outer: FloatArray, weight: float) -> tuple[FloatArray, FloatArray]:
    """Weights and centroids of straight-edged voussoirs: areas of quadrilaterals from their diagonals."""
    a, b, c, d = inner[:-1], outer[:-1], outer[1:], inner[1:]
    first, second = (np.abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2 for u, v in ((b - a, c - a), (c - a, d - a)))
    area = first + second
    centroid = (first[:, None] * (a + b + c) + second[:, None] * (a + c + d)) / (3 * area[:, None])
    return area * weight, centroid


def _inside(
    inner: FloatArray, outer: FloatArray, radial: FloatArray, weights: FloatArray, centroids: FloatArray, mu: float
) -> tuple[FloatArray, FloatArray]:
    """Conditions rows @ (Fx, Fz, M) <= room, of the force on the springer and its moment about the origin."""
    rows, room = [], []
    for i in range(len(inner)):
        # across joint i on what is right of it: the force on the springer, with the weights right of i lifted
        lifted, moment = weights[i:].sum(), float((weights[i:] * centroids[i:, 0]).sum())
        # F = (Fx, Fz + lifted); anticlockwise moment about the origin x Fz - z Fx: M + moment
        along = np.array([radial[i, 1], -radial[i, 0]])  # compression, to the right across the joint
        for end, sign in ((inner[i], 1.0), (outer[i], -1.0)):
            # moment about the end: M + moment - (x (Fz + lifted) - z Fx)
            rows.append(sign * np.array([end[1], -end[0], 1.0]))
            room.append(-sign * (moment - end[0] * lifted))
        for side in (1.0, -1.0):
            rows.append(np.append(side * radial[i] - mu * along, 0.0))
            room.append(-(side * radial[i, 1] - mu * along[1]) * lifted)
        rows.append(np.append(-along, 0.0))
        room.append(along[1] * lifted)
    return np.array(rows), np.array(room)
