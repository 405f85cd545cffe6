"""Steps that creep: how long the next ones are, and what follows them."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.solution import law_steps
from mbla.solution.interior_step import InteriorResult
from mbla.solution.law_steps import LONGER, SHORTER, SHORTEST, Step, Stepper, next_step
from mbla.solution.proximal import CONVEX_STEPS, MOST_CONVEX, SHORT, ProximalRun, _convex_after
from mbla.solution.settings import SolverSettings
from mbla.solution.stiffness import stiffness_of
from tests.line import BLOCK, line_of

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


def test_steps_that_creep_are_followed_by_more_and_more_convex_ones() -> None:
    of = stepper()
    run = ProximalRun(of, [])
    creeping = step_before(of, shorter=SHORT)
    counts = [_convex_after(run, creeping) for _ in range(4)]
    assert counts == [CONVEX_STEPS, 2 * CONVEX_STEPS, MOST_CONVEX, MOST_CONVEX]
    assert _convex_after(run, step_before(of, shorter=SHORT, moved=0.1)) == 0
    assert _convex_after(run, step_before(of, shorter=SHORT - 1)) == 0
