"""Response spectra against closed forms and another integrator; figures of how strong a motion is."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from mbla.model.motion.pulses import pulse_of
from mbla.model.motion.signal import Signal
from mbla.model.motion.spectrum import Intensity, response_spectrum, spectral_acceleration, spectral_accelerations

GRAVITY = 9.81


def test_a_sudden_lasting_acceleration() -> None:
    """x = a/ω² (1 − e^(−ξωt)(cos + ...)): the peak is a/ω² (1 + e^(−ξπ/√(1 − ξ²)))."""
    signal = Signal(np.array([0.0, 100.0]), np.array([2.0, 2.0]))
    periods = np.array([0.2, 1.0, 5.0])
    spectrum = response_spectrum(signal, periods)
    over = 1.0 + np.exp(-0.05 * np.pi / np.sqrt(1.0 - 0.05**2))
    assert spectrum.pseudo_acceleration == pytest.approx(2.0 * over, rel=7e-3)
    assert spectrum.pseudo_acceleration.max() <= 2.0 * over * (1.0 + 1e-12)


@pytest.mark.long
def test_resonance_and_what_is_beside_it() -> None:
    """Against a Runge-Kutta method of eighth order."""
    damping = 0.02
    times = np.arange(0.0, 6.0005, 0.01)
    signal = Signal(times, np.sin(2.0 * np.pi * times))
    periods = np.array([0.35, 1.0, 2.2])
    found = response_spectrum(signal, periods, damping)
    for row, period in enumerate(periods):
        w = 2.0 * np.pi / period

        def motion(t: float, state: np.ndarray, w: float = w) -> list[float]:
            return [state[1], -float(signal.value(t)) - 2.0 * damping * w * state[1] - w * w * state[0]]

        at = np.linspace(0.0, 6.0 + periods.max(), 4001)
        answer = solve_ivp(motion, (0.0, at[-1]), [0.0, 0.0], "DOP853", at, max_step=0.01, rtol=1e-9, atol=1e-12)
        peak = np.abs(answer.y[0]).max()
        absolute = np.abs(2.0 * damping * w * answer.y[1] + w * w * answer.y[0]).max()
        assert found.displacement[row] == pytest.approx(peak, rel=3e-3)
        assert found.acceleration[row] == pytest.approx(absolute, rel=3e-3)


def test_a_short_impulse_gives_its_velocity() -> None:
    """Peak displacement V/ω of an undamped one, after the pulse is over."""
    pulse = pulse_of("half_sine", 0.002)
    spectrum = response_spectrum(pulse, np.array([2.0]), damping=0.0)
    assert spectrum.pseudo_velocity[0] == pytest.approx(float(pulse.integral(1.0)), rel=2e-3)


def test_pseudo_acceleration_of_a_stiff_one_is_the_peak() -> None:
    times = np.arange(0.0, 4.0005, 0.02)
    signal = Signal(times, np.sin(2.0 * np.pi * times) * np.exp(-times))
    spectrum = response_spectrum(signal, np.array([0.01, 0.02]))
    assert spectrum.pseudo_acceleration == pytest.approx(signal.peak, rel=0.01)


def test_uneven_samples_and_jumps_are_exact() -> None:
    """More samples on the same straight lines change nothing."""
    rough = Signal(np.array([0.0, 0.3, 0.3, 0.7, 1.5]), np.array([0.0, 1.0, -0.5, 0.2, 0.0]))
    more = np.unique(np.concatenate([rough.times, np.linspace(0.0, 1.5, 334)]))
    before = more < 0.3
    fine = Signal(
        np.concatenate([more[before], [0.3], more[~before]]),
        np.concatenate([rough.value(more[before]), [1.0], rough.value(more[~before])]),
    )
    periods = np.array([0.5, 1.0])
    one, other = response_spectrum(rough, periods), response_spectrum(fine, periods)
    assert one.displacement == pytest.approx(other.displacement, rel=5e-3)


def test_a_period_between_those_of_the_spectrum() -> None:
    spectrum = response_spectrum(pulse_of("sine", 0.5), np.array([0.4, 0.6]))
    assert spectrum.at(0.5) == pytest.approx(spectrum.pseudo_acceleration.mean())


def test_figures_of_a_constant_acceleration() -> None:
    intensity = Intensity(Signal(np.array([0.0, 4.0]), np.array([3.0, 3.0])), GRAVITY)
    assert (intensity.pga, intensity.pgv, intensity.pgd) == (3.0, 12.0, 24.0)
    assert intensity.arias == pytest.approx(np.pi / (2.0 * GRAVITY) * 36.0)
    assert intensity.significant_duration == pytest.approx(0.9 * 4.0)


def test_arias_intensity_of_a_wave() -> None:
    intensity = Intensity(pulse_of("sine", 2.0), GRAVITY)
    assert intensity.arias == pytest.approx(np.pi / (2.0 * GRAVITY) * 1.0, rel=1e-5)


@pytest.mark.parametrize("period", [0.02, 0.3, 2.0])
def test_one_period_by_itself(period: float) -> None:
    pulse = pulse_of("sine", 0.5)
    own = spectral_acceleration(pulse, period)
    assert own == pytest.approx(response_spectrum(pulse, np.array([period])).pseudo_acceleration[0], rel=1e-12)


def test_after_a_short_motion_each_vibrates_in_its_own_period() -> None:
    """Long periods beside a short one do not hide where that is at its peak."""
    pulse, periods = pulse_of("sine", 0.2), np.array([0.05, 0.3, 0.6, 4.0])
    beside = response_spectrum(pulse, periods).pseudo_acceleration
    assert beside == pytest.approx([spectral_acceleration(pulse, float(each)) for each in periods], rel=4e-3)


def test_spectra_of_several_signals_at_once() -> None:
    """Which are nothing for longer than a period at their end."""
    times = np.linspace(0.0, 2.0, 101)
    values = np.column_stack([np.sin(9.0 * times), np.cos(4.0 * times), 0.0 * times])
    values[times > 1.0] = 0.0
    periods = np.array([0.2, 0.7])
    found = spectral_accelerations(times, values, periods)
    alone = [response_spectrum(Signal(times, each), periods).pseudo_acceleration for each in values.T]
    assert np.allclose(found.T, alone, rtol=1e-12, atol=0.0)
