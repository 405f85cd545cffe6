"""Corrections of the baseline bring the base to rest, and leave what they should."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.model.motion.baseline import evenly_sampled, high_passed, without_line
from mbla.model.motion.signal import Signal

TIMES = np.arange(0.0, 20.0005, 0.01)
SHAKES = np.sin(2.0 * np.pi * 1.5 * TIMES) * np.sin(np.pi * TIMES / 20.0) ** 2


def test_a_line_is_taken_out_altogether() -> None:
    drifts = Signal(TIMES, 0.3 - 0.02 * TIMES)
    assert np.abs(without_line(drifts).values).max() < 1e-14


def test_a_corrected_record_ends_at_rest_where_it_began() -> None:
    random = np.random.default_rng(2)
    times = np.sort(random.uniform(0.0, 10.0, 500))
    corrected = without_line(Signal(times, random.normal(size=500) + 0.2))
    assert float(corrected.integral(times[-1])) == pytest.approx(0.0, abs=1e-12)
    assert float(corrected.second_integral(times[-1])) == pytest.approx(0.0, abs=1e-11)


def test_the_line_is_the_best_one() -> None:
    """Of least squares over all samples, where these are even and many."""
    values = SHAKES + 0.1 - 0.03 * TIMES
    slope, constant = np.polyfit(TIMES, values, 1)
    assert without_line(Signal(TIMES, values)).values == pytest.approx(values - constant - slope * TIMES, abs=1e-3)


def test_high_pass_takes_out_slow_motion_and_shifts_no_phase() -> None:
    slow = 0.5 * np.sin(2.0 * np.pi * 0.02 * TIMES)
    corrected = high_passed(Signal(TIMES, SHAKES + slow), 0.3)
    middle = (TIMES > 4.0) & (TIMES < 16.0)
    assert corrected.values[middle] == pytest.approx(SHAKES[middle], abs=0.02)
    assert abs(float(corrected.integral(20.0))) < 1e-12
    assert abs(float(corrected.second_integral(20.0))) < 1e-10


def test_high_pass_of_uneven_samples() -> None:
    random = np.random.default_rng(5)
    times = np.sort(np.append(random.uniform(0.0, 20.0, 8000), [0.0, 20.0]))
    uneven = Signal(times, np.interp(times, TIMES, SHAKES))
    even = high_passed(Signal(TIMES, SHAKES), 0.2)
    assert high_passed(uneven, 0.2).value(TIMES) == pytest.approx(even.values, abs=0.01)


def test_a_corner_that_samples_cannot_show() -> None:
    with pytest.raises(ValueError, match="must be < 50 Hz"):
        high_passed(Signal(TIMES, SHAKES), 50.0)
    with pytest.raises(ValueError, match=r"must be >= 0.0003 Hz, for samples that are 0.01 s apart"):
        high_passed(Signal(TIMES, SHAKES), 1e-4)


def test_even_samples_stay() -> None:
    signal = Signal(TIMES, SHAKES)
    assert evenly_sampled(signal) is signal
    jumps = Signal(np.array([0.0, 1.0, 1.0, 2.5]), np.array([1.0, 1.0, -1.0, -1.0]))
    assert np.diff(evenly_sampled(jumps).times) == pytest.approx([2.5 / 3.0] * 3)
