"""Crushing: N ≤ f_c at each contact point, f_c = compressive strength times the point's share of the area."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.program.yield_conditions.limits import YieldLimits


class Crushing:
    """Compression at a point is limited."""

    bounds_shear: ClassVar[bool] = False

    @staticmethod
    def applies(limits: YieldLimits) -> BoolArray:
        """Where the compressive strength is finite, (n_points,)."""
        return np.isfinite(limits.compression)

    @staticmethod
    def slope(limits: YieldLimits) -> FloatArray:
        """Slope β = −1, (n_points,)."""
        return -np.ones(len(limits.friction))

    @staticmethod
    def offset(limits: YieldLimits) -> FloatArray:
        """Offset h = f_c [force], (n_points,)."""
        return limits.compression
