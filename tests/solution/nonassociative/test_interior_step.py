"""The interior-point step: against Newton's method, against a cone program, and where there is no solution."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.program.program import Program
from mbla.program.static import gravity_form
from mbla.solution.cone_solvers.clarabel_adapter import ClarabelProgram
from mbla.solution.linear_algebra.stiffness import Stiffness, stiffness_of
from mbla.solution.nonassociative.interior_step import fresh_start, interior_step, start_near
from mbla.solution.nonassociative.joint_equations import (
    Iterate,
    JointEquations,
    Joints,
    exact_law,
    lagged_law,
    outlying,
)
from mbla.solution.nonassociative.joint_law import LawProblem, exact_step
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import IterationRecord
from tests.line import BLOCK, WALL, line_of
from tests.program.associative_static import associative_static_form
from tests.solution.nonassociative.test_dilatancy import wall_3

SETTINGS = SolverSettings(1e-10)
MORTAR = "joints.dry.cohesion=300", "joints.dry.tensile_strength=200", "joints.dry.compressive_strength=60000"


def silent(record: IterationRecord) -> None:
    pass


def wall(*overrides: str) -> Program:
    return line_of(WALL, "parameters.n=4", *overrides).program


def gravity(program: Program) -> np.ndarray:
    form = gravity_form(program)
    return form.forces(ClarabelProgram(form.cone_program, SETTINGS, silent).solve(1, 0.0).x)


@pytest.mark.parametrize("program", [wall(), wall(*MORTAR), wall_3()], ids=["dry", "mortar", "planar"])
def test_the_convex_step_is_that_of_the_cone_program(program: Program) -> None:
    """max load factor - rho/2 |x - anchor|^2 within fixed shear limits, by another method and another formulation."""
    anchor = gravity(program)
    rho = 0.03 / float((anchor**2).sum())
    law = lagged_law(program, np.zeros(program.n_points), anchor)
    ours = interior_step(stiffness_of(program), law, anchor, rho, 0.0, silent, 1)
    assert ours.converged
    lagged = replace(program.limits, friction=np.zeros(program.n_points), cohesion=np.maximum(law.offset, 1e-12))
    form = associative_static_form(replace(program, limits=lagged))
    cost, quadratic = np.append(-rho * anchor.ravel(), -1.0), np.append(np.full(anchor.size, rho), 0.0)
    solver = ClarabelProgram(replace(form.cone_program, cost=cost, quadratic=quadratic), SETTINGS, silent)
    theirs = solver.solve(1, 1.0)
    assert ours.load_factor == pytest.approx(theirs.x[-1], rel=1e-6)
    assert ours.forces == pytest.approx(form.contact_forces(theirs.x), abs=1e-3 * np.abs(anchor).max())


@pytest.mark.parametrize("program", [wall(), wall(*MORTAR), wall_3()], ids=["dry", "mortar", "planar"])
@pytest.mark.parametrize("share", [0.0, 0.5, 1.0])
def test_it_ends_where_the_law_holds(program: Program, share: float) -> None:
    """Newton's method on the return map has next to nothing left to do.

    Forces are held by rho alone: 1e-9 of the power is the root of 1e-9 over 0.03 of them.
    """
    anchor, stiffness = gravity(program), stiffness_of(program)
    rho, slope = 0.03 / float((anchor**2).sum()), share * program.limits.friction
    result = interior_step(stiffness, exact_law(program, slope), anchor, rho, 0.0, silent, 1)
    assert result.converged
    polished = exact_step(LawProblem(stiffness, slope, anchor, rho), result.velocities, result.load_factor, 10)
    assert polished.residual < 1e-9
    assert polished.factorizations <= 4
    assert polished.load_factor == pytest.approx(result.load_factor, rel=1e-6)
    assert polished.forces == pytest.approx(result.forces, abs=1e-3 * np.abs(anchor).max())


def test_units_change_nothing() -> None:
    """Forces in another unit: anchor and limits times k, loads too, rho over k, and the same iterations."""
    program = wall(*MORTAR)
    anchor = gravity(program)
    rho = 0.03 / float((anchor**2).sum())
    k = 1e4
    scaled = replace(
        program, dead_load=k * program.dead_load, live_load=k * program.live_load, limits=program.limits.scaled(k)
    )
    no_slope = np.zeros(program.n_points)
    here = interior_step(stiffness_of(program), exact_law(program, no_slope), anchor, rho, 0.0, silent, 1)
    there = interior_step(stiffness_of(scaled), exact_law(scaled, no_slope), k * anchor, rho / k**2, 0.0, silent, 1)
    assert there.load_factor == pytest.approx(here.load_factor, rel=1e-6)
    assert there.forces / k == pytest.approx(here.forces, abs=1e-5 * np.abs(anchor).max())


def test_every_iteration_is_logged() -> None:
    program = wall()
    records: list[IterationRecord] = []
    anchor = gravity(program)
    result = interior_step(
        stiffness_of(program),
        exact_law(program, np.zeros(program.n_points)),
        anchor,
        0.03 / float((anchor**2).sum()),
        0.0,
        records.append,
        7,
    )
    assert [record.iteration for record in records] == list(range(result.iterations + 1))
    assert {record.program for record in records} == {7}
    assert records[-1].load_factor == pytest.approx(program.scaling.load_factor(result.load_factor), rel=1e-9)


@pytest.mark.parametrize("cause", ["singular", "not finite"])
def test_a_step_without_a_system_ends_where_it_begins(cause: str, monkeypatch: pytest.MonkeyPatch) -> None:
    program = line_of(BLOCK).program
    law, anchor = exact_law(program, np.zeros(program.n_points)), gravity(program)
    if cause == "singular":
        monkeypatch.setattr(Stiffness, "factorized", lambda *arguments, **named: None)
    else:
        made = Joints.of

        def broken(step: JointEquations, now: Iterate) -> Joints:
            joints = made(step, now)
            return replace(joints, tangents=np.full_like(joints.tangents, np.nan))

        monkeypatch.setattr(Joints, "of", broken)
    result = interior_step(stiffness_of(program), law, anchor, 1e-2, 0.1, silent, 1)
    assert not result.converged
    assert result.iterations == 0
    assert result.load_factor == 0.1


# --- Starts: every joint on its law, rounded off, and inside its bounds ---------------------------------------------

RHO = 0.3


def problem(program: Program, anchor: np.ndarray) -> JointEquations:
    return JointEquations.of(stiffness_of(program), exact_law(program, np.zeros(program.n_points)), anchor, RHO)


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
    forces = LawProblem(step.stiffness, np.zeros(program.n_points), anchor, RHO).joints(u).forces
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
