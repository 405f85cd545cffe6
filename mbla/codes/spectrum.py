"""An elastic spectrum on the ground, of which NTC 2018 and EN 1998-1:2004 have the same branches.

Accelerations in g, periods in s, damping in per cent.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from mbla.codes.coefficients import coefficients


@dataclass(frozen=True)
class Spectrum:
    """Acceleration over period for 5 % damping.

    a_g           : g, of rock; of a table that of the ground
    S             : amplification by soil and site
    F_0           : plateau over a_g S
    T_B, T_C, T_D : s, at which branches meet
    table         : (T, S_e) in place of branches; none else
    """

    a_g: float
    S: float = 1.0
    F_0: float = 2.5
    T_B: float = math.nan
    T_C: float = math.nan
    T_D: float = math.nan
    table: tuple[tuple[float, float], ...] = ()


def damping_factor(damping: float) -> float:
    """NTC 2018 [3.2.4], EN 1998-1 (3.6): η = √(10/(5 + ξ)) ≥ 0.55, ξ in per cent."""
    of: dict[str, float] = coefficients("damping")
    return max(math.sqrt(of["numerator"] / (of["added"] + damping)), of["least"])


def ground_acceleration(spectrum: Spectrum, period: float, damping: float = 5.0) -> float:
    """S_e(T, ξ) [g]: NTC 2018 [3.2.2], EN 1998-1 (3.2) to (3.5), which are the same; nan beyond a table.

    a_g S [1 + (η F_0 − 1) T/T_B] | a_g S η F_0 | … T_C/T | … T_C T_D/T². The last branch has no end here: beyond the
    period T_E of NTC 3.2.3.2.3, 4.5 to 6 s, the code asks for less.
    """
    eta = damping_factor(damping)
    if spectrum.table:
        periods, values = np.array(spectrum.table).T
        return eta * float(np.interp(period, periods, values, right=np.nan))
    plateau, ground = eta * spectrum.F_0, spectrum.a_g * spectrum.S
    if period < spectrum.T_B:
        return ground * (1.0 + (plateau - 1.0) * period / spectrum.T_B)
    fallen: float = min(1.0, spectrum.T_C / period, spectrum.T_C * spectrum.T_D / period**2)
    return ground * plateau * fallen


def scaled_table(table: tuple[tuple[float, float], ...], a_g: float | None) -> Spectrum:
    """A table (T, S_e), from the period 0 on, as it is or with another acceleration of the ground [g]."""
    ground = table[0][1]
    share = 1.0 if a_g is None else a_g / ground
    return Spectrum(ground * share, table=tuple((period, share * value) for period, value in table))
