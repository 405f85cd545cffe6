"""Steps that creep: how long the next ones are, and what follows them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.solution.cone_solvers.cone_solution import ConeSolution
from mbla.solution.linear_algebra.stiffness import Stiffness, stiffness_of
from mbla.solution.nonassociative import law_steps, proximal
from mbla.solution.nonassociative.interior_step import InteriorResult
from mbla.solution.nonassociative.joint_law import LawProblem, LawStep
from mbla.solution.nonassociative.law_state import LawState
from mbla.solution.nonassociative.law_steps import (
    LONGER,
    SHORTER,
    SHORTEST,
    Step,
    Stepper,
    continued,
    continuing_step,
    lagged_step,
    next_step,
    repeated_step,
    step_near,
)
from mbla.solution.nonassociative.proximal import (
    CONVEX_STEPS,
    MOST_WORK,
    SHORTENED,
    ProximalRun,
    _convex_after,
    gravity_state,
    step_size,
)
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status
from mbla.solution.standing.standing import gravity_forces
from tests.line import BLOCK, WALL, line_of

RHO = 1e-3


def stepper() -> Stepper:
    program = line_of(BLOCK).program
    return Stepper(stiffness_of(program), np.zeros(program.n_points), SolverSettings(1e-8), lambda record: None)


def step_before(of: Stepper, *, shorter: int, moved: float = 1e-3, exact: bool = True) -> Step:
    anchor = np.ones((of.program.n_points, of.program.components))
    still = np.zeros(len(of.program.live_load))
    rho = RHO * SHORTER**shorter
    return Step(anchor, rho, still, 0.1, (1.0 + moved) * anchor, exact, work=1, shorter=shorter)


def lengths_tried(monkeypatch: pytest.MonkeyPatch, before: Step, of: Stepper) -> list[float]:
    """ρ of every attempt where none succeeds."""
    tried: list[float] = []

    def in_vain(stepper: Stepper, law: object, anchor: object, rho: float, *others: object) -> InteriorResult:
        tried.append(rho)
        return InteriorResult(before.velocities, 0.0, before.forces, False, 1)

    monkeypatch.setattr(law_steps, "continuing_step", lambda *arguments: (None, 0))
    monkeypatch.setattr(law_steps, "_interior", in_vain)
    assert next_step(of, before.forces, RHO, before, 1) is None
    return tried


def test_a_length_beyond_one_tried_in_vain_is_not_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    of = stepper()
    before = step_before(of, shorter=2)
    expected = [before.rho / LONGER, *(RHO * SHORTER**k for k in range(2, SHORTEST))]
    assert lengths_tried(monkeypatch, before, of) == pytest.approx(expected)


def test_after_a_convex_step_the_usual_length_comes_first(monkeypatch: pytest.MonkeyPatch) -> None:
    """It is no step of the exact law that could be longer, however little the forces changed."""
    of = stepper()
    before = step_before(of, shorter=0, exact=False)
    assert lengths_tried(monkeypatch, before, of)[0] == RHO


def test_shortened_steps_are_followed_by_convex_ones_once_they_move_little() -> None:
    of = stepper()
    assert _convex_after(step_before(of, shorter=1, moved=0.5 * SHORTENED)) == CONVEX_STEPS
    assert _convex_after(step_before(of, shorter=1, moved=2.0 * SHORTENED)) == 0
    assert _convex_after(step_before(of, shorter=0, moved=0.5 * SHORTENED)) == 0


def sizes_of_newtons_method(monkeypatch: pytest.MonkeyPatch, before: Step, of: Stepper) -> list[float]:
    """ρ of every attempt to go on as before where none succeeds."""
    tried: list[float] = []

    def in_vain(law: LawProblem, *arguments: object) -> LawStep:
        tried.append(law.rho)
        return LawStep(before.velocities, 0.0, before.forces, 1.0, 1)

    monkeypatch.setattr(law_steps, "continued", lambda *arguments: (before.velocities, 0.0))
    monkeypatch.setattr(law_steps, "exact_step", in_vain)
    assert continuing_step(of, before.forces, RHO, before) == (None, 1 + len(tried))
    return tried


def test_where_a_longer_step_fails_one_as_long_as_before_is_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    """And no shorter one than usual: each would be a fourth of the one before, at the same cost."""
    of = stepper()
    before = replace(step_before(of, shorter=0), by_continuation=True, rho=RHO / 2)
    assert sizes_of_newtons_method(monkeypatch, before, of) == [RHO / 2 / LONGER, RHO / 2, RHO / 2 * LONGER]
    before = replace(before, rho=RHO)
    assert sizes_of_newtons_method(monkeypatch, before, of) == [RHO / LONGER, RHO]
    assert sizes_of_newtons_method(monkeypatch, replace(before, by_continuation=False), of) == [RHO]


def test_repeated_convex_steps_come_to_the_exact_step() -> None:
    """Without a try of Newton's method the friction of the last forces is that of the step itself."""
    line = line_of(WALL, "parameters.n=6")
    program = line.program
    of = Stepper(stiffness_of(program), np.zeros(program.n_points), SolverSettings(1e-8), lambda record: None)
    run = ProximalRun(of, [])
    gravity = gravity_state(run)
    assert isinstance(gravity, np.ndarray)
    rho = step_size(program, gravity)
    first = lagged_step(of, gravity, rho, 1)
    assert first is not None
    found = repeated_step(of, gravity, rho, first, 1)
    exact = next_step(of, gravity, rho, None, 1)
    assert found is not None
    assert exact is not None
    assert found.exact
    assert exact.exact
    assert found.load_factor == pytest.approx(exact.load_factor, rel=1e-8)
    assert np.abs(found.forces - exact.forces).max() < 1e-6 * np.abs(exact.forces).max()


