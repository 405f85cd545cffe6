"""A figure of two results, side by side."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Figure:
    """Values in A and in B, both in the unit of A; nan where there is none.

    difference : (B - A) over A, at least over ``least``, over B where A is zero; nan where one of them is missing
    same       : within the tolerance, or missing in both
    """

    name: str
    unit: str
    first: float
    second: float
    difference: float
    tolerance: float
    same: bool


def figure(name: str, unit: str, first: float, second: float, tolerance: float, least: float = 0.0) -> Figure:
    """The difference of two values against a relative tolerance; ``least`` is the size below which they count as it."""
    if math.isnan(first) or math.isnan(second):
        return Figure(name, unit, first, second, math.nan, tolerance, math.isnan(first) and math.isnan(second))
    size = max(abs(first), least) or abs(second)
    difference = (second - first) / size if size > 0.0 else 0.0
    return Figure(name, unit, first, second, difference, tolerance, abs(difference) <= tolerance)
