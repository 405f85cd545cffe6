"""Questions of load cases in time have figures of length and time, whatever the load factor is."""

from __future__ import annotations

import math

from mbla.deck.units import Units
from mbla.questions.modes import FirstPeriod
from mbla.questions.time_history import PeakDisplacement

UNITS = Units(length="mm")


def test_a_peak_is_in_the_unit_of_length() -> None:
    question = PeakDisplacement()
    assert question.head(UNITS) == "peak displacement [mm]"
    assert question.told(34.0, UNITS) == "a peak displacement of 34 mm"
    assert not question.multiplies
    assert not question.collapses
    assert question.unbounded.startswith("no ")
    assert question.no_equilibrium.startswith("no equilibrium")
    assert all((question.no_target, question.no_safety, question.no_sensitivity, question.forces_drawn))
    assert question.name == question.group == "time_history"
    assert question.column == "peak_displacement"
    assert math.isnan(question.value(0.0))


def test_a_period_is_in_seconds() -> None:
    question = FirstPeriod()
    assert question.head(UNITS) == "first period [s]"
    assert question.told(0.25, UNITS) == "a first period of 0.25 s"
    assert question.unbounded.startswith("no ")
    assert question.name == question.group == "modes"
    assert question.column == "first_period"
