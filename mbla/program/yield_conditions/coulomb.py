"""Coulomb friction with cohesion: ‖T‖ ≤ c + μ N, the true cone.

Portioli et al. 2014, doi:10.1016/j.compstruc.2014.07.010.
"""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.program.yield_conditions.limits import YieldLimits


class Coulomb:
    """Shear is at most cohesion plus friction coefficient times normal force."""

    bounds_shear: ClassVar[bool] = True

    @staticmethod
    def applies(limits: YieldLimits) -> BoolArray:
        """At every point, (n_points,); without friction and cohesion it says that there is no shear."""
        return np.ones(len(limits.friction), dtype=bool)

    @staticmethod
    def slope(limits: YieldLimits) -> FloatArray:
        """Slope β = μ, (n_points,)."""
        return limits.friction

    @staticmethod
    def offset(limits: YieldLimits) -> FloatArray:
        """Offset h = c [force], (n_points,)."""
        return limits.cohesion
