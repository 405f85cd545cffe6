"""Starts of the interior-point step: every joint on its law, rounded off, and inside its bounds."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.program.program import Program
from mbla.solution.linear_algebra.stiffness import stiffness_of
from mbla.solution.nonassociative.interior_joints import StepProblem, exact_law, outlying
from mbla.solution.nonassociative.interior_start import fresh_start, start_near
from mbla.solution.nonassociative.joint_law import joint_state
from tests.line import WALL, line_of
from tests.solution.nonassociative.test_dilatancy import wall_3

RHO = 0.3


def problem(program: Program, anchor: np.ndarray) -> StepProblem:
    law = exact_law(program, np.zeros(program.n_points))
    crushable = np.flatnonzero(np.isfinite(program.limits.compression))
    return StepProblem(stiffness_of(program), law, anchor, RHO, False, crushable)


def some_motion(program: Program) -> tuple[np.ndarray, np.ndarray]:
    """Forces within the law, and velocities of the blocks that open, slide and hold joints."""
    rng = np.random.default_rng(5)
    anchor = rng.normal(size=(program.n_points, program.components))
    anchor[:, 0] = np.abs(anchor[:, 0]) + 0.5
    return anchor, rng.normal(size=len(program.dead_load)) * 0.2


@pytest.mark.parametrize("program", [line_of(WALL, "parameters.n=4").program, wall_3()], ids=["spatial", "planar"])
@pytest.mark.parametrize("share", [1.0, 1e-2])
def test_joints_near_a_motion_fit_it_and_have_equal_products(program: Program, share: float) -> None:
    anchor, u = some_motion(program)
    step = problem(program, anchor)
    start = start_near(step, 0.3, u, share)
    v, limit = step.stiffness.velocities(u), step.limit(start.normal)
    product = start.normal * start.opening
    assert product == pytest.approx(np.full(program.n_points, product[0]), rel=1e-12)
    assert start.opening == pytest.approx(v[:, 0] + RHO * (start.normal - anchor[:, 0]), abs=1e-9)
    assert start.slip == pytest.approx(v[:, 1:] + RHO * (start.shear - anchor[:, 1:]), abs=1e-9)
    assert limit * start.speed + (start.shear * start.slip).sum(axis=1) == pytest.approx(product, rel=1e-6)
    assert limit[:, None] * start.slip + start.speed[:, None] * start.shear == pytest.approx(0.0, abs=1e-9)
    assert (np.linalg.norm(start.shear, axis=1) < limit).all()
    assert (np.linalg.norm(start.slip, axis=1) < start.speed).all()


def test_close_to_a_motion_it_is_the_return_map() -> None:
    program = line_of(WALL, "parameters.n=4").program
    anchor, u = some_motion(program)
    step = problem(program, anchor)
    start = start_near(step, 0.3, u, 1e-10)
    forces = joint_state(step.stiffness, np.zeros(program.n_points), anchor, RHO, u).forces
    assert np.column_stack([start.normal, start.shear]) == pytest.approx(forces, abs=1e-3)


def test_joints_that_can_crush_start_below_their_strength() -> None:
    program = line_of(WALL, "parameters.n=4", "joints.dry.compressive_strength=60000").program
    anchor, u = some_motion(program)
    step = problem(program, 1e6 * anchor)
    for start in (start_near(step, 0.3, u), fresh_start(step, 0.3)):
        assert (step.room(start.normal) > 0.0).all()
        assert (start.crushing > 0.0).all()


def test_equal_products_are_left_alone_and_outlying_ones_pulled_back() -> None:
    """To the nearer limit, from above by no more than that limit: both eigenvalues of the shear product too."""
    program = line_of(WALL, "parameters.n=4").program
    anchor, u = some_motion(program)
    step = problem(program, anchor)
    start = start_near(step, 0.3, u)
    middle = float(start.normal[0] * start.opening[0])
    alone = outlying(step, start, 0.1 * middle, 10.0 * middle)
    for part in (alone.opening, alone.sliding, alone.turning):
        assert part == pytest.approx(0.0, abs=1e-9 * middle)
    few = outlying(step, start, 2.0 * middle, 20.0 * middle)
    assert few.opening == pytest.approx(middle, rel=1e-9)
    assert few.sliding == pytest.approx(middle, rel=1e-5)
    many = outlying(step, start, 0.01 * middle, 0.1 * middle)
    assert many.opening == pytest.approx(-0.1 * middle, rel=1e-9)
    assert many.sliding == pytest.approx(-0.1 * middle, rel=1e-5)
