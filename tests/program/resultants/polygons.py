"""Outlines of interfaces for tests, and friction over them by brute force."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from mbla.arrays import FloatArray


def about_centroid(corners: list[list[float]]) -> FloatArray:
    """Corners of a polygon, counter-clockwise, moved so that its centroid is the origin, (1, m, 2)."""
    p = np.array(corners)
    q = np.roll(p, -1, axis=0)
    cross = p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]
    return np.asarray((p - ((p + q) * cross[:, None]).sum(axis=0) / (3.0 * cross.sum()))[None])


def rectangle(a: float, b: float) -> FloatArray:
    """Corners of a rectangle about its centre, (1, 4, 2)."""
    return about_centroid([[0, 0], [a, 0], [a, b], [0, b]])


def regular(n: int) -> FloatArray:
    """Corners of a regular polygon about its centre, (1, n, 2)."""
    angle = 2.0 * np.pi * np.arange(n) / n
    return np.column_stack([np.cos(angle), np.sin(angle)])[None]


SHAPES = {
    "square": rectangle(1, 1),
    "two to one": rectangle(2, 1),
    "ten to one": rectangle(10, 1),
    "upright": rectangle(1, 3),
    "triangle": regular(3),
    "hexagon": regular(6),
    "trapezium": about_centroid([[0, 0], [2, 0], [1.2, 1], [0.2, 1]]),
    "parallelogram": about_centroid([[0, 0], [1, 0], [1.5, 0.5], [0.5, 0.5]]),
    "slender triangle": about_centroid([[0, 0], [3, 0], [0, 1]]),
}


def points_inside(outline: FloatArray, n: int = 60) -> tuple[FloatArray, FloatArray]:
    """Gauss points of a convex polygon (m, 2), triangle by triangle, and their weights, which sum to 1."""
    node, weight = np.polynomial.legendre.leggauss(n)
    node, weight = 0.5 * (node + 1.0), 0.5 * weight
    u, v = np.meshgrid(node, node, indexing="ij")
    both = np.outer(weight * node, weight)
    points, weights = [], []
    for second, third in pairwise(outline[1:]):
        p, q = second - outline[0], third - outline[0]
        points.append((outline[0] + u[..., None] * (p + v[..., None] * (q - p))).reshape(-1, 2))
        weights.append((both * abs(p[0] * q[1] - p[1] * q[0])).ravel())
    whole = np.concatenate(weights)
    return np.concatenate(points), whole / whole.sum()
