"""The interior-point run on the law: its start on the central path, its centring, and where it ends."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.solution.cone_solvers.cone_solution import ConeSolution
from mbla.solution.linear_algebra.stiffness import Stiffness, stiffness_of
from mbla.solution.nonassociative.joint_equations import (
    JointEquations,
    outlying,
    residuals,
)
from mbla.solution.nonassociative.joint_law import LawProblem
from mbla.solution.nonassociative.law_state import LawState
from mbla.solution.nonassociative.moving_anchor import (
    BALANCED,
    EVEN,
    MovingResult,
    _least_product,
    _Run,
    run_with_moving_anchor,
    start_near,
)
from mbla.solution.standing.standing import gravity_forces
from tests.line import BLOCK, WALL, line_of
from tests.solution.nonassociative.structures import FERRIS_3, SETTINGS, unbalanced
from tests.solution.planar import planar_program

RHO = 0.3
MORTAR = "joints.dry.cohesion=300", "joints.dry.tensile_strength=200", "joints.dry.compressive_strength=60000"


def wall(*overrides: str) -> Program:
    return line_of(WALL, "parameters.n=4", *overrides).program


PROGRAMS = [wall(), wall(*MORTAR), planar_program(line_of(FERRIS_3))]
KINDS = ["dry", "mortar", "planar"]


def problem(program: Program, anchor: FloatArray) -> JointEquations:
    return JointEquations.of(stiffness_of(program), np.zeros(program.n_points), anchor, RHO)


def some_motion(program: Program) -> tuple[FloatArray, FloatArray]:
    """Forces within the law, and velocities of the blocks that open, slide and hold joints."""
    rng = np.random.default_rng(5)
    anchor = rng.normal(size=(program.n_points, program.components))
    anchor[:, 0] = np.abs(anchor[:, 0]) + 0.5
    return anchor, rng.normal(size=len(program.dead_load)) * 0.2


@pytest.mark.parametrize("program", [PROGRAMS[0], PROGRAMS[2]], ids=["spatial", "planar"])
@pytest.mark.parametrize("product", [1e-1, 1e-4])
def test_joints_near_a_motion_are_on_their_central_path(program: Program, product: float) -> None:
    anchor, u = some_motion(program)
    step = problem(program, anchor)
    products = product * np.linspace(0.5, 2.0, program.n_points)
    start = start_near(step, 0.3, u, products)
    v, limit = step.stiffness.velocities(u), step.limit(start.normal)
    assert start.normal * start.opening == pytest.approx(products, rel=1e-12)
    assert start.opening == pytest.approx(v[:, 0] + RHO * (start.normal - anchor[:, 0]), abs=1e-9)
    assert start.slip == pytest.approx(v[:, 1:] + RHO * (start.shear - anchor[:, 1:]), abs=1e-9)
    assert limit * start.speed + (start.shear * start.slip).sum(axis=1) == pytest.approx(products, rel=1e-6)
    assert limit[:, None] * start.slip + start.speed[:, None] * start.shear == pytest.approx(0.0, abs=1e-9)
    assert (np.linalg.norm(start.shear, axis=1) < limit).all()
    assert (np.linalg.norm(start.slip, axis=1) < start.speed).all()


def test_close_to_a_motion_it_is_the_return_map() -> None:
    program = wall()
    anchor, u = some_motion(program)
    step = problem(program, anchor)
    start = start_near(step, 0.3, u, np.full(program.n_points, 1e-10))
    forces = LawProblem(step.stiffness, np.zeros(program.n_points), anchor, RHO).joints(u).forces
    assert step.forces(start) == pytest.approx(forces, abs=1e-3)


def test_joints_that_can_crush_start_below_their_strength() -> None:
    program = wall(*MORTAR)
    anchor, u = some_motion(program)
    step = problem(program, 1e6 * anchor)
    start = start_near(step, 0.3, u, np.ones(program.n_points))
    assert (step.room(start.normal) > 0.0).all()
    assert (start.crushing > 0.0).all()


def test_equal_products_are_left_alone_and_outlying_ones_pulled_back() -> None:
    """To the nearer limit, from above by no more than that limit: both eigenvalues of the shear product too."""
    program = wall()
    anchor, u = some_motion(program)
    step, every = problem(program, anchor), np.ones(program.n_points)
    start = start_near(step, 0.3, u, every)
    alone = outlying(step, start, 0.1 * every, 10.0 * every)
    for part in (alone.opening, alone.sliding, alone.turning):
        assert part == pytest.approx(0.0, abs=1e-6)
    few = outlying(step, start, 2.0 * every, 20.0 * every)
    assert few.opening == pytest.approx(1.0, rel=1e-9)
    assert few.sliding == pytest.approx(1.0, rel=1e-5)
    many = outlying(step, start, 0.01 * every, 0.1 * every)
    assert many.opening == pytest.approx(-0.1, rel=1e-9)
    assert many.sliding == pytest.approx(-0.1, rel=1e-5)


def run_of(program: Program) -> _Run:
    gravity = gravity_forces(program, SETTINGS, lambda record: None)
    assert not isinstance(gravity, ConeSolution)
    return _Run(stiffness_of(program), np.zeros(program.n_points), gravity)


@pytest.mark.parametrize("program", PROGRAMS, ids=KINDS)
def test_a_centred_start_balances(program: Program) -> None:
    run = run_of(program)
    start = run.centred()
    missing = residuals(JointEquations.of(run.stiffness, run.dilatancy, run.gravity, 0.0), start)
    assert np.abs(missing.balance).max() < BALANCED
    mean = missing.total / (2 * program.n_points)
    assert _least_product(missing) > 0.1 * EVEN * mean
    assert run.factorizations <= 15


def ended(program: Program, slope: FloatArray | float = 0.0, most: int = 100, enough: float = 1e-7) -> MovingResult:
    """A run to its end."""
    run, slopes = run_of(program), slope * np.ones(program.n_points)
    law = slopes
    return run_with_moving_anchor(run.stiffness, law, run.gravity, most, enough, lambda *seen: None)


@pytest.mark.parametrize("program", PROGRAMS, ids=KINDS)
@pytest.mark.parametrize("share", [0.0, 0.5, 1.0])
def test_it_ends_within_the_law_before_long(program: Program, share: float) -> None:
    """Of any dilatancy."""
    result = ended(program, share * program.limits.friction)
    assert result.best is not None
    assert result.best.residual <= 1e-7
    assert unbalanced(program, result.best) < 1e-7
    assert result.factorizations < 60


@pytest.mark.parametrize(("height", "expected"), [(0.5, 0.5), (4.0, 0.25)], ids=["slides", "rocks"])
def test_a_block_moves_at_its_closed_form(height: float, expected: float) -> None:
    """To the root of the residual: what misses the law is a power, of second order."""
    program = line_of(BLOCK, f"parameters.h={height}").program
    best = ended(program).best
    assert best is not None
    assert program.scaling.load_factor(best.load_factor) == pytest.approx(expected, rel=1e-6)


def test_units_of_the_live_load_change_nothing() -> None:
    """Nor the number of iterations."""
    one, two = (ended(wall(f"load_cases.push.live=[{{acceleration: [{a}, 0, 0]}}]")) for a in (1, 1000))
    assert one.best is not None
    assert two.best is not None
    assert two.factorizations == one.factorizations
    assert two.best.forces == pytest.approx(one.best.forces, abs=1e-9)


def test_it_tells_how_it_goes_and_ends_where_it_is_told() -> None:
    program, seen = wall(), []

    def watch(count: int, state: LawState, gap: float, length: float) -> None:
        seen.append((count, state.residual, gap))

    run = run_of(program)
    result = run_with_moving_anchor(run.stiffness, run.dilatancy, run.gravity, 9, 0.0, watch)
    assert result.factorizations == 9
    assert [count for count, _, _ in seen] == list(range(seen[0][0], 9))
    assert result.best is not None
    assert result.best.residual == min(residual for _, residual, _ in seen)
    assert seen[-1][2] < seen[0][2]


@pytest.mark.parametrize("solve", [None, lambda rhs: np.full_like(rhs, np.nan)], ids=["singular", "not a number"])
def test_without_a_direction_it_ends_where_it_starts(solve: object, monkeypatch: pytest.MonkeyPatch) -> None:
    run = run_of(wall())
    monkeypatch.setattr(Stiffness, "factorized", lambda *arguments, **named: solve)
    result = run_with_moving_anchor(run.stiffness, run.dilatancy, run.gravity, 100, 1e-7, lambda *seen: None)
    assert result.factorizations <= 2  # of the centring and of the first step
    assert result.best is None or not result.best.residual <= 1e-3
