"""Tension cut-off: −N ≤ f_t; dry joints have f_t = 0."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.program.yield_conditions.limits import YieldLimits


class TensionCutOff:
    """The joint opens when its tensile strength is reached."""

    bounds_shear: ClassVar[bool] = False

    @staticmethod
    def applies(limits: YieldLimits) -> BoolArray:
        """Not where the Coulomb cone has its apex at N = 0 and so forbids tension by itself, (n_points,)."""
        return np.asarray((limits.cohesion > 0) | (limits.friction == 0))

    @staticmethod
    def slope(limits: YieldLimits) -> FloatArray:
        """Slope β = 1, (n_points,)."""
        return np.ones(len(limits.friction))

    @staticmethod
    def offset(limits: YieldLimits) -> FloatArray:
        """Offset h = f_t [force], (n_points,)."""
        return limits.tension
