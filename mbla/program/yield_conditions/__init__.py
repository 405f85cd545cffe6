"""Yield conditions of a contact point, one per file, all of one form.

A condition bounds the force (N, T) at a point, N compressive, by a limit that is linear in N::

    shear conditions:   ‖T‖ ≤ h + β N          (a second-order cone)
    normal conditions:   0  ≤ h + β N          (a half-line)

With one multiplier p ≥ 0 a condition (p ≥ ‖v_T‖ where it bounds shear), normality gives the velocities and the
power they dissipate (principle of maximum plastic work; Hill 1950)::

    v_N = Σ β p                  power = Σ h p

so that one pair (β, h) serves the static and the kinematic form of every program. A new condition is a new file
with the attributes of :class:`YieldCondition` and one line in ``CONDITIONS``.
"""

from __future__ import annotations

from typing import ClassVar, Protocol

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.program.yield_conditions.coulomb import Coulomb
from mbla.program.yield_conditions.crushing import Crushing
from mbla.program.yield_conditions.limits import YieldLimits
from mbla.program.yield_conditions.tension import TensionCutOff


class YieldCondition(Protocol):
    """One bound on the force at every contact point; all arrays are (n_points,)."""

    bounds_shear: ClassVar[bool]

    @staticmethod
    def applies(limits: YieldLimits) -> BoolArray:
        """Points at which the condition is present and not implied by the others, (n_points,)."""
        ...

    @staticmethod
    def slope(limits: YieldLimits) -> FloatArray:
        """β, the growth of the limit with the normal force [-], (n_points,)."""
        ...

    @staticmethod
    def offset(limits: YieldLimits) -> FloatArray:
        """h, the limit without normal force [force], (n_points,)."""
        ...


CONDITIONS: tuple[type[YieldCondition], ...] = (Coulomb, TensionCutOff, Crushing)


def yield_violation(contact_forces: FloatArray, limits: YieldLimits) -> FloatArray:
    """Largest excess of a force over its limits at each point, zero where all hold, (n_points,) [force].

    contact_forces : (n_points, 3) N, T1, T2, or (n_points, 2) N, T; compression positive
    """
    normal = contact_forces[:, 0]
    shear = np.linalg.norm(contact_forces[:, 1:], axis=1)
    excess = np.zeros(len(normal))
    for condition in CONDITIONS:
        demand = shear if condition.bounds_shear else 0.0
        capacity = condition.offset(limits) + condition.slope(limits) * normal
        excess = np.maximum(excess, np.where(np.isinf(capacity), 0.0, demand - capacity))
    return excess


__all__ = ["CONDITIONS", "Coulomb", "Crushing", "TensionCutOff", "YieldCondition", "YieldLimits", "yield_violation"]
