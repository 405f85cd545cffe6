"""Signals: values, exact integrals, jumps."""

from __future__ import annotations

import numpy as np

from mbla.model.motion.signal import Signal


def test_a_constant_value_has_a_line_and_a_parabola_for_its_integrals() -> None:
    signal = Signal(np.array([1.0, 3.0]), np.array([2.0, 2.0]))
    times = np.array([0.0, 1.0, 2.0, 3.0, 5.0])
    assert signal.value(times).tolist() == [0.0, 2.0, 2.0, 2.0, 0.0]
    assert signal.integral(times).tolist() == [0.0, 0.0, 2.0, 4.0, 4.0]
    assert signal.second_integral(times).tolist() == [0.0, 0.0, 1.0, 4.0, 12.0]


def test_integrals_of_uneven_samples_are_those_of_lines_between_them() -> None:
    random = np.random.default_rng(1)
    signal = Signal(np.sort(random.uniform(0.0, 5.0, 20)), random.normal(size=20))
    times = np.linspace(-1.0, 7.0, 400_001)
    step = times[1] - times[0]
    value, first = signal.value(times), signal.integral(times)
    sums = np.concatenate([[0.0], np.cumsum(step * (value[1:] + value[:-1]) / 2.0)])
    twice = np.concatenate([[0.0], np.cumsum(step * (first[1:] + first[:-1]) / 2.0)])
    np.testing.assert_allclose(first, sums, rtol=0.0, atol=1e-4)
    np.testing.assert_allclose(signal.second_integral(times), twice, rtol=0.0, atol=1e-8)


def test_a_jump_has_its_later_value() -> None:
    signal = Signal(np.array([0.0, 1.0, 1.0, 3.0]), np.array([2.0, 2.0, -1.0, -1.0]))
    assert signal.value([0.5, 1.0, 2.0]).tolist() == [2.0, -1.0, -1.0]
    assert signal.integral([1.0, 3.0]).tolist() == [2.0, 0.0]
    assert signal.second_integral([1.0, 3.0, 9.0]).tolist() == [1.0, 3.0, 3.0]
    assert (signal.peak, signal.peak_integral, signal.peak_second_integral) == (2.0, 2.0, 3.0)


def test_a_signal_that_ends_with_a_jump_has_the_value_after_it() -> None:
    signal = Signal(np.array([0.0, 1.0, 1.0]), np.array([2.0, 2.0, 0.0]))
    assert signal.value([0.0, 0.5, 1.0, 1.5]).tolist() == [2.0, 2.0, 0.0, 0.0]
    assert signal.integral(1.0) == 2.0


def test_the_peak_of_the_integral_is_where_the_value_passes_zero() -> None:
    signal = Signal(np.array([0.0, 2.0]), np.array([1.0, -1.0]))
    assert signal.peak_integral == 0.5
    assert signal.integral(2.0) == 0.0


def test_later_and_scaled() -> None:
    signal = Signal(np.array([0.0, 2.0]), np.array([1.0, 1.0])).later(3.0).times_factor(-2.0)
    assert signal.value([2.9, 3.0, 5.0]).tolist() == [0.0, -2.0, -2.0]
    assert (signal.duration, signal.longest_step) == (2.0, 2.0)
