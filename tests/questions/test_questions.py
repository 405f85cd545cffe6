"""One contract: every question has a name, a unit, a value, bounds and words, and a deck that asks it."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules

import numpy as np
import pytest

import mbla.questions
from mbla.deck import read_deck
from mbla.deck.units import Units
from mbla.model import build_model
from mbla.questions.angle import Angle
from mbla.questions.force import Force, Objective
from mbla.questions.load_factor import LoadFactor
from mbla.questions.modes import FirstPeriod
from mbla.questions.question import ZERO, Question
from mbla.questions.reaction import Reaction, Settlement
from mbla.questions.tilt import Tilt
from mbla.questions.time_history import PeakDisplacement
from mbla.questions.travel import Travel
from mbla.questions.travel_position import TravelPosition
from mbla.results.quantities.registry import CASE_COLUMNS

DECKS = Path(__file__).parents[2] / "decks"
UNITS = Units()
NONE = np.zeros(0, dtype=np.int64)
LOADS = np.zeros((1, 6))
SUPPORT = Settlement(np.array([3, 4]), np.zeros((2, 6)), False, "a support gives way", 10.0, 20.0)
GREATEST = replace(SUPPORT, sense=-1.0)
POSITION = TravelPosition("train", 2, 3, np.zeros((1, 3)), np.ones(1), np.ones((1, 3)), NONE)


def end(name: str) -> Objective:
    return Objective("thrust", name, 0.0, NONE, NONE, np.array([1.0, 0.0, 0.0]))


def table(angle: float = math.nan) -> Tilt:
    """A table by the tangent of its angle, or one that loads lead to an angle on."""
    return Tilt(np.array([0.0, 1.0, 0.0]), LOADS, LOADS, LOADS, angle, tangent=math.isnan(angle))


@dataclass(frozen=True)
class Example:
    """A question, the deck that asks it, and what a load factor of 0.25 between 0.2 and 0.3 stands for."""

    question: Question
    deck: str
    head: str
    value: float
    bounds: tuple[float, float]
    words: str


EXAMPLES = (
    Example(
        LoadFactor(),
        "benchmarks/closed_forms/block_sliding.yaml",
        *("load factor", 0.25, (0.2, 0.3), "0.25 times the live load"),
    ),
    Example(
        Travel(POSITION),
        "benchmarks/closed_forms/beam_under_travelling_load.yaml",
        *("load factor", 0.25, (0.2, 0.3), "0.25 times the live load"),
    ),
    Example(
        Reaction(SUPPORT),
        "benchmarks/closed_forms/spreading_arch.yaml",
        *("reaction [N]", 5.0, (4.0, 6.0), "a reaction of 5 N"),
    ),
    Example(
        Reaction(replace(SUPPORT, turns=True)),
        "tutorials/settling_wall.yaml",
        *("reaction [N m]", 5.0, (4.0, 6.0), "a reaction of 5 N m"),
    ),
    Example(
        Force(SUPPORT, end("least")),
        "tutorials/thrust_of_an_arch.yaml",
        *("force [N]", 5.0, (4.0, 6.0), "a force of 5 N"),
    ),
    Example(
        Force(GREATEST, end("greatest")),
        "tutorials/thrust_of_an_arch.yaml",
        *("force [N]", -5.0, (-6.0, -4.0), "a force of -5 N"),
    ),
    Example(
        Angle(table()),
        "benchmarks/closed_forms/tilting_block.yaml",
        "angle [degree]",
        math.degrees(math.atan(0.25)),
        (math.degrees(math.atan(0.2)), math.degrees(math.atan(0.3))),
        "14.0362 degrees of tilt",
    ),
)
every_question = pytest.mark.parametrize("example", EXAMPLES, ids=lambda example: example.question.what)


def kinds() -> set[type]:
    """Classes of questions, one to a file of the package."""
    modules = [import_module(f"mbla.questions.{each.name}") for each in iter_modules(mbla.questions.__path__)]
    classes = [kind for module in modules for kind in vars(module).values() if isinstance(kind, type)]
    return {kind for kind in classes if Question in kind.__mro__ and "name" in vars(kind)}


def test_every_question_has_a_name_of_its_own_and_an_example() -> None:
    assert kinds() == {type(example.question) for example in EXAMPLES} | {PeakDisplacement, FirstPeriod}
    names = [kind.name for kind in kinds()]  # type: ignore[attr-defined]
    assert sorted(names) == sorted(set(names))
    assert {f"mbla.questions.{kind.name}" for kind in kinds()} == {kind.__module__ for kind in kinds()}  # type: ignore[attr-defined]


@every_question
def test_value_and_bounds(example: Example) -> None:
    question = example.question
    low, high = question.bounds(0.2, 0.3, np.zeros((1, 6)))
    assert question.value(0.25) == pytest.approx(example.value)
    assert question.stated(0.25) == question.value(0.25)
    assert (low, high) == pytest.approx(example.bounds)
    assert low < question.value(0.25) < high
    assert set(question.by_proof((low, high))) == {low, high}
    assert np.isnan(question.bounds(math.nan, math.nan, None)).all()
    slope = (question.compared(0.3) - question.compared(0.2)) / 0.1
    assert abs(slope) == pytest.approx(question.scale)
    assert question.least(2.0) in (0.0, question.scale * question.least_factor(2.0))
    assert question.least_factor(2.0) in (ZERO, 2.0 * ZERO)
    assert not math.isfinite(question.unlimited)


@every_question
def test_words(example: Example) -> None:
    question, value = example.question, example.question.value(0.25)
    assert question.head(UNITS) == example.head
    assert question.factor_words(0.25, UNITS) == question.told(value, UNITS) == example.words
    assert example.words in question.limited(example.words)
    assert question.unbounded.startswith("no ")
    assert question.no_equilibrium.startswith("no equilibrium")
    texts = (question.what, question.applied, question.factors, question.control, *question.powers)
    assert all((*texts, question.forces_drawn, question.moves(by_path=True), question.moves(by_path=False)))
    entries = question.entries(value, (1.0, 2.0), UNITS)
    assert (entries == ()) == (question.group == "load_factor")
    assert all("1 .. 2" in text for name, text in entries if "bounds" in name)
    assert (question.no_target == "") == (question.group == "load_factor")


@every_question
def test_its_figure_stands_in_the_record(example: Example) -> None:
    columns = {column.name for column in CASE_COLUMNS}
    assert example.question.column in columns
    assert {path.partition(".")[0] for path in example.question.paths} <= columns | {"reaction"}
    assert example.question.column.startswith(example.question.group)


@every_question
def test_a_deck_asks_it(example: Example) -> None:
    cases = build_model(read_deck(DECKS / example.deck)).load_cases
    own = [case for case in cases if type(case.question) is type(example.question)]
    assert any(case.question.column == example.question.column for case in own)
    assert all(case.deck_name == (case.question.series or case.name) for case in own)


@every_question
def test_what_a_pushover_follows_and_scales(example: Example) -> None:
    question, live = example.question, np.ones((1, 6))
    assert question.value_at(question.followed(0.25)) == pytest.approx(question.value(0.25))
    assert question.pushed(live) is (LOADS if question.group == "angle" else live)
    assert question.giving_way.tolist() == ([3, 4] if question.group == "reaction" else [])


@every_question
def test_what_is_not_derived_says_why(example: Example) -> None:
    own = example.question.group == "reaction"
    assert (example.question.no_safety != "", example.question.no_sensitivity != "") == (own, own)
    assert Angle(table(30.0)).no_sensitivity != ""


def test_rounding_of_a_reaction_is_written_as_zero() -> None:
    question = Reaction(SUPPORT)
    assert question.shown(1e-9) == 0.0
    assert question.shown(1e-6) == 1e-6
    assert question.factor_words(0.5 + 1e-13, UNITS) == "a reaction of 0 N"


def test_an_angle_that_the_load_leads_to_counts_at_one() -> None:
    led = Angle(table(30.0))
    assert (led.value(1.0), led.stated(0.99)) == (30.0, 30.0)
    assert math.isnan(led.value(0.99))
    assert led.factor_words(0.5, UNITS) == "0.5 times the change of the loads by the tilt"
    assert Angle(table(0.0)).value(0.0) == 0.0


def test_loads_of_a_table_on_the_way_to_an_angle() -> None:
    """They change as they do after a right angle more."""
    draw = np.random.default_rng(3)
    tilt = table(30.0).with_loads(lambda loads: draw.normal(size=loads.shape))
    for angle in (0.0, 0.3, 2.0):
        dead, live, change = Angle(tilt).loads_at(LOADS, LOADS, angle)
        assert dead + angle * live == pytest.approx(tilt.loads_at(np.degrees(angle)))
        assert change == pytest.approx(tilt.loads_at(np.degrees(angle) + 90.0) - tilt.fixed)
