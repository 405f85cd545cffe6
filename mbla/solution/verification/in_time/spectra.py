"""Response spectra of recorded points, anew from their histories.

Velocities are linear between their instants, so that there the acceleration is one value a. Of an oscillator
x'' + 2 ξ ω x' + ω² x = −a the complex number y = x' − λ* x with λ = ω (−ξ + i √(1 − ξ²)) follows y' = λ y − a::

    y(τ) = e^(λτ) y₀ − a (e^(λτ) − 1) / λ,      x = Im y / (ω √(1 − ξ²))

It is looked at five times in each step.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import Message
from mbla.model.motion.spectrum import DAMPING, PERIODS
from mbla.model.motion.time_history import TimeHistory
from mbla.solution.time_history.history import STEPS_IN_PERIOD, PointSpectra, RecordedHistories
from mbla.solution.verification.in_time.motion import base_changes

SAME = 0.01
"""Difference of two spectra over the greatest of their curve: 0.2 % of a peak are lost between two looks at it."""
LOOKS = 5
"""at each step"""


def spectra_failures(history: TimeHistory, found: RecordedHistories, spectra: PointSpectra | None) -> Iterator[Message]:
    """Where response spectra are not those of the histories of their points."""
    expected = PERIODS[STEPS_IN_PERIOD * history.step * (1.0 - 1e-9) <= PERIODS]
    expected = expected[expected <= found.times[-1] * (1.0 + 1e-9)]
    asked = bool(history.points) and len(expected) > 0 and len(found.times) > 1
    if spectra is None or not asked:
        if asked or spectra is not None:
            yield Message("time-histories", "response spectra of points are not those that the deck asks for")
        return
    n_points, n = len(history.points), len(expected)
    shapes = (spectra.base.shape, spectra.points.shape) == ((n, 3), (n_points, n, 3))
    if not (shapes and np.array_equal(spectra.periods, expected) and spectra.damping == DAMPING):
        yield Message("time-histories", "response spectra of points are of other periods or another damping")
        return
    times = found.velocity_times
    base = base_changes(history, np.full_like(times, -np.inf), times)
    velocities = np.hstack([base, (base[:, None] + found.velocities).reshape(len(times), -1)])
    anew = _spectra(times, velocities, expected).reshape(n, 1 + n_points, 3)
    told = np.concatenate([spectra.base[:, None], spectra.points.transpose(1, 0, 2)], axis=1)
    least = 1e-6 * float(anew.max(initial=0.0))
    for row, name in enumerate(["the base", *(point.name for point in history.points)]):
        off = np.abs(told[:, row] - anew[:, row]).max(axis=0)
        if not (off <= SAME * anew[:, row].max(axis=0) + least).all():
            yield Message("time-histories", f"the response spectrum of {name} is not that of its history")


def _spectra(times: FloatArray, velocities: FloatArray, periods: FloatArray) -> FloatArray:
    """Spectral accelerations (n, k) of velocities (m, k)."""
    frequency = 2.0 * np.pi / periods
    damped = frequency * np.sqrt(1.0 - DAMPING**2)
    root = (-DAMPING * frequency + 1j * damped)[:, None]
    y = np.zeros((len(periods), velocities.shape[1]), dtype=np.complex128)
    greatest = np.zeros(y.shape)
    known: dict[float, np.ndarray] = {}
    shares = (np.arange(LOOKS) + 1.0)[:, None, None] / LOOKS
    gains = np.diff(velocities, axis=0) / np.diff(times)[:, None]
    for length, gain in zip(np.round(np.diff(times), 12).tolist(), gains, strict=True):
        if length not in known:
            known[length] = np.exp(root * length * shares)
        inside = known[length] * (y + -gain / root) + gain / root
        np.maximum(greatest, np.abs(inside.imag).max(axis=0), out=greatest)
        y = inside[-1]
    return np.asarray(greatest * (frequency**2 / damped)[:, None])
