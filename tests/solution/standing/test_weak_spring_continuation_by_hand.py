"""Springs that get weaker, with the states on them made up: how far they are weakened, and what that says."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from mbla.program.program import Program
from mbla.solution.settings import SolverSettings
from mbla.solution.standing import weak_spring_continuation as weakening
from mbla.solution.standing.weak_spring_continuation import Outcome, Weakening, weaken_springs
from tests.line import BLOCK, line_of

SETTINGS = SolverSettings(1e-8)
Share = Callable[[float], float]
"""Share of the load on the spring of the block, on springs κ; not a number where there is no state."""


def weakened(share: Share, monkeypatch: pytest.MonkeyPatch) -> tuple[Weakening, list[float]]:
    """The outcome, and the springs that were asked for, of the first ratio of stiffnesses."""
    program: Program = line_of(BLOCK).program
    asked: list[float] = []

    def state_at(problem: object, blocks: object, kappa: float, states: object) -> weakening._State | None:
        asked.append(kappa)
        found = share(kappa)
        nothing = np.zeros(len(program.dead_load))
        return None if np.isnan(found) else weakening._State(kappa, nothing, found, 0)

    monkeypatch.setattr(weakening, "_elastic_state", lambda *arguments: None)
    monkeypatch.setattr(weakening, "_state_at", state_at)
    monkeypatch.setattr(weakening, "SHEAR_STIFFNESSES", (1.0,))
    monkeypatch.setattr(weakening, "agreed", lambda found: found)
    return weaken_springs(program, "dead_load", program.limits, SETTINGS), asked


def test_what_is_carried_leaves_its_springs(monkeypatch: pytest.MonkeyPatch) -> None:
    result, asked = weakened(lambda kappa: min(0.5, kappa), monkeypatch)
    assert result.outcome is Outcome.CARRIED
    assert result.share < weakening.CARRIED_SHARE
    assert asked == sorted(asked, reverse=True)


def test_what_falls_stays_on_its_springs(monkeypatch: pytest.MonkeyPatch) -> None:
    result, asked = weakened(lambda kappa: 0.5, monkeypatch)
    assert result.outcome is Outcome.FALLS
    assert result.block == 0
    assert asked[-1] <= weakening.PLATEAU_FROM


def test_what_the_weakest_springs_go_on_carrying_in_part_is_undecided(monkeypatch: pytest.MonkeyPatch) -> None:
    """The share falls with the fourth root of the springs: no plateau, and 1e-3 in the end."""
    result, asked = weakened(lambda kappa: float(kappa**0.25), monkeypatch)
    assert result.outcome is Outcome.UNDECIDED
    assert result.reason == "springs went on carrying part of the load as they got weaker"
    assert asked[-1] == weakening.WEAKEST
    assert result.share == pytest.approx(1e-3)


@pytest.mark.parametrize(("lost", "outcome"), [(1, Outcome.FALLS), (100, Outcome.UNDECIDED)])
def test_springs_without_a_state_are_not_weakened_by_as_much(
    lost: int, outcome: Outcome, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Once, or every time from 1e-3 on: the steps get shorter until they are given up."""
    failures = iter(range(lost))
    result, asked = weakened(lambda k: np.nan if k < 2e-3 and next(failures, None) is not None else 0.5, monkeypatch)
    first = next(i for i, kappa in enumerate(asked) if kappa < 2e-3)
    assert asked[first] < asked[first + 1] < asked[first - 1]
    assert result.outcome is outcome
    if outcome is Outcome.UNDECIDED:
        assert result.reason == "no state on weak springs was found"
        assert asked[-1] / asked[first - 1] > asked[first] / asked[first - 1]


def test_no_state_on_the_first_springs_decides_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    result, asked = weakened(lambda kappa: np.nan, monkeypatch)
    assert result.outcome is Outcome.UNDECIDED
    assert asked == [1.0]


def test_a_leap_that_finds_the_load_still_on_springs_is_made_in_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    """In proportion to the springs at first, which leads to a leap; not any more below a thousandth."""
    result, asked = weakened(lambda kappa: max(0.5 * kappa, 5e-4), monkeypatch)
    assert result.outcome is Outcome.FALLS
    assert asked != sorted(asked, reverse=True)
