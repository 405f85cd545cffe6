"""The law of the stress-free assembly, its tangent, and states on springs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.solution.settings import SolverSettings
from mbla.solution.standing import weak_spring_continuation as weakening
from mbla.solution.standing.spring_problem import (
    PATTERN_FROM,
    Joints,
    LatePattern,
    SpringProblem,
    joints_at,
    spring_problem,
    stiffness_at,
)
from mbla.solution.standing.spring_state import newton_step, spring_state
from mbla.solution.standing.weak_spring_continuation import Outcome, Weakening, is_diagonal, springs_of, weaken_springs
from tests.line import BLOCK, WALL, line_of
from tests.solution.standing_structures import rafters


def problem_of(text: str, *overrides: str) -> SpringProblem:
    """The dead load of a deck on springs of unit size."""
    program = line_of(text, *overrides).program
    springs = sp.csr_array(sp.eye_array(len(program.dead_load), format="csr"))
    return spring_problem(program.equilibrium_matrix, program.dead_load, program.limits, springs, None)


def test_the_tangent_is_that_of_the_law() -> None:
    """By differences, at displacements at which joints are open, stick and slide."""
    problem = replace(problem_of(WALL, "parameters.n=3"), shear_stiffness=0.4)
    rng = np.random.default_rng(3)
    u, du = rng.normal(size=(2, len(problem.load)))
    here, there = joints_at(problem, 0.2, u), joints_at(problem, 0.2, u + 1e-7 * du)
    slips, open_ = here.state.slips, ~here.state.in_contact
    assert 0 < slips.sum() < len(slips)
    assert 0 < open_.sum() < len(open_)
    tangent = stiffness_at(problem, 0.2, here)
    assert (here.unbalanced - there.unbalanced) / 1e-7 == pytest.approx(tangent @ du, abs=1e-5)


@pytest.mark.parametrize("reductions", ["true", "false"])
def test_a_step_on_the_pattern_is_newtons_step(reductions: str) -> None:
    """The same as by products of sparse matrices, planar and in space, with joints open, sticking and sliding."""
    program = line_of(WALL, "parameters.n=3", f"analysis.reductions={reductions}").program
    springs = springs_of(program, "dead_load")[0]
    problem = spring_problem(program.equilibrium_matrix, program.dead_load, program.limits, springs, None)
    here = joints_at(problem, 0.2, np.random.default_rng(3).normal(size=len(problem.load)))
    assert is_diagonal(springs)
    late = replace(problem, pattern=LatePattern(program))
    steps = [newton_step(late, 0.2, here) for _ in range(PATTERN_FROM + 1)]
    first, last = steps[0], steps[-1]
    plain = newton_step(problem, 0.2, here)
    assert first is not None
    assert last is not None
    assert plain is not None
    assert np.array_equal(first, plain)
    assert not np.array_equal(last, plain)  # by another order of elimination
    assert last == pytest.approx(plain, rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("kappa", [1.0, 1e-3])
def test_a_block_on_springs_settles_as_two_springs_in_parallel(kappa: float) -> None:
    """Four joints of stiffness 1 and one of κ under a weight of 1."""
    problem = problem_of(BLOCK)
    u = spring_state(problem, kappa, [np.zeros(6)])
    assert u is not None
    assert u[2] == pytest.approx(-1 / (4 + kappa), rel=1e-9)
    assert np.delete(u, 2) == pytest.approx(0, abs=1e-12)


def test_steps_in_time_find_the_state_where_newtons_method_does_not(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two steps of Newton's method do not lead there from rest; close by they do."""
    problem = problem_of(rafters(0.4))
    start = [np.zeros(len(problem.load))]
    direct = spring_state(problem, 1e-3, start)
    assert direct is not None
    monkeypatch.setattr("mbla.solution.standing.spring_state.NEWTON_STEPS", 2)
    assert spring_state(problem, 1e-3, start) == pytest.approx(direct, abs=1e-9)
    monkeypatch.setattr("mbla.solution.standing.spring_state.DASHPOT_STEPS", 0)
    assert spring_state(problem, 1e-3, start) is None


def test_the_share_is_what_friction_leaves_over() -> None:
    """A block pushed by 0.6 of its weight on friction 0.5: its spring keeps 0.1, whatever its stiffness."""
    line = line_of(
        BLOCK, "parameters.h=0.2", "load_cases.push.dead=[{acceleration: [0.6, 0, 0]}, {gravity: [0, 0, -9.81]}]"
    )
    settings = SolverSettings(tolerance=1e-8)
    weakening = weaken_springs(line.program, "dead_load", line.program.limits, settings)
    # the load is sqrt(1 + 0.6²) weights; the moment of the push is balanced by the joints
    assert weakening.share == pytest.approx(0.1 / np.hypot(1, 0.6), rel=1e-2)


def test_where_nothing_slides_or_opens_one_step_finds_the_state_that_the_path_leads_to(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    program, settings = line_of(WALL).program, SolverSettings(tolerance=1e-8)
    steps = counted_steps(monkeypatch)
    at_once = weaken_springs(program, "dead_load", program.limits, settings)
    assert len(steps) == 1
    monkeypatch.setattr("mbla.solution.standing.weak_spring_continuation._elastic_state", lambda problem, blocks: None)
    by_path = weaken_springs(program, "dead_load", program.limits, settings)
    assert len(steps) == 5
    assert at_once.outcome is by_path.outcome is Outcome.CARRIED
    assert at_once.block == by_path.block
    # springs carry 1e-7 of a load at the end of the path
    assert at_once.forces == pytest.approx(by_path.forces, abs=1e-6)


def counted_steps(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """The stiffness of springs at every step of Newton's method from now on."""
    steps: list[float] = []

    def counted(problem: SpringProblem, kappa: float, joints: Joints) -> FloatArray | None:
        steps.append(kappa)
        return newton_step(problem, kappa, joints)

    for module in ("standing.spring_state", "standing.weak_spring_continuation"):
        monkeypatch.setattr(f"mbla.solution.{module}.newton_step", counted)
    return steps


# Springs that get weaker, with the states on them made up: how far they are weakened, and what that says.


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
