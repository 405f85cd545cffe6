"""Newton's method on the law of elastic joints: it solves a step to rounding, and says where it does not."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.program.stiffness_shares import shares_of
from mbla.solution.law.elastic_joints import ElasticJoints, Memory
from mbla.solution.law.joint_equations import JointStep
from mbla.solution.law.newton import NewtonState, by_newton
from mbla.solution.linear_algebra.stiffness import Stiffness
from tests.line import BLOCK, WALL, line_of


def gravity(deck: str, *overrides: str) -> tuple[JointStep, NewtonState]:
    """The dead load in one step, from joints without stress."""
    program = line_of(deck, *overrides).program
    joints = ElasticJoints.of(program, shares_of(program), 0.4)
    held = 1e-12 * joints.matrix.size
    step = JointStep(joints, Memory.stress_free(joints), 1.0, driven=False, work=0.0, held=held)
    return step, by_newton(step, np.zeros(len(program.dead_load)), 0.0, most=10)


def test_a_wall_at_rest_is_solved_to_rounding_in_a_few_iterations() -> None:
    step, found = gravity(WALL, "parameters.n=3")
    assert found.is_solved
    assert found.iterations <= 4
    forces, limits = found.forces, step.joints.program.limits
    assert (forces.normal >= 0.0).all()
    assert (np.hypot(*forces.shear) <= limits.friction * forces.normal + 1e-9).all()


def test_what_falls_stays_without_balance() -> None:
    """A block on a slope of more than its friction."""
    found = gravity(BLOCK, "parameters.mu=0.1", "load_cases.push.dead=[{gravity: [5, 0, -8]}]")[1]
    assert found.unbalanced > 1e-3


@pytest.mark.parametrize("answer", [None, np.nan], ids=["singular", "not a number"])
def test_without_a_direction_the_state_stays(answer: float | None, monkeypatch: pytest.MonkeyPatch) -> None:
    factors = None if answer is None else lambda rhs: np.full_like(rhs, answer)
    monkeypatch.setattr(Stiffness, "factorized", lambda *arguments, **named: factors)
    found = gravity(BLOCK)[1]
    assert not found.u.any()
    assert found.iterations == 1
    assert found.unbalanced > 1e-3
