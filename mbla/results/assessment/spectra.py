"""Elastic spectra on the ground and at a height of a building: accelerations in g, periods in s, damping in per cent.

NTC 2018 (D.M. 17.1.2018) and Circolare 7/2019 (C7.2.3), EN 1998-1:2004. Tables of coefficients: ``coefficients.toml``.
"""

from __future__ import annotations

import math
import tomllib
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

import numpy as np

from mbla.deck.sections.assessment import SpectrumSection

FLAT_FROM, FLAT_TO = 0.8, 1.1
"""a and b of C7.2.3: periods over that of the mode between which a floor spectrum has its peak"""


@cache
def coefficients() -> dict[str, Any]:
    """The tables of the codes."""
    return tomllib.loads(files("mbla.results.assessment").joinpath("coefficients.toml").read_text(encoding="utf-8"))


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


def ntc_2018(a_g: float, plateau: float, period: float, soil: str, topography: str = "T1") -> Spectrum:
    """NTC 2018, 3.2.3.2.1, from a_g [g], F_0, T_C* [s]: S = S_S S_T, T_C = C_C T_C*, T_B = T_C/3, T_D = 4 a_g/g + 1.6.

    Raises KeyError for categories that Tables 3.2.IV and 3.2.V do not have.
    """
    row, site = coefficients()["soil"][soil], coefficients()["topography"][topography]
    of_soil = min(max(row["start"] - row["slope"] * plateau * a_g, row["least"]), row["greatest"])
    corner = row["factor"] * period ** (1.0 + row["exponent"])
    return Spectrum(a_g, of_soil * site, plateau, corner / 3.0, corner, 4.0 * a_g + 1.6)


def en_1998(a_g: float, kind: int, soil: str) -> Spectrum:
    """EN 1998-1:2004, 3.2.2.2 with Tables 3.2 and 3.3, types 1 and 2; a_g [g], plateau 2.5.

    Raises KeyError for types and grounds that they do not have.
    """
    amplification, *corners = coefficients()["en_1998"][str(kind)][soil]
    return Spectrum(a_g, amplification, 2.5, *corners)


def spectrum_of(section: SpectrumSection, a_g: float | None = None) -> Spectrum:
    """The spectrum of a deck, or what it is with another acceleration of rock, all else of the site kept."""
    if section.ntc_2018 is not None:
        ntc = section.ntc_2018
        return ntc_2018(ntc.a_g if a_g is None else a_g, ntc.F_0, ntc.T_C_star, ntc.soil, ntc.topography)
    if section.en_1998 is not None:
        eurocode = section.en_1998
        return en_1998(eurocode.a_g if a_g is None else a_g, eurocode.type, eurocode.soil)
    assert section.table is not None  # a rule of the deck: one of the three
    ground = section.table[0][1]
    share = 1.0 if a_g is None else a_g / ground
    return Spectrum(ground * share, table=tuple((period, share * value) for period, value in section.table))


def damping_factor(damping: float) -> float:
    """NTC 2018 [3.2.4], EN 1998-1 (3.6): η = √(10/(5 + ξ)) ≥ 0.55, ξ in per cent."""
    return max(math.sqrt(10.0 / (5.0 + damping)), 0.55)


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


@dataclass(frozen=True)
class Floor:
    """A height of a building in its first mode.

    period        : T_1, s
    damping       : ξ_1, per cent
    participation : γ_1
    shape         : ψ_1(z), 1 at the top
    """

    period: float
    damping: float
    participation: float
    shape: float


def participation(storeys: int) -> float:
    """Circolare 7/2019 [C7.2.10]: γ_1 = 3n/(2n + 1), for a first mode that is a straight line, 1 at the top."""
    return 3.0 * storeys / (2.0 * storeys + 1.0)


def peak_floor_acceleration(spectrum: Spectrum, floor: Floor) -> float:
    """Circolare 7/2019 [C7.2.7]: a_Z = S_e(T_1, ξ_1) |γ_1 ψ_1| √(1 + 0.0004 ξ_1²), ξ_1 in per cent [g]."""
    share = abs(floor.participation * floor.shape) * math.sqrt(1.0 + 0.0004 * floor.damping**2)
    return ground_acceleration(spectrum, floor.period, floor.damping) * share


def floor_amplification(floor: Floor, damping: float) -> float:
    """Circolare 7/2019 [C7.2.9]: p = 1.1 ξ_1^−0.5 η(ξ).

    ξ_1 is a ratio here, 0.05 for 5 %, though the article has per cent, which fits [C7.2.7] alone: with per cent the
    peak of a floor would lie below the acceleration of the floor itself.
    """
    return 1.1 / math.sqrt(floor.damping / 100.0) * damping_factor(damping)


def floor_acceleration(spectrum: Spectrum, floor: Floor, period: float, damping: float = 5.0) -> float:
    """Circolare 7/2019 [C7.2.5], [C7.2.6] with the first mode: S_eZ(T, ξ, z) [g]; beyond T_1 not below the ground."""
    p, greatest = floor_amplification(floor, damping), peak_floor_acceleration(spectrum, floor)
    low, high = FLAT_FROM * floor.period, FLAT_TO * floor.period
    off = (1.0 - period / low) ** 1.6 if period < low else (period / high - 1.0) ** 1.2 if period > high else 0.0
    own = p * greatest / (1.0 + (p - 1.0) * off)
    return max(own, ground_acceleration(spectrum, period, damping)) if period > floor.period else own
