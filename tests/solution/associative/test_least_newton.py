from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.program.yield_conditions import yield_violation
from mbla.solution.associative.least_newton import LeastFound, LeastProblem, least_by_newton
from mbla.solution.associative.unique_forces import least_forces, point_weights
from mbla.solution.linear_algebra.stiffness import Stiffness, stiffness_of
from mbla.solution.nonassociative.law_state import LawState
from tests.line import WALL, Line, line_of
from tests.solution.associative.test_unique_forces import SETTINGS, associative, ignored

SHARE = 1e-4


def wall(*more: str) -> tuple[Line, Program, LawState]:
    line = line_of(WALL, "parameters.n=4", *more)
    return line, line.program, associative(line.program)


def solved(line: Line, program: Program, state: LawState, start: float = 0.0, steps: int = 200) -> LeastFound:
    weights = point_weights(program, line.contacts.point_areas)
    size = float(np.repeat(weights, program.components) @ state.forces.ravel() ** 2)
    mechanism = state.velocities / (program.live_load @ state.velocities)
    problem = LeastProblem(stiffness_of(program), mechanism, weights, SHARE * state.load_factor / size)
    multipliers = start * np.random.default_rng(3).normal(size=len(mechanism))
    return least_by_newton(problem, multipliers, state.load_factor, steps)


def test_forces_are_balanced_admissible_and_those_of_the_cone_program() -> None:
    line, program, state = wall()
    found = solved(line, program, state)
    loads = program.dead_load + found.load_factor * program.live_load
    assert np.abs(program.equilibrium_matrix @ found.forces.ravel() + loads).max() <= 1e-10
    assert yield_violation(found.forces, program.limits).max() <= 1e-12
    weights = point_weights(program, line.contacts.point_areas)
    other = least_forces(program, state, weights, SETTINGS, ignored)
    np.testing.assert_allclose(found.forces, other.state.forces, atol=1e-4)


def test_the_start_does_not_matter() -> None:
    line, program, state = wall()
    one, other = solved(line, program, state), solved(line, program, state, start=10.0)
    assert max(one.unbalanced, other.unbalanced) <= 1e-10
    np.testing.assert_allclose(one.forces, other.forces, atol=1e-7)


def test_cohesion_tension_and_crushing_bound_the_forces() -> None:
    line, program, _ = wall()
    n = program.n_points
    limits = replace(program.limits, cohesion=np.full(n, 0.2), tension=np.full(n, 0.1), compression=np.full(n, 3.0))
    stronger = replace(program, limits=limits)
    held = associative(stronger)
    found = solved(line, stronger, held)
    assert found.unbalanced <= 1e-10
    assert yield_violation(found.forces, limits).max() <= 1e-12
    assert found.forces[:, 0].min() == pytest.approx(-0.1)
    assert found.load_factor == pytest.approx(held.load_factor, rel=1e-5)


def test_steps_that_are_not_enough_leave_forces_out_of_balance() -> None:
    line, program, state = wall()
    found = solved(line, program, state, start=10.0, steps=1)
    assert found.steps == 1
    assert found.unbalanced > 1e-6


@pytest.mark.parametrize("cause", ["singular", "not a number", "uphill"])
def test_steps_that_lead_nowhere_leave_what_there_was(cause: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The shift grows with each until it is given up."""
    line, program, state = wall()
    factorized = Stiffness.factorized

    def made(stiffness: Stiffness, *arguments: Any, **named: Any) -> Callable[[FloatArray], FloatArray] | None:
        solve = factorized(stiffness, *arguments, **named)
        if cause == "singular" or solve is None:
            return None
        share = np.nan if cause == "not a number" else -1e6
        return lambda rhs: share * solve(rhs)

    monkeypatch.setattr(Stiffness, "factorized", made)
    found = solved(line, program, state)
    assert 1 < found.steps < 200
    assert found.load_factor == state.load_factor
    assert not found.multipliers.any()
    assert found.unbalanced > 1e-3
