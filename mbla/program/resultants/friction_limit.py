"""Friction of interfaces at given normal forces: size of the set of admissible (T, M_n/ρ).

The set is {(T, m): (max(‖T‖ − V + R, 0), |m|) within the safe curve of size R}:
see :mod:`mbla.program.resultants.torsion`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.model.solids.ragged import next_item
from mbla.program.resultants.conditions import M1, M2, Entries, N
from mbla.program.resultants.torsion import TorsionLimits


@dataclass(frozen=True)
class FrictionLimit:
    """Sizes at given resultants, (n,), and their derivatives by all resultants, (n, 6 n_interfaces).

    total : V = μN + cA
    share : R, what acts as over the full area; both not less than zero
    """

    total: FloatArray
    share: FloatArray
    of_total: sp.csr_array
    of_share: sp.csr_array

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
    # rows of the largest offset of each interface
    order = np.lexsort((-off, owner))
    active = slopes[order[limits.start[:-1]]]
    share = total - limits.friction * off[order[limits.start[:-1]]]
    columns, rows = 6 * limits.interfaces, np.arange(n)
    of_total, of_share = Entries.none(), Entries.none()
    of_total.add(rows, columns + N, np.where(total > 0, limits.friction, 0.0))
    some = np.where(share > 0, limits.friction, 0.0)
    of_share.add(rows, columns + N, some)
    of_share.add(rows, columns + M1, -some * active[:, 1])
    of_share.add(rows, columns + M2, some * active[:, 0])
    shape = (n, 6 * len(resultants))
    return FrictionLimit(np.maximum(total, 0.0), np.maximum(share, 0.0), of_total.matrix(shape), of_share.matrix(shape))


def reducing_slopes(limits: TorsionLimits) -> FloatArray:
    """S of the edge that leaves each corner q: s·q = 1 at both ends."""
    q = limits.corners
    after = q[next_item(limits.start)]
    det = q[:, 0] * after[:, 1] - q[:, 1] * after[:, 0]
    return np.asarray(np.column_stack([after[:, 1] - q[:, 1], q[:, 0] - after[:, 0]]) / det[:, None])


def curve_size(shear: FloatArray, twist: FloatArray, theta: FloatArray) -> FloatArray:
    """Size R' of the curve through (t, m), (n,); t = ``shear``, m = ``twist`` and R' are forces in one unit."""
    return np.asarray(0.5 * (theta * twist + np.sqrt((2.0 - theta) ** 2 * twist**2 + 4.0 * shear**2)))


def curve_support(slip: FloatArray, twist: FloatArray, theta: FloatArray) -> FloatArray:
    """Greatest power of forces on the curve of size 1 with slip ‖η‖ and twist |ρω|, (n,)."""
    inner = 4.0 * twist**2 + (2.0 - theta) ** 2 * slip**2
    root = np.sqrt(theta**2 * twist**2 + (1.0 - theta) * inner)
    curved = inner / np.maximum(2.0 * (theta * twist + root), 1e-300)
    return np.asarray(np.where(2.0 * twist <= theta * slip, slip, curved))


def torsion_reserve(limits: TorsionLimits, resultants: FloatArray) -> FloatArray:
    """R − R' over the largest V, (n_interfaces,); infinite where there is no condition."""
    size, r = friction_limit(limits, resultants), resultants[limits.interfaces]
    beyond = np.hypot(r[:, 1], r[:, 2]) - size.rest
    needed = curve_size(np.maximum(beyond, 0.0), np.abs(r[:, 3]) / limits.radii, limits.thetas)
    reserve = np.full(len(resultants), np.inf)
    reserve[limits.interfaces] = np.maximum(size.share - needed, 0.0) / max(float(size.total.max(initial=0.0)), 1e-300)
    return reserve
