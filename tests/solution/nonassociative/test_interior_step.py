"""The interior-point step: against Newton's method, against a cone program, and where there is no solution."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.program.program import Program
from mbla.program.static import gravity_form
from mbla.solution.cone_solvers.clarabel_adapter import ClarabelProgram
from mbla.solution.linear_algebra.stiffness import Stiffness, stiffness_of
from mbla.solution.nonassociative.interior_joints import Iterate, Joints, StepProblem, exact_law, lagged_law
from mbla.solution.nonassociative.interior_step import interior_step
from mbla.solution.nonassociative.joint_law import exact_step
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
    polished = exact_step(stiffness, slope, anchor, rho, result.velocities, result.load_factor, 10)
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


def test_at_a_load_that_cannot_be_carried_it_does_not_converge() -> None:
    program = line_of(BLOCK, "parameters.h=0.5").program
    stiffness, law = stiffness_of(program), exact_law(program, np.zeros(program.n_points))
    anchor, limit = gravity(program), 0.5 / program.scaling.live
    below = interior_step(stiffness, law, anchor, 1.0, 0.999 * limit, silent, 1, fixed_load=True)
    above = interior_step(stiffness, law, anchor, 1.0, 1.001 * limit, silent, 1, fixed_load=True)
    assert below.converged
    assert below.load_factor == 0.999 * limit
    assert not above.converged


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

        def broken(step: StepProblem, now: Iterate) -> Joints:
            joints = made(step, now)
            return replace(joints, tangents=np.full_like(joints.tangents, np.nan))

        monkeypatch.setattr(Joints, "of", broken)
    result = interior_step(stiffness_of(program), law, anchor, 1e-2, 0.1, silent, 1)
    assert not result.converged
    assert result.iterations == 0
    assert result.load_factor == 0.1
