"""Friction of interfaces at given normal forces: size of the set of admissible (T, M_n/ρ).

The set is {(T, m): (max(‖T‖ − V + R, 0), |m|) within the safe curve of size R}:
see :mod:`mbla.program.resultants.torsion`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.solids.ragged import next_item
from mbla.program.resultants.torsion import TorsionLimits


@dataclass(frozen=True)
class FrictionLimit:
    """Sizes at given resultants, (n,).

    total : V = μN + cA
    share : R, what acts as over the full area; both not less than zero
    """

    total: FloatArray
    share: FloatArray

    @property
    def rest(self) -> FloatArray:
        """V − R, (n,): what carries shear alone."""
        return np.asarray(np.maximum(self.total - self.share, 0.0))


def friction_limit(limits: TorsionLimits, resultants: FloatArray) -> FrictionLimit:
    """Sizes of the sets at resultants (n_interfaces, 6)."""
    r, n = resultants[limits.interfaces], len(limits.interfaces)
    total = limits.friction * r[:, 0] + limits.cohesion
    slopes = reducing_slopes(limits)
    owner = np.repeat(np.arange(n), np.diff(limits.start))
    off = (slopes * np.column_stack([-r[owner, 5], r[owner, 4]])).sum(axis=1)
    most = np.maximum.reduceat(off, limits.start[:-1]) if n else off
    share = total - limits.friction * most
    return FrictionLimit(np.maximum(total, 0.0), np.maximum(share, 0.0))


def reducing_slopes(limits: TorsionLimits) -> FloatArray:
    """S of the edge that leaves each corner q: s·q = 1 at both ends."""
    q = limits.corners
    after = q[next_item(limits.start)]
    det = q[:, 0] * after[:, 1] - q[:, 1] * after[:, 0]
    return np.asarray(np.column_stack([after[:, 1] - q[:, 1], q[:, 0] - after[:, 0]]) / det[:, None])


def curve_size(shear: FloatArray, twist: FloatArray, theta: FloatArray) -> FloatArray:
    """Size R' of the curve through (t, m), (n,); t = ``shear``, m = ``twist`` and R' are forces in one unit."""
    return np.asarray(0.5 * (theta * twist + np.sqrt((2.0 - theta) ** 2 * twist**2 + 4.0 * shear**2)))


def torsion_reserve(limits: TorsionLimits, resultants: FloatArray) -> FloatArray:
    """R − R' over the largest V, (n_interfaces,); infinite where there is no condition."""
    size, r = friction_limit(limits, resultants), resultants[limits.interfaces]
    beyond = np.hypot(r[:, 1], r[:, 2]) - size.rest
    needed = curve_size(np.maximum(beyond, 0.0), np.abs(r[:, 3]) / limits.radii, limits.thetas)
    reserve = np.full(len(resultants), np.inf)
    reserve[limits.interfaces] = np.maximum(size.share - needed, 0.0) / max(float(size.total.max(initial=0.0)), 1e-300)
    return reserve
