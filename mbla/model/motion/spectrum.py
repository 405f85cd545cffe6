"""Response spectra of accelerations, and what else is said of how strong they are.

Elastic response of one degree of freedom to an acceleration a of its base, x'' + 2 ξ ω x' + ω² x = −a, relative to the
base. Where a is linear within a step the response at its end is linear in that at its beginning and in both values of
a, exactly (Nigam and Jennings 1969, Bulletin of the Seismological Society of America 59, 909-922)::

    (x, x')_{i+1} = A (x, x')_i + B (a_i, a_{i+1})

A and B depend on the period and on the length of the step. Steps are divided so that none is above a fiftieth of a
period, between which 0.2 % of a peak is lost at most; after the end the free vibration is followed for one period of
its own.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.motion.signal import Signal

DAMPING = 0.05
"""share of critical damping, of spectra in codes"""
PERIODS = np.unique(np.concatenate([np.geomspace(0.05, 4.0, 77), [0.1, 0.2, 0.3, 0.5, 1.0, 2.0]]))
"""s, of a spectrum unless others are asked for"""
PARTS = 50
"""of a period, of which a step is one at most"""
POINTS, WEIGHTS = (values / 2.0 for values in np.polynomial.legendre.leggauss(6))
"""of Gauss, on (−1/2, 1/2)"""
SIGNIFICANT = (0.05, 0.95)
"""shares of the Arias intensity between which the significant duration is (Trifunac and Brady 1975)"""


@dataclass(frozen=True)
class Spectrum:
    """Greatest response of one degree of freedom, (n,) each, in the units of the signal.

    periods             : s
    damping             : share of critical damping
    displacement        : relative to the base
    acceleration        : absolute
    """

    periods: FloatArray
    damping: float
    displacement: FloatArray
    acceleration: FloatArray

    @property
    def pseudo_velocity(self) -> FloatArray:
        """ω times the displacement."""
        return np.asarray(2.0 * np.pi / self.periods * self.displacement)

    @property
    def pseudo_acceleration(self) -> FloatArray:
        """ω² times the displacement: the spectral acceleration of codes."""
        return np.asarray((2.0 * np.pi / self.periods) ** 2 * self.displacement)

    def at(self, period: float) -> float:
        """Pseudo-acceleration at a period within the spectrum, on straight lines between its own."""
        return float(np.interp(period, self.periods, self.pseudo_acceleration))


@dataclass(frozen=True)
class Intensity:
    """How strong an acceleration over time is.

    gravity : standard gravity in the units of the signal, for the Arias intensity
    """

    signal: Signal
    gravity: float

    @property
    def pga(self) -> float:
        """Peak acceleration, length/s2."""
        return self.signal.peak

    @property
    def pgv(self) -> float:
        """Peak velocity, length/s."""
        return self.signal.peak_integral

    @property
    def pgd(self) -> float:
        """Peak displacement, length."""
        return self.signal.peak_second_integral

    @property
    def arias(self) -> float:
        """Arias intensity π/(2g) ∫ a² dt, length/s (Arias 1970)."""
        return float(np.pi / (2.0 * self.gravity) * self._energy[-1])

    @property
    def significant_duration(self) -> float:
        """Time in which it grows from 5 to 95 % of the Arias intensity, s."""
        shares = self._energy / self._energy[-1]
        first, last = np.interp(SIGNIFICANT, shares, self.signal.times)
        return float(last - first)

    @property
    def _energy(self) -> FloatArray:
        """∫ a² dt at the samples, (n,)."""
        before, after = self.signal.values[:-1], self.signal.values[1:]
        parts = np.diff(self.signal.times) * (before**2 + before * after + after**2) / 3.0
        return np.concatenate([[0.0], np.cumsum(parts)])


def response_spectrum(signal: Signal, periods: FloatArray = PERIODS, damping: float = DAMPING) -> Spectrum:
    """The spectrum of an acceleration.

    periods : (n,) s, above 0
    damping : share of critical damping, below 1
    """
    displacement, acceleration = _greatest(signal.times, signal.values[:, None], periods, damping, after=True)
    return Spectrum(np.asarray(periods), damping, displacement[:, 0], acceleration[:, 0])


def spectral_accelerations(
    times: FloatArray, values: FloatArray, periods: FloatArray = PERIODS, damping: float = DAMPING
) -> FloatArray:
    """Pseudo-accelerations of k signals with the same times, (n, k), without what comes after the last of these.

    times   : (m,) s, as of a signal
    values  : (m, k) accelerations
    periods : (n,) s, above 0
    """
    displacement, _ = _greatest(times, values, periods, damping, after=False)
    return np.asarray((2.0 * np.pi / periods[:, None]) ** 2 * displacement)


def spectral_acceleration(signal: Signal, period: float, damping: float = DAMPING) -> float:
    """Pseudo-acceleration at a period above 0 s, as of the spectrum: number by number, which is quicker for one."""
    lengths, accelerations = _sampled(signal.times, signal.values[:, None], period)
    frequency = np.array([2.0 * np.pi / period])
    known = {length: _transition(frequency, damping, length)[:, :, 0].tolist() for length in set(lengths.tolist())}
    place, speed, most = 0.0, 0.0, 0.0
    values = accelerations[:, 0].tolist()
    for length, before, after in zip(lengths.tolist(), values, values[1:], strict=False):
        (a, b, c, d), (e, f, g, h) = known[length]
        place, speed = (
            a * place + b * speed + c * before + d * after,
            e * place + f * speed + g * before + h * after,
        )
        most = max(most, abs(place))
    (a, b), (c, d) = _free(frequency, damping, period / PARTS)[:, :, 0].tolist()
    for _ in range(PARTS):
        place, speed = a * place + b * speed, c * place + d * speed
        most = max(most, abs(place))
    return float(frequency[0] ** 2 * most)


def _greatest(
    times: FloatArray, values: FloatArray, periods: FloatArray, damping: float, *, after: bool
) -> tuple[FloatArray, FloatArray]:
    """Greatest displacements relative to the base and absolute accelerations, (n, k) each, of k signals.

    after : with the free vibration after them
    """
    lengths, accelerations = _sampled(times, values, float(periods.min()))
    frequency = 2.0 * np.pi / periods
    own = frequency[:, None]
    known: dict[float, FloatArray] = {}
    state = np.zeros((2, len(periods), values.shape[1]))
    displacement, acceleration = np.zeros(state.shape[1:]), np.zeros(state.shape[1:])

    def seen(state: FloatArray) -> None:
        np.maximum(displacement, np.abs(state[0]), out=displacement)
        absolute = own * (2.0 * damping * state[1] + own * state[0])
        np.maximum(acceleration, np.abs(absolute), out=acceleration)

    for number, length in enumerate(lengths.tolist()):
        if length not in known:
            known[length] = _transition(frequency, damping, length)[..., None]
        step, ends = known[length], accelerations[number : number + 2]
        state = step[:, 0] * state[0] + step[:, 1] * state[1] + step[:, 2] * ends[0] + step[:, 3] * ends[1]
        seen(state)
    free = _free(frequency, damping, periods / PARTS)[..., None]
    for _ in range(PARTS if after else 0):
        state = free[:, 0] * state[0] + free[:, 1] * state[1]
        seen(state)
    return displacement, acceleration


def _sampled(times: FloatArray, values: FloatArray, shortest: float) -> tuple[FloatArray, FloatArray]:
    """Lengths of steps (m,), rounded so that even ones are the same, and values at their ends (m + 1, k).

    A jump is a step of no length.
    """
    lengths = np.diff(times)
    parts = np.maximum(np.ceil(lengths * (PARTS / shortest) * (1.0 - 1e-9)), 1.0).astype(np.int64)
    within = np.concatenate([np.arange(1, count + 1) / count for count in parts.tolist()])
    row = np.repeat(np.arange(len(lengths)), parts)
    inside = values[row] + within[:, None] * np.diff(values, axis=0)[row]
    return np.round((lengths / parts)[row], 12), np.concatenate([values[:1], inside])


def _transition(frequency: FloatArray, damping: float, length: float) -> FloatArray:
    """A and B beside each other, (2, 4, n): by Duhamel's integral of −a, with Gauss points, which cancel nothing.

    They are exact to double precision for steps up to a fiftieth of a period; without an acceleration for any.
    """
    matrix = _free(frequency, damping, length)
    shares = 0.5 + POINTS
    after = np.stack([_free(frequency, damping, length * float(1.0 - share))[:, 1] for share in shares])
    at_end = -length * np.einsum("q,qsn->sn", WEIGHTS * shares, after)
    at_start = -length * np.einsum("q,qsn->sn", WEIGHTS * (1.0 - shares), after)
    return np.concatenate([matrix, at_start[:, None], at_end[:, None]], axis=1)


def _free(frequency: FloatArray, damping: float, time: FloatArray | float) -> FloatArray:
    """Displacement and velocity, (2, 2, n), of free vibration from a unit displacement and velocity.

    time : one for all, or (n,)
    """
    damped = frequency * np.sqrt(1.0 - damping**2)
    decay, sine, cosine = np.exp(-damping * frequency * time), np.sin(damped * time), np.cos(damped * time)
    lag = damping * frequency / damped * sine
    return np.array(
        [
            [decay * (cosine + lag), decay * sine / damped],
            [-decay * frequency**2 / damped * sine, decay * (cosine - lag)],
        ]
    )
