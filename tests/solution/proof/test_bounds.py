"""What forces and velocities prove holds whatever they are; repaired, they prove nearly what they said before."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import scipy.sparse as sp
from numpy.typing import NDArray

from mbla.program.program import Program
from mbla.program.reductions import allowed_reductions, reduce_program
from mbla.program.yield_conditions import YieldLimits
from mbla.solution.associative.solve_associative import solve_associative
from mbla.solution.linear_algebra.bordered_system import bordered_solver
from mbla.solution.nonassociative.collapse_state import CollapseState
from mbla.solution.proof.bounds import falling_motion, kinematic_value, proved_bounds
from mbla.solution.proof.kinematic_repair import incompatibility, repaired_mechanisms
from mbla.solution.proof.metrics import force_metric, velocity_hessian
from mbla.solution.proof.static_repair import repaired_forces
from mbla.solution.settings import SolverSettings
from tests.line import BLOCK, WALL, line_of, verified

SPATIAL = "analysis.reductions=false"
LEDGE = BLOCK.replace("supports: [{ground: {z: 0}}]", "supports: [{blocks: ledge}]").replace(
    "blocks:\n", "blocks:\n  - box: {group: ledge, material: stone, min: [-1, 0, -1], max: [0.49, 1, 0]}\n"
)
"""The block with its centroid beyond the edge of what it stands on."""

both_spaces = pytest.mark.parametrize("reductions", [SPATIAL, "analysis.reductions=true"])


def program_of(text: str, *overrides: str) -> Program:
    line = line_of(text, *overrides)
    switches = allowed_reductions(line.deck.analysis)
    return reduce_program(line.model, line.contacts, line.program, switches, associative=True).parts[0]


def state_of(program: Program) -> CollapseState:
    state = solve_associative(program, SolverSettings(1e-9), lambda record: None).state
    assert state is not None
    return state


@both_spaces
@pytest.mark.parametrize("noise", [0.0, 1e-9, 1e-6, 1e-4])
def test_bounds_hold_and_widen_with_the_error_of_the_state(noise: float, reductions: str) -> None:
    program = program_of(WALL, "parameters.n=5", "parameters.mu=0.9", reductions)
    exact = state_of(program)
    rng = np.random.default_rng(3)
    forces = exact.forces * (1 + noise * rng.normal(size=exact.forces.shape))
    velocities = exact.velocities * (1 + noise * rng.normal(size=exact.velocities.shape))
    found = proved_bounds(program, CollapseState(forces, velocities, exact.load_factor * (1 + noise), np.nan))
    assert found.static <= exact.load_factor * (1 + 1e-8)
    assert found.kinematic >= exact.load_factor * (1 - 1e-8)
    assert found.gap <= 1e-7 + 300 * noise
    assert incompatibility(program, found.velocities) <= 1e-15 * np.abs(found.velocities).max()
    unbalanced = program.equilibrium_matrix @ found.forces.ravel() + program.dead_load
    assert np.abs(unbalanced + found.load_factor * program.live_load).max() <= 1e-9


@both_spaces
@pytest.mark.parametrize("factor", [0.0, 5.0])
def test_forces_that_balance_nothing_prove_no_more_than_there_is(factor: float, reductions: str) -> None:
    """Of a wall they may even be mended; whatever comes out is an equilibrium below collapse."""
    program = program_of(WALL, reductions)
    repaired = repaired_forces(program, np.zeros((program.n_points, program.components)), factor)
    assert repaired is None or repaired[1] <= state_of(program).load_factor * (1 + 1e-8)


@both_spaces
def test_what_falls_is_held_by_the_live_load_alone(reductions: str) -> None:
    """A hundredth of its width beyond the edge: it takes a hundredth of its weight, at mid-height, to hold it."""
    program = program_of(LEDGE, reductions)
    for factor in (-0.5, 0.0, 1.0):
        repaired = repaired_forces(program, np.ones((program.n_points, program.components)), factor)
        assert repaired is None or program.scaling.load_factor(repaired[1]) <= -0.01 * (1 - 1e-6)


@both_spaces
def test_no_compatible_motion_proves_less_than_the_load_factor(reductions: str) -> None:
    program = program_of(WALL, "parameters.mu=0.9", reductions)
    exact, rng = state_of(program), np.random.default_rng(4)
    for _ in range(5):
        motion = exact.velocities + 0.1 * np.abs(exact.velocities).max() * rng.normal(size=exact.velocities.shape)
        for u in repaired_mechanisms(program, motion):
            value = kinematic_value(program, u, 1e6)
            assert not value < exact.load_factor * (1 - 1e-9)


def test_a_motion_against_the_live_load_proves_nothing() -> None:
    program = program_of(BLOCK)
    assert np.isnan(kinematic_value(program, -program.live_load, 1.0))


@both_spaces
def test_nothing_proves_that_a_standing_wall_falls(reductions: str) -> None:
    program = program_of(WALL, reductions)
    rng = np.random.default_rng(5)
    for motion in (state_of(program).velocities, program.dead_load, rng.normal(size=program.dead_load.shape)):
        assert falling_motion(program, motion) is None


@both_spaces
def test_a_block_beyond_its_ledge_is_proved_to_fall(reductions: str) -> None:
    program = program_of(LEDGE, reductions)
    result = solve_associative(program, SolverSettings(1e-9), lambda record: None)
    assert result.certificate is not None
    disturbed = result.certificate * (1 + 1e-5 * np.random.default_rng(6).normal(size=result.certificate.shape))
    proved = falling_motion(program, disturbed)
    assert proved is not None
    assert incompatibility(program, proved) <= 1e-13 * np.abs(proved).max()
    assert program.dead_load @ proved > 0


def test_the_size_of_a_falling_motion_is_of_no_account() -> None:
    """Certificates of infeasibility come with any size: one of a stack that falls was 1e160."""
    program = program_of(LEDGE)
    result = solve_associative(program, SolverSettings(1e-9), lambda record: None)
    assert result.certificate is not None
    proved = falling_motion(program, 1e200 * result.certificate)
    assert proved is not None
    assert np.abs(proved).max() == pytest.approx(1.0, rel=1e-6)
    assert falling_motion(program, 0.0 * result.certificate) is None


@pytest.mark.parametrize("size", [1.0, 1e14])
def test_forces_without_shear_prove_no_more_than_there_is_whatever_their_size(size: float) -> None:
    """What a joint allows over a shear of nothing is no number; a joint that locks has forces of 1e13 mean loads."""
    program = line_of(BLOCK).program
    straight = np.zeros((program.n_points, 3))
    straight[:, 0] = size * np.abs(program.dead_load).max() / program.n_points
    gap = proved_bounds(program, CollapseState(straight, np.zeros(len(program.dead_load)), 0.0, np.nan))
    assert 0.0 <= gap.static * program.scaling.live <= 0.25


def test_the_border_of_a_part_without_live_load_says_nothing() -> None:
    """It was divided by its size, zero."""
    normal = sp.csc_array(np.array([[2.0, 1.0], [1.0, 3.0]]))
    for weight in (1.0, np.inf):
        solve = bordered_solver(normal, np.zeros(2), weight)
        assert solve is not None
        answer = solve(np.array([3.0, 4.0]))
        np.testing.assert_allclose(answer, [1.0, 1.0, 0.0], atol=1e-9)


@pytest.mark.parametrize("strength", [1e5, 1e6])
def test_joints_stronger_than_their_loads_by_millions_have_a_static_bound(strength: float) -> None:
    """All points crush at once under a slanting force, and there is but one field of forces.

    At 5e5 and 5e6 times the block's weight they have no digits left at 1e-13 of it.
    """
    line = line_of(
        BLOCK,
        "parameters.h=1",
        "materials.stone.density=2.e-5",
        f"joints.dry={{friction: 0.6, compressive_strength: {strength}}}",
        "load_cases.push.live=[{force: [300, 0, -1000], on: block, at: [0.5, 0.5, 1]}]",
    )
    _, checks, status = verified(line)
    assert status == "solved", checks.failures
    # N (1 + 2 e/b) = f_c A with N = 1000 λ + W and N e = 300 λ h at the base
    weight = 2e-5 * 9.81
    exact = (strength - weight) / 1600
    assert checks.static_bound == pytest.approx(exact, rel=1e-6)
    assert checks.static_bound <= exact * (1 + 1e-9)
    assert checks.kinematic_bound >= exact * (1 - 1e-9)


def test_forces_of_frictionless_joints_far_stronger_than_their_loads_are_repaired() -> None:
    """The cone of such a joint has no end: one was looked for at a tension beyond numbers, with a warning."""
    line = line_of(BLOCK, "parameters.mu=0", "parameters.c=1e+20")
    forces = np.zeros((line.program.n_points, 3))
    forces[:, 0] = -line.program.dead_load.min() / line.program.n_points
    repaired = repaired_forces(line.program, 0.9 * forces, 0.0)
    assert repaired is not None
    assert line.program.scaling.load_factor(repaired[1]) == pytest.approx(0.0, abs=1e-9)


Array = NDArray[np.float64]
both_spaces = pytest.mark.parametrize("components", [2, 3])


def limits_of(friction: float, cohesion: float, tension: float, compression: float) -> YieldLimits:
    return YieldLimits(*(np.array([value]) for value in (friction, 0.0, cohesion, tension, compression)))


def numerical_hessian(f: Callable[[Array], float], x: Array, step: float = 1e-4) -> Array:
    size = len(x)
    moves = step * np.eye(size)
    return np.array(
        [[(f(x + a + b) - f(x + a - b) - f(x - a + b) + f(x - a - b)) / (4 * step**2) for b in moves] for a in moves]
    )


@both_spaces
@pytest.mark.parametrize(
    ("friction", "cohesion", "tension", "compression"), [(0.6, 0.0, 0.0, np.inf), (0.6, 0.5, 0.3, 4.0)]
)
def test_force_metric_is_the_inverse_hessian_of_the_barrier(
    friction: float, cohesion: float, tension: float, compression: float, components: int
) -> None:
    x = np.array([1.3, 0.4, -0.2])[:components]

    def barrier(x: Array) -> float:
        cone = -np.log((cohesion + friction * x[0]) ** 2 - (x[1:] ** 2).sum())
        cut_off = -np.log(x[0] + tension) if cohesion > 0 else 0.0
        crushing = -np.log(compression - x[0]) if np.isfinite(compression) else 0.0
        return float(cone + cut_off + crushing)

    metric = force_metric(limits_of(friction, cohesion, tension, compression), x[None, :]).toarray()
    assert np.linalg.inv(metric) == pytest.approx(numerical_hessian(barrier, x), rel=1e-5, abs=1e-5)


@both_spaces
def test_velocity_hessian_is_that_of_the_barrier(components: int) -> None:
    v = np.array([1.0, 0.5, 0.3])[:components]

    def barrier(v: Array) -> float:
        return float(-np.log(v[0] ** 2 - 0.7**2 * (v[1:] ** 2).sum()))

    hessian = velocity_hessian(np.array([0.7]), v[None, :])[0]
    assert hessian == pytest.approx(numerical_hessian(barrier, v), rel=1e-5, abs=1e-5)


@both_spaces
def test_a_short_step_in_the_metric_stays_inside_the_cone(components: int) -> None:
    rng = np.random.default_rng(2)
    friction = np.full(200, 0.4)
    normal = rng.uniform(0.1, 2.0, 200)
    shear = rng.normal(size=(200, components - 1))
    shear *= (rng.uniform(0, 1 - 1e-6, 200) * friction * normal / np.linalg.norm(shear, axis=1))[:, None]
    x = np.column_stack([normal, shear])
    zeros = np.zeros(200)
    metric = force_metric(YieldLimits(friction, zeros, zeros, zeros, np.full(200, np.inf)), x).toarray()
    direction = rng.normal(size=x.size)
    step = (metric @ direction).reshape(x.shape)
    length = np.sqrt(np.einsum("kj,kj->k", direction.reshape(x.shape), step))
    moved = x + 0.99 * step / length[:, None]
    assert np.all(np.linalg.norm(moved[:, 1:], axis=1) < friction * moved[:, 0])


def test_points_without_shear_strength_keep_their_shear() -> None:
    metric = force_metric(limits_of(0.0, 0.0, 0.0, np.inf), np.array([[2.0, 0.0, 0.0]])).toarray()
    assert metric[0, 0] == pytest.approx(4.0)
    assert not metric[1:].any()


@both_spaces
def test_forces_and_velocities_beyond_their_squares_give_metrics_that_are_told_as_none(components: int) -> None:
    """Nothing is warned of: who asks sees that they are not finite."""
    huge = np.array([[1e200, 3e199, 1e199]])[:, :components]
    assert not np.isfinite(force_metric(limits_of(0.6, 1e200, 0.0, np.inf), huge).data).all()
    assert not np.isfinite(velocity_hessian(np.array([0.7]), huge)).all()
