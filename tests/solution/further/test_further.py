"""Whatever is asked besides the load factor changes nothing of the answer: figure, status and mechanism to the bit."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.results.results import CaseResult
from mbla.solution.further.further import NOTHING_FURTHER
from mbla.solution.solution import Mechanics, Status
from tests.line import HEAD, WALL, case_of

TOWER = (
    HEAD
    + """\
joints: {dry: {friction: 0.4}}
blocks:
  - stack: {group: tower, material: stone, block: [1, 0.6, 0.5], count: 3}
supports: [{ground: {z: 0}}]
load_cases:
  push: {live: [{force: [100, 40, 0], on: {group: tower, index: 2}, at: [0.2, 0.3, 1.25]}]}
analysis: {flow_rule: non_associative}
"""
)
"""In space, pushed beside its middle, so that it twists."""

PUSHOVER = "load_cases.push.pushover={step: 0.01, steps: 2}"
EVERYTHING = ("analysis.sensitivity=true", "analysis.geometric_safety=true", PUSHOVER)
WITHOUT = ("analysis.search=0", "analysis.torsion=false")
ASSOCIATIVE, BY_PATH = "analysis.flow_rule=associative", "analysis.flow_rule=non_associative"


def assert_same(one: Mechanics | None, other: Mechanics | None) -> None:
    assert one is not None
    assert other is not None
    assert one.load_factor == other.load_factor
    for name, values in vars(one).items():
        assert np.array_equal(values, getattr(other, name)), name


@pytest.fixture(scope="module", params=[(WALL, BY_PATH), (TOWER, BY_PATH), (WALL, ASSOCIATIVE)])
def alone_and_with_all(request: pytest.FixtureRequest) -> tuple[CaseResult, CaseResult]:
    text, rule = request.param
    size = ("parameters.n=2",) if text is WALL else ()
    without = WITHOUT if rule == BY_PATH else ("analysis.standing=false",)
    further = EVERYTHING if rule == BY_PATH else (*EVERYTHING, "analysis.standing=true")
    return case_of(text, rule, *size, *without)[1], case_of(text, rule, *size, *further)[1]


def test_the_answer_is_the_same_with_all_further_results(alone_and_with_all: tuple[CaseResult, CaseResult]) -> None:
    alone, with_all = alone_and_with_all
    assert alone.status is with_all.status is Status.SOLVED
    assert alone.solution.status is with_all.solution.status
    assert alone.solution.reason == with_all.solution.reason
    assert_same(alone.solution.mechanics, with_all.solution.mechanics)
    assert_same(alone.solution.associative, with_all.solution.associative)
    for name in ("static_bound", "kinematic_bound"):
        assert getattr(alone.checks, name) == getattr(with_all.checks, name)


def test_all_further_results_are_there(alone_and_with_all: tuple[CaseResult, CaseResult]) -> None:
    """Else the test above would show nothing."""
    alone, with_all = (case.solution for case in alone_and_with_all)
    assert alone.further == NOTHING_FURTHER
    assert alone.further.geometric_safety is None
    assert alone.least is None
    assert alone.torsion is None
    assert len(with_all.further.pushover.curve) == 3
    assert with_all.further.sensitivity
    assert with_all.further.geometric_safety is not None
    assert with_all.standing is not None
    if with_all.flow_rule == "associative":
        assert alone.standing is None
    else:
        assert with_all.least is not None or with_all.torsion is not None