def test_steps_that_come_no_closer_end() -> None:
    run = ProximalRun(stepper(), [])
    step = step_before(run.stepper, shorter=0)
    miss = [LawState(step.forces, step.velocities, 0.1, residual) for residual in (1e-2, 4e-3, 3e-3)]
    dear = replace(step, work=MOST_WORK // 2)
    assert not run.in_vain(step, miss[0])
    assert not run.in_vain(dear, miss[0])
    assert not run.in_vain(dear, miss[1])
    assert not run.in_vain(dear, miss[2])
    assert not run.in_vain(replace(dear, exact=False), miss[2])
    assert run.in_vain(step, miss[2])


@pytest.mark.parametrize(("seen", "asked"), [(4e-3, 5e-3), (6e-3, None)])
def test_steps_that_come_no_closer_may_be_as_close_as_asked(
    seen: float, asked: float | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    of = replace(stepper(), settings=SolverSettings(1e-8, residual=5e-3))
    run = ProximalRun(of, [])
    forces = np.ones((of.program.n_points, of.program.components))
    run.states.append(LawState(forces, np.ones(len(of.program.live_load)), 0.5, 3e-3))
    monkeypatch.setattr(proximal, "residual_with_closing", lambda *arguments: seen)
    result = proximal.finished(run, "the steps came no closer")
    assert result.status is Status.APPROXIMATE
    assert result.tolerance_requested == asked
    assert ("came no closer" in result.reason) is (asked is None)


def test_a_longer_step_that_ends_well_is_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    of = stepper()
    before = step_before(of, shorter=2)
    ended = InteriorResult(before.velocities, 0.3, before.forces, True, 7)
    polished = LawStep(before.velocities, 0.4, before.forces, 1e-12, 2)
    monkeypatch.setattr(law_steps, "continuing_step", lambda *arguments: (None, 5))
    monkeypatch.setattr(law_steps, "_interior", lambda *arguments: ended)
    monkeypatch.setattr(law_steps, "exact_step", lambda *arguments: polished)
    step = next_step(of, before.forces, RHO, before, 1)
    assert step is not None
    assert (step.rho, step.load_factor, step.exact, step.shorter) == (before.rho / LONGER, 0.4, True, 0)
    assert step.work == 5 + 7 + 2


@pytest.mark.parametrize("good", [0, 1, 2])
def test_repeated_steps_end_where_one_is_not_found(good: int, monkeypatch: pytest.MonkeyPatch) -> None:
    of = stepper()
    before = step_before(of, shorter=0)
    made: list[InteriorResult] = []

    def interior(*arguments: object) -> InteriorResult:
        made.append(InteriorResult(before.velocities, float(len(made)), before.forces, len(made) < good, 3))
        return made[-1]

    in_vain = LawStep(before.velocities, 9.0, before.forces, 1.0, 2)
    monkeypatch.setattr(law_steps, "_interior", interior)
    monkeypatch.setattr(law_steps, "exact_step", lambda *arguments: in_vain)
    step = repeated_step(of, before.forces, RHO, before, 1)
    assert len(made) == good + 1
    if good == 0:
        assert step is None
    else:
        assert step is not None
        assert (step.load_factor, step.exact, step.work) == (good - 1.0, False, 5 * good)


@pytest.mark.parametrize("solve", [None, lambda rhs: np.full_like(rhs, np.nan)], ids=["singular", "not finite"])
def test_joints_that_cannot_go_on_as_before_say_so(solve: object, monkeypatch: pytest.MonkeyPatch) -> None:
    of = stepper()
    before = step_before(of, shorter=0)
    monkeypatch.setattr(Stiffness, "factorized", lambda *arguments, **named: solve)
    assert continued(of, before, before.forces) is None
    assert continuing_step(of, before.forces, RHO, before) == (None, 0)


def test_a_step_near_a_state_goes_on_with_its_motion() -> None:
    """From the forces at rest of a block on its way to slide, with the motion in which it does."""
    program = line_of(BLOCK, "parameters.h=0.5").program
    stepper = Stepper(stiffness_of(program), np.zeros(program.n_points), SolverSettings(1e-8), lambda record: None)
    sliding = program.live_load / float(program.live_load @ program.live_load)
    gravity = gravity_forces(program, stepper.settings, stepper.log, [])
    assert not isinstance(gravity, ConeSolution)
    found = step_near(stepper, LawState(gravity, sliding, 0.0, np.nan), 0.03)
    assert found is not None
    assert found.exact
    assert found.load_factor == pytest.approx(0.5, rel=1e-6)
    assert step_near(stepper, LawState(gravity, np.full_like(sliding, np.nan), 0.0, np.nan), 0.03) is None
