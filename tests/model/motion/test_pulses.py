"""Pulses: their impulse, what they move, and that the base is at rest after those that say so."""

from __future__ import annotations

import math

import pytest

from mbla.deck.sections.motion import MotionSection
from mbla.model.motion.pulses import PULSES, pulse_of


def test_every_pulse_of_the_deck_is_one() -> None:
    choices = MotionSection.model_fields["pulse"].annotation
    assert {name for name in PULSES if name in str(choices)} == set(PULSES)


@pytest.mark.parametrize(
    ("form", "duration", "peak", "impulse"),
    [
        ("rectangle", 0.5, 1.0, 0.5),
        ("half_sine", 0.5, 1.0, 1.0 / math.pi),
        ("sine", 0.5, 1.0, 0.0),
        ("dejong", 1.5, 1.0, 0.0),
    ],
)
def test_impulse_and_peak(form: str, duration: float, peak: float, impulse: float) -> None:
    pulse = pulse_of(form, 0.5)
    assert pulse.duration == duration
    assert pulse.peak == peak
    assert float(pulse.integral(10.0)) == pytest.approx(impulse, rel=1e-6, abs=1e-12)


def test_velocity_and_displacement_of_one_wave() -> None:
    """∫ sin ωt: velocity (1 − cos ωt)/ω, at most 2/ω, displacement T/ω at the end."""
    pulse, frequency = pulse_of("sine", 0.5), 4.0 * math.pi
    assert pulse.peak_integral == pytest.approx(2.0 / frequency, rel=1e-6)
    assert float(pulse.second_integral(0.5)) == pytest.approx(0.5 / frequency, rel=1e-6)


def test_the_impulse_for_arches_turns_after_its_duration() -> None:
    pulse = pulse_of("dejong", 0.2)
    assert pulse.value([0.1, 0.2, 0.5, 0.61]).tolist() == [1.0, -0.5, -0.5, 0.0]
    assert pulse.peak_integral == pytest.approx(0.2)
