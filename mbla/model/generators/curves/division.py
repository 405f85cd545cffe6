"""Equal lengths along a curve: the monotone function from parameter to length, inverted."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from mbla.arrays import FloatArray

HALVINGS = 60
"""of an interval; more than a double has digits"""


def invert(function: Callable[[FloatArray], FloatArray], values: FloatArray, low: float, high: float) -> FloatArray:
    """Where an increasing function takes values (n,) between low and high: bisection, all values at once."""
    below, above = np.full(len(values), low), np.full(len(values), high)
    for _ in range(HALVINGS):
        middle = (below + above) / 2
        short = function(middle) < values
        below, above = np.where(short, middle, below), np.where(short, above, middle)
    return np.asarray((below + above) / 2, dtype=np.float64)


def divide_symmetric(length: Callable[[FloatArray], FloatArray], end: float, count: int) -> FloatArray:
    """Parameters (count + 1,) from -end to end at equal steps of a length counted from the crown, parameter 0.

    Both halves are mirror images to the last digit, and the ends are exact.
    """
    steps = np.arange(count, -1, -2)  # in half steps from the crown, to both sides
    outer = steps[steps > 0]
    total = float(length(np.array([end]))[0])
    half = invert(length, total * outer / count, 0.0, end)
    half[:1] = end
    crown = [0.0] if count % 2 == 0 else []
    return np.concatenate([-half, crown, half[::-1]])


def outside(forwards: FloatArray) -> FloatArray:
    """Unit normals to the left of directions, (n, 2)."""
    return np.stack([-forwards[:, 1], forwards[:, 0]], axis=1)


def beside(points: FloatArray, forwards: FloatArray, offsets: FloatArray) -> FloatArray:
    """Points at offsets (n, k) outside points (n, 2) of a curve, (n, k, 2)."""
    return np.asarray(points[:, None, :] + offsets[..., None] * outside(forwards)[:, None, :], dtype=np.float64)
