"""Circles as regular polygons.

A regular polygon of n sides with corners at distance c from its middle has the area n/2 sin(2 pi/n) c^2 and flats at
distance c cos(pi/n). It stands for a circle of radius r

    inscribed     with its corners on the circle:   c = r
    circumscribed with its flats on the circle:     c = r/cos(pi/n)
    equal_area    with the area of the circle:      c = r sqrt(2 pi/(n sin(2 pi/n)))
"""

from __future__ import annotations

from typing import Literal

import numpy as np

from mbla.arrays import FloatArray

PolygonKind = Literal["inscribed", "circumscribed", "equal_area"]


def corner_radius(sides: int, kind: PolygonKind) -> float:
    """Distance of the corners from the middle, relative to the radius of the circle."""
    if kind == "inscribed":
        return 1.0
    if kind == "circumscribed":
        return float(1.0 / np.cos(np.pi / sides))
    return float(np.sqrt(2.0 * np.pi / (sides * np.sin(2.0 * np.pi / sides))))


def regular_polygon(sides: int) -> FloatArray:
    """Corners (sides, 2) at distance 1, counter-clockwise, the middle of the first and last on the x axis.

    A flat faces +x, so that a push along x rocks a drum about an edge.
    """
    angles = np.pi / sides * (1.0 + 2.0 * np.arange(sides))
    return np.stack([np.cos(angles), np.sin(angles)], axis=1)
