"""The part of a surface of springs without tension that carries a resultant, by the plane of its heights.

Two bodies turn about a joint until the springs of its surface carry its normal force N at its eccentricity e: h is
linear, and its positive part carries::

    k_N ∫ h₊ dA = N,    k_N ∫ h₊ y dA = N e

The surface presses as a whole where e lies within its kern. Else this is the least of a convex function of the three
numbers of h, whose second derivatives are the moments of what presses: Newton's method, halved where it goes too far.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial import ConvexHull

from mbla.arrays import FloatArray
from mbla.solution.modes.polygons import clipped, moments_of, products_of

EXACT, CARRIED = 1e-12, 1e-7
"""What springs leave of a force and its moments over the size of the surface, and what they may, relative."""

MOST, SHORT = 60, 1e-6
"""Iterations at most, and least share of a step."""


def carrying_part(polygon: FloatArray, eccentricity: FloatArray, edge: float) -> FloatArray | None:
    """Corners of the part of a polygon, (k, 2) about its centroid, that carries a force there; None where none does.

    eccentricity : (2,) of the force
    edge : distance of the force from the edge of the hull, over the root of the area, up to which nothing is sought
    """
    size = float(np.sqrt(_seconds(polygon)[0, 0]))
    sides = ConvexHull(polygon).equations
    if not float((sides[:, :2] @ eccentricity + sides[:, 2]).max()) < -edge * size:
        return None
    own, wanted = polygon / size, np.append(1.0, eccentricity / size)
    corners = np.column_stack([np.ones(len(own)), own])
    plane = np.linalg.solve(_seconds(own), wanted)
    for _ in range(MOST):
        matrix = _seconds(clipped(own, corners @ plane))
        error = float(np.abs(wanted - matrix @ plane).max())
        step = _solved(matrix, wanted - matrix @ plane)
        if error <= EXACT or step is None:
            break
        energy = _energy(own, corners, plane, wanted)
        share, most = 1.0, energy + EXACT * abs(energy)
        while share > SHORT and not _energy(own, corners, plane + share * step, wanted) < most:
            share *= 0.5
        plane = plane + share * step
    return clipped(own, corners @ plane) * size if error <= CARRIED else None


def _seconds(polygon: FloatArray) -> FloatArray:
    """∫ (1, y_1, y_2)ᵀ(1, y_1, y_2) dA, (3, 3)."""
    return products_of(moments_of(polygon, np.array([0, len(polygon)])))[0] if len(polygon) else np.zeros((3, 3))


def _energy(polygon: FloatArray, corners: FloatArray, plane: FloatArray, wanted: FloatArray) -> float:
    """½ ∫ h₊² dA less what the resultant does."""
    return float(0.5 * plane @ _seconds(clipped(polygon, corners @ plane)) @ plane - wanted @ plane)


def _solved(matrix: FloatArray, right: FloatArray) -> FloatArray | None:
    """Solution; None where the matrix is singular: nothing presses any more, or next to nothing."""
    try:
        found = np.linalg.solve(matrix, right)
    except np.linalg.LinAlgError:
        return None
    return np.asarray(found) if np.isfinite(found).all() else None
