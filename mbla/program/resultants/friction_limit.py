"""Friction of interfaces at given normal forces: size of the set of admissible (T, M_n/ρ), nearest point in it.

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

BISECTIONS, NEWTON_STEPS = 30, 4
"""Of the multiplier of a projection: to 1e-9, and from there to rounding."""


@dataclass(frozen=True)
class FrictionLimit:
    """Sizes at given resultants, (n,), and their derivatives by all resultants, (n, 6 n_interfaces).

    total : V = μN + cA
    share : R, what acts as over the whole area; both not less than zero
    """

    total: FloatArray
    share: FloatArray
    of_total: sp.csr_array
    of_share: sp.csr_array


def friction_limit(limits: TorsionLimits, resultants: FloatArray) -> FrictionLimit:
    """Sizes of the sets at resultants (n_interfaces, 6)."""
    r, n = resultants[limits.interfaces], len(limits.interfaces)
    total = limits.friction * r[:, 0] + limits.cohesion
    slopes = _slopes(limits)
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


def _slopes(limits: TorsionLimits) -> FloatArray:
    """S of the edge that leaves each corner q: s·q = 1 at both ends."""
    q = limits.corners
    after = q[next_item(limits.start)]
    det = q[:, 0] * after[:, 1] - q[:, 1] * after[:, 0]
    return np.asarray(np.column_stack([after[:, 1] - q[:, 1], q[:, 0] - after[:, 0]]) / det[:, None])


def curve_size(shear: FloatArray, twist: FloatArray, theta: FloatArray) -> FloatArray:
    """Size R' of the curve through (t, m), (n,); t = ``shear``, m = ``twist`` and R' are forces in one unit."""
    return np.asarray(0.5 * (theta * twist + np.sqrt((2.0 - theta) ** 2 * twist**2 + 4.0 * shear**2)))


@dataclass(frozen=True)
class Projection:
    """Nearest points of the sets, (n, 3), and their derivatives by the given point (n, 3, 3), V (n, 3) and R (n, 3)."""

    point: FloatArray
    by_point: FloatArray
    by_total: FloatArray
    by_share: FloatArray


def nearest(trial: FloatArray, limit: FrictionLimit, theta: FloatArray) -> Projection:
    """Nearest points of the sets to (T1, T2, M_n/ρ), (n, 3)."""
    size = np.hypot(trial[:, 0], trial[:, 1])
    direction = trial[:, :2] / np.maximum(size, 1e-300)[:, None]
    sense, twist = np.where(trial[:, 2] < 0, -1.0, 1.0), np.abs(trial[:, 2])
    rest = np.maximum(limit.total - limit.share, 0.0)
    beyond, radius = size - rest, np.maximum(limit.share, 1e-300)
    inside = curve_size(np.maximum(beyond, 0.0), twist, theta) <= radius
    flat = ~inside & (beyond <= 0)
    tip = ~inside & ~flat & (twist <= 0.5 * theta * (beyond - radius))
    curved = ~inside & ~flat & ~tip

    # radial components (t, m) with their derivatives by (size, twist), rest and share
    t, m = size.copy(), twist.copy()
    by_trial, by_rest, by_share = np.tile(np.eye(2), (len(t), 1, 1)), np.zeros((len(t), 2)), np.zeros((len(t), 2))
    m[flat], by_trial[flat, 1, 1], by_share[flat, 1] = radius[flat], 0.0, 1.0
    t[tip], m[tip], by_trial[tip] = (rest + radius)[tip], 0.0, 0.0
    by_rest[tip, 0] = by_share[tip, 0] = 1.0
    if curved.any():
        found = _on_curve(beyond[curved], twist[curved], radius[curved], theta[curved])
        t[curved], m[curved], by_trial[curved], by_share[curved] = found[0] + rest[curved], *found[1:]
        by_rest[curved] = np.array([1.0, 0.0]) - by_trial[curved, :, 0]
    return _in_space(t, m, size, direction, sense, by_trial, by_rest, by_share)


def _on_curve(
    p: FloatArray, a: FloatArray, radius: FloatArray, theta: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Nearest (t, m) on t² + (1 − θ) m² + θ R m = R² to (p, a), derivatives by (p, a) and by R.

    With the multiplier κ: t = p/(1 + 2κ), m = (a − κθR)/(1 + 2κ(1 − θ)); the equation falls with κ.
    """
    least, most = np.zeros_like(p), np.ones_like(p)  # of κ/(1 + κ)
    for _ in range(BISECTIONS):
        middle = 0.5 * (least + most)
        value, _, _, _ = _misfit(middle / (1.0 - middle), p, a, radius, theta)
        least, most = np.where(value > 0, middle, least), np.where(value > 0, most, middle)
    kappa = least / (1.0 - least)
    for _ in range(NEWTON_STEPS):
        value, fall, _, _ = _misfit(kappa, p, a, radius, theta)
        kappa = np.maximum(kappa + value / np.maximum(fall, 1e-300), 0.0)
    _, _, t, m = _misfit(kappa, p, a, radius, theta)
    metric = np.stack([1.0 / (1.0 + 2.0 * kappa), 1.0 / (1.0 + 2.0 * kappa * (1.0 - theta))], axis=1)
    normal = np.stack([2.0 * t, 2.0 * (1.0 - theta) * m + theta * radius], axis=1)
    weighted = metric * normal
    whole = np.maximum((normal * weighted).sum(axis=1), 1e-300)
    by_point = (
        np.einsum("ni,ij->nij", metric, np.eye(2)) - weighted[:, :, None] * weighted[:, None, :] / whole[:, None, None]
    )
    by_radius = -by_point[:, :, 1] * (kappa * theta)[:, None]
    by_radius -= weighted * ((theta * m - 2.0 * radius) / whole)[:, None]
    return t, m, by_point, by_radius


