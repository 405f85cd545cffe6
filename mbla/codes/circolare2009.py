"""Circolare 617/2009, C8A.4: the linear analysis of local mechanisms, SLV.

Displacements (d_u* = 0.4 d_0*, the secant period) are left out: they were not found in a text that could be read.
a_0* = α_0 ΣP/(M* FC) with g M*/ΣP = e* is that of :func:`mbla.codes.ntc2018.spectral_acceleration`.
"""

from __future__ import annotations

from mbla.codes.ntc2018 import Floor
from mbla.codes.spectrum import Spectrum, ground_acceleration


def demand(spectrum: Spectrum, floor: Floor | None) -> float:
    """C8A.4: q a_0* is to be at least a_g S, and at a height S_e(T_1) ψ γ too [g]."""
    ground = spectrum.a_g * spectrum.S
    if floor is None:
        return ground
    return max(ground, ground_acceleration(spectrum, floor.period) * floor.shape * floor.participation)
