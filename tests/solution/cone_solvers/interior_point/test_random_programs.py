"""Random assemblies, by the condensed method and by clarabel: what either says must not contradict the other.

Of the first thousand (counted by ``python -m`` with this folder's ``random_programs 0 1000``) the condensed method
decides 978 and clarabel 970, with bounds a median 4e-10 and 2e-9 of the load factor apart, without a contradiction.
Neither decides some of those with friction of a thousand or a million in space, and some whose factor is a millionth of
the loads; strengths of a hundred million block weights are hard for the condensed method.
"""

from __future__ import annotations

import statistics
import sys

import pytest

from mbla.solution.solution import Status
from mbla.solution.thresholds import GAP_TOLERANCE
from tests.solution.cone_solvers.interior_point.random_programs import (
    Outcome,
    compared,
    contradiction,
    outcome_of,
    random_case,
)

SHORT = range(40)
LONG, FULL = range(150), range(1000)


def test_the_generator_gives_every_kind_and_always_the_same() -> None:
    cases = [random_case(seed) for seed in SHORT]
    assert len({case.kind for case in cases}) >= 9
    assert random_case(7) == random_case(7)
    assert len({case.reduced for case in cases}) == 2


@pytest.mark.long
def test_neither_solver_contradicts_the_other() -> None:
    count = compared(SHORT)
    assert count.contradictions == []
    assert len(count.undecided["mbla"]) <= 2, count.undecided["mbla"]
    assert len(count.undecided["mbla"]) <= len(count.undecided["clarabel"])
    statuses = set(count.outcomes["mbla"])
    assert {"solved", "no_equilibrium", "unbounded"} <= statuses
    known = [gap for gap in count.gaps["mbla"] if gap == gap]
    assert statistics.median(known) < 1e-8


WRONG_BEFORE = (85, 229, 232, 298, 318, 556, 789, 798)
"""Friction of a thousand or a million, where a huge self-stress passed for a proof that there is no mechanism."""


@pytest.mark.every(3)
@pytest.mark.parametrize("seed", WRONG_BEFORE)
def test_rough_joints_have_a_load_factor_that_is_proved(seed: int) -> None:
    program = random_case(seed).program
    outcome = outcome_of(program, "mbla")
    assert outcome.result.status is Status.SOLVED
    assert outcome.gap <= GAP_TOLERANCE
    assert contradiction(program, outcome, outcome_of(program, "clarabel")) == ""


def test_what_contradicts_is_seen() -> None:
    """The comparison itself: one factor moved by more than both gaps, and one status turned."""
    first = random_case(next(seed for seed in SHORT if random_case(seed).kind == "arch")).program
    solved = outcome_of(first, "mbla")
    if solved.bounds is None:
        pytest.fail("the first arch has no load factor")
    moved = 1.0 + 1e-5
    other = Outcome(
        solved.result,
        type(solved.bounds)(
            solved.bounds.static * moved,
            solved.bounds.kinematic * moved,
            solved.bounds.gap,
            solved.bounds.forces,
            solved.bounds.load_factor * moved,
            solved.bounds.velocities,
        ),
    )
    assert "apart" in contradiction(first, solved, other)
    assert contradiction(first, solved, solved) == ""


@pytest.mark.parametrize(
    "seeds", [pytest.param(LONG, marks=pytest.mark.long), pytest.param(FULL, marks=pytest.mark.trust)], ids=len
)
def test_many_random_programs(seeds: range, capsys: pytest.CaptureFixture[str]) -> None:
    count = compared(seeds)
    with capsys.disabled():
        sys.stdout.write("\n" + count.words() + "\n")
    assert count.contradictions == []
    assert len(count.undecided["mbla"]) <= 0.03 * len(seeds)
    assert len(count.undecided["mbla"]) <= len(count.undecided["clarabel"])
