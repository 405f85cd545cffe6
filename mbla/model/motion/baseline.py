"""Corrections of the baseline of a record, whose small errors of acceleration would carry the base away.

linear: a(t) − c₀ − c₁ τ with τ = t − T/2 for the least ∫ (a − c₀ − c₁ τ)² dt over the duration T. With the velocity V
and the displacement D at the end before::

    c₀ = V/T,      c₁ = 12/T³ ∫ a τ dt = 12/T³ (T V/2 − D)

What is left is orthogonal to 1 and to τ: velocity and displacement at its end are zero.

highpass: a Butterworth filter of fourth order, run forwards and backwards, which doubles its order and shifts no phase,
between zeros on both sides of 1.5 × 4 periods of its corner together (Boore 2005, doi:10.1785/0120040160; Boore and
Bommer 2005, doi:10.1016/j.soildyn.2004.10.007); what it moves beyond the ends is cut off, and the linear correction
brings the base to rest at the end.
"""

from __future__ import annotations

import numpy as np

from mbla.model.motion.signal import Signal

ORDER = 4
PERIODS = 1.5 * ORDER
"""of the corner, in zeros on both sides together"""
EVEN = 1e-6
"""difference of steps, relative, up to which they are the same"""


def without_line(signal: Signal) -> Signal:
    """The signal less its best straight line."""
    length = signal.duration
    velocity, displacement = float(signal.integral(signal.times[-1])), float(signal.second_integral(signal.times[-1]))
    since = signal.times - signal.times[0] - length / 2.0
    slope = 12.0 / length**3 * (length * velocity / 2.0 - displacement)
    return Signal(signal.times, signal.values - velocity / length - slope * since)


def high_passed(signal: Signal, corner: float) -> Signal:
    """The signal without what is below a frequency in Hz, at even steps.

    Raises ValueError for a corner that its steps cannot show, or that takes too many zeros beside it.
    """
    from scipy.signal import butter, sosfiltfilt

    even = evenly_sampled(signal)
    step = even.longest_step
    if not 2.0 * corner * step < 1.0:
        raise ValueError(f"must be < {0.5 / step:g} Hz, half of the samples in a second")
    least = PERIODS / (2.0 * MOST_SAMPLES * step)
    if corner < least:
        raise ValueError(f"must be >= {least:.2g} Hz, for samples that are {step:.2g} s apart")
    sections = butter(ORDER, corner, "highpass", fs=1.0 / step, output="sos")
    zeros = np.zeros(int(np.ceil(PERIODS / (2.0 * corner * step))) + 1)
    filtered = sosfiltfilt(sections, np.concatenate([zeros, even.values, zeros]), padlen=0)
    return without_line(Signal(even.times, filtered[len(zeros) : len(zeros) + len(even.times)]))


def evenly_sampled(signal: Signal) -> Signal:
    """The same at even steps, of the shortest one or a little less."""
    steps = np.diff(signal.times)
    steps = steps[steps > 0.0]
    if len(steps) == len(signal.times) - 1 and np.ptp(steps) <= EVEN * steps.max():
        return signal
    count = int(np.ceil(signal.duration / steps.min() * (1.0 - EVEN)))
    times = np.linspace(signal.times[0], signal.times[-1], min(count, MOST_SAMPLES) + 1)
    return Signal(times, signal.value(times))


MOST_SAMPLES = 1_000_000
"""of a record that is sampled anew"""