def _misfit(
    kappa: FloatArray, p: FloatArray, a: FloatArray, radius: FloatArray, theta: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """t² + (1 − θ) m² + θ R m − R² at a multiplier (negative where m is), −1 times its derivative, t and m."""
    across, along = 1.0 + 2.0 * kappa, 1.0 + 2.0 * kappa * (1.0 - theta)
    t, m = p / across, (a - kappa * theta * radius) / along
    slope = 2.0 * (1.0 - theta) * m + theta * radius
    value = t**2 + (1.0 - theta) * m**2 + theta * radius * m - radius**2
    fall = 4.0 * t**2 / across + slope**2 / along
    return np.where(m < 0, -(radius**2), value), fall, t, m


def _in_space(
    t: FloatArray,
    m: FloatArray,
    size: FloatArray,
    direction: FloatArray,
    sense: FloatArray,
    by_trial: FloatArray,
    by_rest: FloatArray,
    by_share: FloatArray,
) -> Projection:
    """From radial components to (T1, T2, m); V − R = rest."""
    n = len(t)
    radial = np.zeros((n, 3, 2))
    radial[:, :2, 0], radial[:, 2, 1] = direction, sense
    across = np.eye(2) - direction[:, :, None] * direction[:, None, :]
    by_point = np.einsum("nia,nab,njb->nij", radial, by_trial, radial)
    by_point[:, :2, :2] += np.where(size > 0, t / np.maximum(size, 1e-300), 1.0)[:, None, None] * across
    by_total = np.einsum("nia,na->ni", radial, by_rest)
    return Projection(
        point=np.column_stack([direction * t[:, None], sense * m]),
        by_point=by_point,
        by_total=by_total,
        by_share=np.einsum("nia,na->ni", radial, by_share) - by_total,
    )


def curve_support(slip: FloatArray, twist: FloatArray, theta: FloatArray) -> FloatArray:
    """Greatest power of forces on the curve of size 1 with slip ‖η‖ and twist |ρω|, (n,)."""
    inner = 4.0 * twist**2 + (2.0 - theta) ** 2 * slip**2
    root = np.sqrt(theta**2 * twist**2 + (1.0 - theta) * inner)
    curved = inner / np.maximum(2.0 * (theta * twist + root), 1e-300)
    return np.asarray(np.where(2.0 * twist <= theta * slip, slip, curved))


def torsion_reserve(limits: TorsionLimits, resultants: FloatArray) -> FloatArray:
    """R − R' over the largest V, (n_interfaces,); infinite where there is no condition."""
    size, r = friction_limit(limits, resultants), resultants[limits.interfaces]
    beyond = np.hypot(r[:, 1], r[:, 2]) - np.maximum(size.total - size.share, 0.0)
    needed = curve_size(np.maximum(beyond, 0.0), np.abs(r[:, 3]) / limits.radii, limits.thetas)
    reserve = np.full(len(resultants), np.inf)
    reserve[limits.interfaces] = np.maximum(size.share - needed, 0.0) / max(float(size.total.max(initial=0.0)), 1e-300)
    return reserve
