"""Interfaces of given outlines, and full stress over parts of them, summed up from cut polygons."""

from __future__ import annotations

import numpy as np
import shapely

from mbla.arrays import FloatArray
from mbla.program.resultants.shapes import InterfaceShapes
from mbla.solution.verification.interface_laws import InterfaceLaws
from tests.program.resultants.test_shapes import shapes_of

STRENGTH = 48.0
"""f_c."""
Outline = tuple[tuple[float, float], ...]
OUTLINES: dict[str, Outline] = {
    "rectangle": ((0, 0), (1.2, 0), (1.2, 0.7), (0, 0.7)),
    "parallelogram": ((0, 0), (1, 0), (1.5, 0.5), (0.5, 0.5)),
    "triangle": ((0, 0), (1.0, 0), (0.25, 0.75)),
    "trapezium": ((0, 0), (2, 0), (1.2, 1), (0.2, 1)),
    "pentagon": ((0, 0), (1, 0), (1.3, 0.6), (0.6, 1.1), (-0.2, 0.5)),
}
PIECES = ("rectangle", "parallelogram", "triangle")
"""Those that need not be cut."""


def laws_of(name: str, n: int, tension: float = 0.0) -> InterfaceLaws:
    """The same interface n times, with the strength and f_t A."""
    one = shapes_of(*OUTLINES[name])
    fields = ("convex", "rectangles", "sides", "axes", "radii", "thetas")
    shapes = InterfaceShapes(
        corners=np.tile(one.corners, (n, 1)),
        start=len(one.corners) * np.arange(n + 1),
        **{field: np.repeat(getattr(one, field), n, axis=0) for field in fields},
    )
    none, area = np.zeros(n), area_of(one)
    strength = np.full(n, STRENGTH * area + tension)
    return InterfaceLaws(shapes, none, none, none + tension, strength, none > 0, none == 0)


def polygon_of(shapes: InterfaceShapes) -> shapely.Polygon:
    return shapely.Polygon(shapes.corners[: shapes.start[1]])


def area_of(shapes: InterfaceShapes) -> float:
    return float(polygon_of(shapes).area)


def closing_part(shapes: InterfaceShapes, closing: FloatArray) -> shapely.Polygon:
    """Where c(x) = q_0 + q_1 x_2 − q_2 x_1 is positive."""
    whole, gradient = polygon_of(shapes), np.array([-closing[2], closing[1]])
    steep = float(np.hypot(*gradient))
    far = 100.0 * np.array([gradient, [-gradient[1], gradient[0]]]) / steep
    edge = -closing[0] * gradient / steep**2
    half = [edge + far[1], edge - far[1], edge - far[1] + far[0], edge + far[1] + far[0]]
    return whole & shapely.Polygon(half)


def full_stress(shapes: InterfaceShapes, closing: FloatArray) -> FloatArray:
    """N', M_1, M_2 over the strength f_c where the interface closes by q, dual to them."""
    part = closing_part(shapes, closing)
    x, y = part.centroid.coords[0] if part.area else (0.0, 0.0)
    return float(part.area) * np.array([1.0, y, -x])


def random_closing(shapes: InterfaceShapes, n: int, seed: int) -> FloatArray:
    """Motions whose line of no motion crosses the outline, (n, 3)."""
    draw, corners = np.random.default_rng(seed), shapes.corners[: shapes.start[1]]
    angle = draw.uniform(0.0, 2.0 * np.pi, n)
    gradient = np.column_stack([np.cos(angle), np.sin(angle)])
    heights = corners @ gradient.T
    share = draw.uniform(0.02, 0.98, n)
    cut = heights.min(axis=0) + share * np.ptp(heights, axis=0)
    return np.column_stack([-cut, gradient[:, 1], -gradient[:, 0]]) * draw.uniform(0.1, 10.0, n)[:, None]
