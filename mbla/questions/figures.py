"""Figures in words, by the number of their significant digits."""

from __future__ import annotations

import math


def significant(value: float, digits: int = 6) -> str:
    """A figure with so many digits; ``-`` where there is no number."""
    return "-" if math.isnan(value) else f"{value + 0.0:.{digits}g}"
