"""Articles on local mechanisms, a function each: Circolare 7/2019, C8.7.1.2.1, and Circolare 617/2009, C8A.4.

The texts of 2019 were read in a public transcription of the official print. Of 2009 only the linear analysis is here:
displacements (d_u* = 0.4 d_0*, the secant period) were not found in a text that could be read. So are the elastic
branches of elements free to vibrate ([C8.7.1.6], [C8.7.1.7], [C8.7.1.9]) and EN 1998-3:2025 left out.

Accelerations in g unless said otherwise, displacements in the unit of the deck, P and Q weights, δ virtual horizontal
displacements from the structure as built.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from mbla.arrays import FloatArray
from mbla.results.assessment.spectra import (
    FLAT_TO,
    Floor,
    Spectrum,
    damping_factor,
    floor_acceleration,
    ground_acceleration,
    peak_floor_acceleration,
)

SECANT = {"SLV": 1.68, "SLC": 1.56}
"""[C8.7.1.10], [C8.7.1.11]: of the secant period, times π"""
SHARES = {"SLV": 0.40, "SLC": 0.60}
"""C8.7.1.2.1.6: of the displacement at which the capacity curve is nothing"""
DAMPING = {"SLV": 8.0, "SLC": 10.0}
"""C8.7.1.2.1.8: equivalent damping of the mechanism, per cent"""
ACCELERATIONS = (1e-4, 10.0)
"""g, of the ground, between which a capacity is sought"""


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
    return SECANT[limit_state] * math.pi * math.sqrt(displacement / acceleration)


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
        found = floor_acceleration(spectrum, floor, period, damping) * period**2
        if period > FLAT_TO * floor.period:
            peak = floor_acceleration(spectrum, floor, floor.period, damping)
            found = max(found, peak * (FLAT_TO * floor.period) ** 2)
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


def demand_617(spectrum: Spectrum, floor: Floor | None) -> float:
    """Circolare 617/2009, C8A.4, linear, SLV: q a_0* is to be at least a_g S, and at a height S_e(T_1) ψ γ too [g]."""
    ground = spectrum.a_g * spectrum.S
    if floor is None:
        return ground
    return max(ground, ground_acceleration(spectrum, floor.period) * floor.shape * floor.participation)
