"""What rises above the level courses of a wall: gables, and sloped tops of buttresses."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray

LEAST_TOP_COURSE = 0.25
"""height of the last course under an apex, in courses, below which it is part of the one beneath it"""


def levels_with_top(levels: FloatArray, rise: float, height: float) -> FloatArray:
    """Bed joints of the level courses, then those up to the apex: whole courses and a rest [length]."""
    above = max(int(np.ceil(rise / height - LEAST_TOP_COURSE)), 1)
    tops = float(levels[-1]) + height * np.arange(1, above + 1)
    tops[-1] = float(levels[-1]) + rise
    return np.concatenate([levels, tops])
