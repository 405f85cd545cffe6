"""NTC 2018 with Circolare 7/2019: spectra on the ground and at a height, and the articles on local mechanisms.

C8.7.1.2.1, a function an article. The texts were read in a public transcription of the official print. The elastic
branches of elements free to vibrate ([C8.7.1.6], [C8.7.1.7], [C8.7.1.9]) and EN 1998-3:2025 are left out.

Accelerations in g unless said otherwise, periods in s, damping in per cent, displacements in the unit of the deck, P
and Q weights, δ virtual horizontal displacements from the structure as built. Coefficients: ``coefficients.toml``.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.codes.coefficients import coefficients
from mbla.codes.spectrum import Spectrum, damping_factor, ground_acceleration

ACCELERATIONS = (1e-4, 10.0)
"""g, of the ground, between which a capacity is sought"""


def spectrum(a_g: float, plateau: float, period: float, soil: str, topography: str = "T1") -> Spectrum:
    """NTC 2018, 3.2.3.2.1, from a_g [g], F_0, T_C* [s]: S = S_S S_T, T_C = C_C T_C*, T_B = T_C/3, T_D = 4 a_g/g + 1.6.

    Raises KeyError for categories that Tables 3.2.IV and 3.2.V do not have.
    """
    row, of = coefficients("soil")[soil], coefficients("corners")
    of_soil = min(max(row["start"] - row["slope"] * plateau * a_g, row["least"]), row["greatest"])
    corner, site = row["factor"] * period ** (1.0 + row["exponent"]), coefficients("topography")[topography]
    return Spectrum(a_g, of_soil * site, plateau, corner / of["T_B"], corner, of["slope"] * a_g + of["start"])


# --- At a height of a building --------------------------------------------------------------------------------------


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
    of_damping = math.sqrt(1.0 + coefficients("floor")["damping"] * floor.damping**2)
    share = abs(floor.participation * floor.shape) * of_damping
    return ground_acceleration(spectrum, floor.period, floor.damping) * share


def floor_amplification(floor: Floor, damping: float) -> float:
    """Circolare 7/2019 [C7.2.9]: p = 1.1 ξ_1^−0.5 η(ξ).

    ξ_1 is a ratio here, 0.05 for 5 %, though the article has per cent, which fits [C7.2.7] alone: with per cent the
    peak of a floor would lie below the acceleration of the floor itself.
    """
    return float(coefficients("floor")["peak"]) / math.sqrt(floor.damping / 100.0) * damping_factor(damping)


def floor_acceleration(spectrum: Spectrum, floor: Floor, period: float, damping: float = 5.0) -> float:
    """Circolare 7/2019 [C7.2.5], [C7.2.6] with the first mode: S_eZ(T, ξ, z) [g]; beyond T_1 not below the ground."""
    p, greatest, of = (
        floor_amplification(floor, damping),
        peak_floor_acceleration(spectrum, floor),
        coefficients("floor"),
    )
    low, high, off = of["flat_from"] * floor.period, of["flat_to"] * floor.period, 0.0
    if period < low:
        off = (1.0 - period / low) ** of["below"]
    elif period > high:
        off = (period / high - 1.0) ** of["above"]
    own = p * greatest / (1.0 + (p - 1.0) * off)
    return max(own, ground_acceleration(spectrum, period, damping)) if period > floor.period else own


# --- Local mechanisms -----------------------------------------------------------------------------------------------


def participating_share(weights: FloatArray, delta: FloatArray) -> float:
    """Circolare 7/2019 [C8.7.1.5]: e* = [Σ(P+Q)δ]² / (Σ(P+Q) Σ(P+Q)δ²); of 617/2009 g M*/ΣP, the same without Q.

    weights : (n,) P + Q of the kinematic blocks
    delta   : (n,)
    """
    return float((weights @ delta) ** 2 / (weights.sum() * (weights @ delta**2)))


def spectral_displacement(weights: FloatArray, delta: FloatArray, control: float) -> float:
    """Circolare 7/2019 [C8.7.1.4]: d / d_C = Σ(P+Q)δ² / (δ_C Σ(P+Q)δ), δ_C that of the control point."""
    return float((weights @ delta**2) / (control * (weights @ delta)))


def spectral_acceleration(alpha: float, share: float, confidence: float) -> float:
    """Circolare 7/2019 [C8.7.1.3], and [C8.7.1.8] with α_0: a = α g/(e* FC) [g].

    The same as a_0* = α_0 ΣP/(M* FC) of 617/2009, C8A.4.
    """
    return alpha / (share * confidence)


def secant_period(limit_state: str, displacement: float, acceleration: float) -> float:
    """Circolare 7/2019 [C8.7.1.10], [C8.7.1.11]: T = 1.68 π √(d/a) at SLV, 1.56 π √(d/a) at SLC [s].

    displacement, acceleration : in the same unit of length, and it per s²
    """
    share: float = coefficients("mechanism")[limit_state]["period"]
    return share * math.pi * math.sqrt(displacement / acceleration)


def floor_demand(spectrum: Spectrum, floor: Floor | None) -> float:
    """Circolare 7/2019, C8.7.1.2.1.5: acceleration at which a rigid mechanism must not begin [g].

    a_g S on the ground; at a height [C7.2.8] of the first mode, here not less than on the ground.
    """
    ground = spectrum.a_g * spectrum.S
    return ground if floor is None else max(ground, peak_floor_acceleration(spectrum, floor))


def displacement_demand(spectrum: Spectrum, floor: Floor | None, period: float, damping: float) -> float:
    """Circolare 7/2019 [C8.7.1.12]: S_eZ(T, ξ, z) T²/4π², at a height beyond b T_1 not below its value there [g s²].

    On the ground S_De(T); of a table the greatest up to T, as C8.7.1.2.1.8 asks of spectra of a site; nan beyond it.
    """
    if floor is not None:
        found, flat_to = (
            floor_acceleration(spectrum, floor, period, damping) * period**2,
            coefficients("floor")["flat_to"],
        )
        if period > flat_to * floor.period:
            peak = floor_acceleration(spectrum, floor, floor.period, damping)
            found = max(found, peak * (flat_to * floor.period) ** 2)
        return found / (4.0 * math.pi**2)
    found = ground_acceleration(spectrum, period, damping) * period**2
    if spectrum.table and not math.isnan(found):
        periods, (known, values) = np.linspace(0.0, period, 1000), np.array(spectrum.table).T
        found = max(found, damping_factor(damping) * float((np.interp(periods, known, values) * periods**2).max()))
    return found / (4.0 * math.pi**2)


def ground_capacity(demand: Callable[[float], float], capacity: float) -> float:
    """Circolare 7/2019, C8.7.1.2.1.5 and .8: the least a_g [g] whose demand is the capacity.

    Soil factor and T_D depend on a_g, so that a demand may also fall as a_g rises: it is sought from below.
    inf where no ground acceleration up to 10 g is enough, nan where the demand is not known.
    """
    steps = np.geomspace(*ACCELERATIONS, 400).tolist()
    excess = [demand(a_g) - capacity for a_g in steps]
    if any(map(math.isnan, excess)):
        return math.nan
    over = next((row for row, each in enumerate(excess) if each >= 0.0), None)
    if over is None:
        return math.inf
    low: float = steps[max(over - 1, 0)]
    high: float = steps[over]
    while high - low > 1e-12 * high:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if demand(middle) >= capacity else (middle, high)
    return high
