"""A quantity over time, linear between its samples, with its integrals."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from mbla.arrays import FloatArray


@dataclass(frozen=True)
class Signal:
    """Values at times, linear in between, zero before the first and after the last one.

    The integrals are exact: with a = a₀ + s τ from a sample on, v = v₀ + a₀ τ + s τ²/2 and
    d = d₀ + v₀ τ + a₀ τ²/2 + s τ³/6. They start at zero; after the last sample v stays and d goes on with it.

    times  : (n,) s, none before the one that it follows; equal times are a jump, where the later value holds
    values : (n,) n at least 2
    """

    times: FloatArray
    values: FloatArray

    def value(self, time: ArrayLike) -> FloatArray:
        """At times of any shape."""
        times = np.asarray(time, dtype=float)
        row, since = self._since(times)
        inside = self.values[row] + self._slopes[row] * since
        last = np.where(times == self.times[-1], self.values[-1], 0.0)
        return np.where((times >= self.times[0]) & (times < self.times[-1]), inside, last)

    def integral(self, time: ArrayLike) -> FloatArray:
        """From before the signal to times of any shape."""
        row, since = self._since(np.asarray(time, dtype=float))
        return np.asarray(self._first[row] + since * (self.values[row] + since * self._slopes[row] / 2.0))

    def second_integral(self, time: ArrayLike) -> FloatArray:
        """Integral of the integral."""
        times = np.asarray(time, dtype=float)
        row, since = self._since(times)
        curved = self.values[row] / 2.0 + since * self._slopes[row] / 6.0
        after = np.maximum(times - self.times[-1], 0.0)
        return np.asarray(self._second[row] + since * (self._first[row] + since * curved) + after * self._first[-1])

    def times_factor(self, factor: float) -> Signal:
        """Each value times a factor."""
        return replace(self, values=factor * self.values)

    def later(self, shift: float) -> Signal:
        """The same some seconds later."""
        return replace(self, times=self.times + shift)

    @property
    def duration(self) -> float:
        """From the first to the last sample, s."""
        return float(self.times[-1] - self.times[0])

    @property
    def longest_step(self) -> float:
        """Between two samples, s."""
        return float(np.diff(self.times).max())

    @property
    def usual_step(self) -> float:
        """The median of the steps, s, without jumps."""
        steps = np.diff(self.times)
        return float(np.median(steps[steps > 0.0]))

    @property
    def peak(self) -> float:
        """Greatest value without its sign."""
        return float(np.abs(self.values).max())

    @property
    def peak_integral(self) -> float:
        """The same of the integral, at samples and where the value passes zero."""
        return float(np.abs(self.integral(self._turning)).max())

    @property
    def peak_second_integral(self) -> float:
        """The same of the integral of the integral, at these times."""
        return float(np.abs(self.second_integral(self._turning)).max())

    def _since(self, times: FloatArray) -> tuple[np.ndarray[tuple[int, ...], np.dtype[np.int64]], FloatArray]:
        """Sample before times, but not the last one, and the time since it: not before the first, or after the last."""
        row = np.clip(np.searchsorted(self.times, times, side="right") - 1, 0, len(self.times) - 2)
        return row, np.clip(times, self.times[0], self.times[-1]) - self.times[row]

    @cached_property
    def _slopes(self) -> FloatArray:
        lengths = np.diff(self.times)
        return np.divide(np.diff(self.values), lengths, out=np.zeros(len(lengths)), where=lengths > 0.0)

    @cached_property
    def _first(self) -> FloatArray:
        """Integral at the samples, (n,)."""
        areas = np.diff(self.times) * (self.values[:-1] + self.values[1:]) / 2.0
        return np.concatenate([[0.0], np.cumsum(areas)])

    @cached_property
    def _second(self) -> FloatArray:
        """Integral of the integral at the samples, (n,)."""
        lengths = np.diff(self.times)
        curved = lengths**2 * (2.0 * self.values[:-1] + self.values[1:]) / 6.0
        return np.concatenate([[0.0], np.cumsum(lengths * self._first[:-1] + curved)])

    @cached_property
    def _turning(self) -> FloatArray:
        """Samples, and times at which the value passes zero."""
        before, after = self.values[:-1], self.values[1:]
        passes = before * after < 0.0
        share = before[passes] / (before - after)[passes]
        return np.concatenate([self.times, self.times[:-1][passes] + share * np.diff(self.times)[passes]])
