"""Response spectra of points against closed forms: what moves with the base, waves, impacts, elastic joints."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.model.motion.pulses import pulse_of
from mbla.model.motion.signal import Signal
from mbla.model.motion.spectrum import response_spectrum
from mbla.model.motion.time_history import BaseMotion, RecordedPoint, TimeHistory
from mbla.solution.time_history.history import STEPS_IN_PERIOD, RecordedHistories
from mbla.solution.time_history.point_spectra import point_spectra
from tests.results.rocking import asked, histories
from tests.solution.time_history.followed import deck_text, followed

G = 9.80665


def shaken(signal: Signal, step: float, last: float) -> TimeHistory:
    """A point on a base that moves along x."""
    point = RecordedPoint("point", 0, np.zeros(3))
    motion = BaseMotion("", signal, np.array([1.0, 0.0, 0.0]))
    return replace(asked(), motions=(motion,), forces=(), step=step, duration=last, points=(point,))


def moving(history: TimeHistory, velocities: FloatArray) -> RecordedHistories:
    """The point with velocities along x in the middles of steps, (m,), 0 at first."""
    times: FloatArray = history.step * np.arange(len(velocities), dtype=np.float64)
    found, nothing = histories(), np.zeros((len(times), 1, 3))
    moved = nothing.copy()
    moved[:, 0, 0] = velocities
    middles = np.maximum(times - history.step / 2.0, 0.0)
    return replace(found, times=times, velocity_times=middles, displacements=nothing, velocities=moved)


def test_what_moves_with_the_base_has_its_spectrum() -> None:
    """And that of the base over the steps is that of the record within what means over steps lose."""
    step, pulse = 0.01, pulse_of("sine", 0.4)
    history = shaken(pulse, step, 1.0)
    found = point_spectra(history, moving(history, np.zeros(101)))
    assert found is not None
    assert np.array_equal(found.points[0], found.base)
    record = response_spectrum(pulse, found.periods).pseudo_acceleration
    lost = np.sinc(step / found.periods) ** 2
    assert (found.base[:, 0] / record < 1.005).all()
    assert (found.base[:, 0] / record > lost - 0.005).all()
    assert not found.base[:, 1:].any()


def test_a_long_wave_is_enlarged_twenty_over_two() -> None:
    """A steady wave of acceleration a has the spectral acceleration a / (2 ξ) at its period, whatever the base does."""
    step, period, a = 0.01, 0.5, 0.3
    history = shaken(Signal(np.array([0.0, 20.0]), np.array([0.7, -0.2])), step, 20.0)
    times = np.maximum(step * np.arange(2001) - step / 2.0, 0.0)
    w = 2.0 * np.pi / period
    own = a / w * (1.0 - np.cos(w * times)) - history.base_velocity(times)[:, 0]
    found = point_spectra(history, moving(history, own))
    assert found is not None
    row = int(np.argmin(np.abs(found.periods - period)))
    assert found.points[0, row, 0] == pytest.approx(a / (2.0 * found.damping), rel=3e-3)
    assert found.points[0, :, 0].max() < a / (2.0 * found.damping) * 1.01


def test_an_impact_has_its_impulse() -> None:
    """A velocity V that is there after one step is the spectral velocity of long periods, e^(-ξ π/2) of it damped."""
    history = shaken(Signal(np.array([0.0, 4.0]), np.zeros(2)), 0.01, 4.0)
    found = point_spectra(history, moving(history, np.where(np.arange(401) < 50, 0.0, 0.4)))
    assert found is not None
    long = found.periods > 1.0
    ratio = found.damping / np.sqrt(1.0 - found.damping**2)
    most = 0.4 * np.exp(-ratio * np.arctan(1.0 / ratio))
    assert found.points[0, long, 0] * found.periods[long] / (2.0 * np.pi) == pytest.approx(most, rel=3e-3)


def test_short_periods_are_left_out() -> None:
    history = shaken(pulse_of("sine", 0.4), 0.02, 1.0)
    at_rest = moving(history, np.zeros(51))
    found = point_spectra(history, at_rest)
    assert found is not None
    assert found.periods[0] == pytest.approx(STEPS_IN_PERIOD * 0.02)
    assert point_spectra(replace(history, step=0.5), at_rest) is None
    assert point_spectra(replace(history, points=()), at_rest) is None


def test_a_history_without_its_end_leaves_long_periods_out() -> None:
    """A point that is stopped in the middle of its way does not go on at its velocity."""
    history = shaken(Signal(np.array([0.0, 1.0]), np.zeros(2)), 0.01, 1.0)
    found = point_spectra(history, moving(history, np.where(np.arange(101) < 100, 0.0, 0.4)))
    assert found is not None
    assert found.periods[-1] == pytest.approx(1.0)
    assert found.points[0, -1, 0] < 0.1 * 0.4 * 2.0 * np.pi


def test_a_block_on_elastic_joints() -> None:
    """Its greatest acceleration is that of one degree of freedom, and its spectrum is greatest at its period."""
    stiffness, pulse = 1.6e6, "pulse: sine, amplitude: 0.02 g, duration: 0.16, direction: x"
    box = "[{box: {group: b, material: stone, min: [0, 0, 0], max: [2, 2, 0.2]}}]"
    point = "record: {points: {top: {on: {group: b}, at: [1, 1, 0.1]}}}"
    steps = f"motion: {{{pulse}}}, step: 0.0025, duration: 0.4, contact_damping: 0, {point}"
    result, _, _ = followed(deck_text(box, steps, "friction: 5").replace("1.e10", str(stiffness)))
    spectra = result.spectra
    assert spectra is not None
    period = 2.0 * np.pi * np.sqrt(2000.0 * 0.2 / (0.4 * stiffness))
    assert result.period == pytest.approx(period, rel=0.03)
    signal = pulse_of("sine", 0.16).times_factor(0.02 * G)
    alone = response_spectrum(signal, np.array([result.period]), result.damping).acceleration[0]
    shortest = alone / (1.0 - (spectra.periods[0] / result.period) ** 2)  # what is stiffer follows the wave
    assert spectra.points[0, 0, 0] == pytest.approx(shortest, rel=0.03)
    at_most = spectra.periods[int(spectra.points[0, :, 0].argmax())]
    assert at_most == pytest.approx(result.period, rel=0.06)


def test_what_slides_feels_no_more_than_friction_gives() -> None:
    """In no step, and however long the step is beside the motion of the base: a step is solved to 1e-3 of free fall."""
    box = "[{box: {group: b, material: stone, min: [0, 0, 0], max: [1, 1, 0.3]}}]"
    steps = "motion: {pulse: sine, amplitude: 0.5 g, duration: 0.2, direction: x}, step: 0.01, duration: 0.3"
    steps += ", record: {points: {top: {on: {group: b}, at: [0.5, 0.5, 0.3]}}}"
    found = followed(deck_text(box, steps, "friction: 0.2"))[0].histories
    assert found is not None
    assert np.abs(found.displacements[:, 0, 0]).max() > 0.005
    assert np.abs(found.accelerations[:, 0, 0]).max() == pytest.approx(0.2 * G, abs=1e-3 * G)
