"""Questions of load cases in time have figures of length and time, whatever the load factor is."""

from __future__ import annotations

import math

import numpy as np
import pytest

from mbla.deck.units import Units
from mbla.questions.modes import FirstPeriod
from mbla.questions.question import Question
from mbla.questions.time_history import PeakDisplacement

UNITS = Units(length="mm")
KNOWN = ((PeakDisplacement(34.0, 33.0, 35.0), 34.0, "peak displacement [mm]", "a peak displacement of 34 mm"),)
every_question = pytest.mark.parametrize(("question", "value", "head", "words"), KNOWN)


@every_question
def test_value_and_words(question: Question, value: float, head: str, words: str) -> None:
    assert question.value(0.0) == question.stated(7.0) == value
    assert question.head(UNITS) == head
    assert question.told(value, UNITS) == question.factor_words(0.0, UNITS) == words
    assert not question.multiplies
    assert not question.collapses
    assert question.unbounded.startswith("no ")
    assert question.no_equilibrium.startswith("no equilibrium")
    assert all((question.no_target, question.no_safety, question.no_sensitivity, question.forces_drawn))
    assert question.name == question.group == question.column == type(question).__module__.rpartition(".")[2]


def test_a_period_is_in_seconds() -> None:
    question = FirstPeriod()
    assert question.head(UNITS) == "first period [s]"
    assert question.told(0.25, UNITS) == "a first period of 0.25 s"
    assert question.unbounded.startswith("no ")
    assert question.name == question.group == question.column == "modes"


@every_question
def test_unknown_before_it_is_followed(question: Question, value: float, head: str, words: str) -> None:
    assert math.isnan(type(question)().value(0.0))


def test_bounds_of_a_peak_are_those_of_the_steps() -> None:
    assert PeakDisplacement(34.0, 33.0, 35.0).bounds(0.0, 0.0, None) == (33.0, 35.0)
    assert np.isnan(FirstPeriod().bounds(0.0, 0.0, None)).all()
