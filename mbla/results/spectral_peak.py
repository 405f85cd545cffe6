"""The greatest value of response spectra along x, y and z, and where it is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray


@dataclass(frozen=True)
class SpectralPeak:
    """A spectral acceleration, length/s2, the axis it is along, and its period, s."""

    axis: str
    period: float
    value: float


def spectral_peak(periods: FloatArray, values: FloatArray) -> SpectralPeak:
    """The greatest of spectral accelerations (n, 3)."""
    row, axis = np.unravel_index(int(values.argmax()), values.shape)
    return SpectralPeak("xyz"[axis], float(periods[row]), float(values[row, axis]))
