"""Interior paths: equations and tangent at contacts of every kind, folds, descents, and where a try leaves its path."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.solution.linear_algebra.stiffness import BorderedFactors, Stiffness, stiffness_of
from mbla.solution.nonassociative.interior_path import arc_length, descent, least_change, one_try
from mbla.solution.nonassociative.interior_path.arc_length import Stage, follow
from mbla.solution.nonassociative.interior_path.central_path import (
    CentralPath,
    central_path,
    first_point,
    linear_step,
    missing_at,
    off_path,
    products_wanted,
    state_of,
)
from mbla.solution.nonassociative.interior_path.descent import Metric, descend, inside
from mbla.solution.nonassociative.interior_path.one_try import Start, Try, go, polished
from mbla.solution.nonassociative.joint_equations import Iterate, step_to_boundary
from mbla.solution.nonassociative.joint_law import LawProblem, LawStep, exact_step
from mbla.solution.nonassociative.law_state import LawState
from tests.line import BLOCK, WALL, line_of
from tests.solution.nonassociative.interior_path.structures import dome, mixed_program

BOTH = pytest.mark.parametrize("components", [2, 3])
PULLS = pytest.mark.parametrize("kappa", [0.0, 5.0])


def path_of(
    program: Program, noise: float = 0.2, seed: int = 1, anchor: FloatArray | None = None, kappa: float = 0.0
) -> CentralPath:
    return central_path(stiffness_of(program), noise, seed, anchor, kappa)


def wall() -> CentralPath:
    return path_of(line_of(WALL, "parameters.n=3").program, 0.1, 0)


def mixed(components: int, kappa: float = 0.0) -> CentralPath:
    return path_of(mixed_program(components), anchor=np.full((4, components), 0.3), kappa=kappa)


def stages_of(path: CentralPath, most: int) -> list[Stage]:
    return list(follow(path, first_point(path), most))


def somewhere(path: CentralPath, seed: int) -> Iterate:
    """A point near the first one, inside the law but off the path."""
    point, rng = first_point(path), np.random.default_rng(seed)
    limit = path.joints.limit(point.normal)[:, None]
    return point.plus(
        Iterate(
            u=rng.normal(size=len(point.u)),
            factor=0.1,
            normal=0.1 * rng.normal(size=4),
            opening=0.1 * point.opening,
            shear=0.05 * limit * rng.normal(size=point.slip.shape),
            slip=0.05 * point.speed[:, None] * rng.normal(size=point.slip.shape),
            speed=0.1 * point.speed,
            crushing=-0.1 * point.crushing,
            log_sigma=0.1,
        )
    )


def left_of(path: CentralPath, point: Iterate) -> FloatArray:
    """All residuals of the path; those of sliding over the first speeds, which a joint without friction makes huge."""
    missing = missing_at(path, point)
    wanted = products_wanted(path, point, missing)
    shear = missing.shear / first_point(path).speed[:, None]
    parts = (missing.balance, missing.normal, shear, *vars(wanted).values())
    return np.concatenate([np.ravel(part) for part in parts])


@BOTH
@PULLS
def test_the_first_point_lies_on_the_path_and_inside_the_law(components: int, kappa: float) -> None:
    path = mixed(components, kappa)
    point = first_point(path)
    assert off_path(path, point, missing_at(path, point)) < 1e-12
    assert inside(path.joints, point)


@BOTH
@PULLS
def test_the_tangent_keeps_the_residuals_and_newtons_step_removes_them(components: int, kappa: float) -> None:
    """d residual / d ln σ along the tangent is zero, along Newton's step minus the residual: central differences."""
    path = mixed(components, kappa)
    point, h = somewhere(path, 2), 1e-5
    linear = linear_step(path, point, missing_at(path, point))
    assert linear is not None
    left = left_of(path, point)
    for step, expected in ((linear.tangent, np.zeros_like(left)), (linear.newton, -left)):
        slope = (left_of(path, point.plus(step, h)) - left_of(path, point.plus(step, -h))) / (2 * h)
        assert slope == pytest.approx(expected, abs=1e-6 * float(np.abs(left).max()))
    assert (linear.newton.log_sigma, linear.tangent.log_sigma) == (0.0, 1.0)


def test_a_point_of_small_sigma_fits_the_exact_law_in_proportion() -> None:
    """What the law leaves unexplained is σ at an open contact and σ/2 at a sliding one: all of it goes with σ."""
    path, ratios = path_of(line_of(WALL, "parameters.n=3").program, 0.0, 0), []
    for stage in follow(path, first_point(path), 60):
        sigma = float(np.exp(stage.point.log_sigma))
        ratios.append(state_of(path, stage.point).residual / sigma)
    assert sigma < 1e-8
    assert ratios[-3:] == pytest.approx([ratios[-1]] * 3, rel=1e-2)


def test_other_seeds_are_other_paths_and_the_same_seed_is_the_same() -> None:
    program = mixed_program()
    one, same, other = (path_of(program, 0.1, seed).weights for seed in (1, 1, 2))
    assert np.array_equal(one, same)
    assert not np.array_equal(one, other)
    assert path_of(program, 0.0).weights == pytest.approx(np.ones((4, 2)))


@pytest.mark.parametrize("part", ["normal", "shear", "opening", "crushing", "speed", "slip"])
def test_a_step_to_the_boundary_ends_where_a_cone_or_half_line_does(part: str) -> None:
    """Just before its end a point is inside, just beyond it is not; each quantity moved by itself."""
    path = path_of(mixed_program(), 0.3, 5)
    joints, point, rng = path.joints, first_point(path), np.random.default_rng(7)
    zero = point.times(0.0)
    for _ in range(20):
        change = replace(zero, **{part: rng.normal(size=np.shape(getattr(point, part)))})
        h = step_to_boundary(joints, point, change)
        if np.isfinite(h):
            assert inside(joints, point.plus(change, 0.999 * h))
            assert not inside(joints, point.plus(change, 1.001 * h))
        else:
            assert inside(joints, point.plus(change, 1e6))


@pytest.mark.parametrize("cause", ["singular", "not finite"])
def test_without_an_answer_there_is_no_step(cause: str, monkeypatch: pytest.MonkeyPatch) -> None:
    path = mixed(3)
    point = somewhere(path, 2)
    if cause == "singular":
        monkeypatch.setattr(Stiffness, "factorized", lambda *arguments: None)
    else:
        monkeypatch.setattr(BorderedFactors, "__call__", lambda factors, right: np.full_like(right, np.inf))
    assert linear_step(path, point, missing_at(path, point)) is None


def test_every_point_lies_on_the_path() -> None:
    path = wall()
    stages = stages_of(path, 40)
    assert len(stages) > 8
    for stage in stages:
        assert inside(path.joints, stage.point)
        assert off_path(path, stage.point, missing_at(path, stage.point)) < 1e-2
    assert all(np.diff([stage.point.log_sigma for stage in stages]) < 0.0)
    assert stages[-1].folds == 0


def test_a_shorter_step_follows_the_same_path(monkeypatch: pytest.MonkeyPatch) -> None:
    """Load factor over ln σ, interpolated: a step that jumped to another stretch would leave the curve."""
    path = wall()
    long = stages_of(path, 45)
    monkeypatch.setattr(arc_length, "SHARE_OF_ROOM", 0.3)
    short = stages_of(path, 200)
    assert len(short) > 2 * len(long)
    curve = np.array([(stage.point.log_sigma, stage.point.factor) for stage in short])[::-1]
    for stage in long[2:]:
        if stage.point.log_sigma > curve[0, 0]:
            expected = float(np.interp(stage.point.log_sigma, curve[:, 0], curve[:, 1]))
            assert stage.point.factor == pytest.approx(expected, abs=5e-3)


def test_folds_are_passed() -> None:
    """A dome of 24 voussoirs: σ rises between turning points, and the path goes on below the lowest of them."""
    stages = stages_of(path_of(line_of(dome(3, 8, 60.0)).program, 0.1, 1), 200)
    sigma = np.array([stage.point.log_sigma for stage in stages])
    rising = np.flatnonzero(np.diff(sigma) > 0.0)
    assert stages[-1].folds >= 2
    assert len(rising)
    assert sigma[-1] < sigma[rising[0]] - 1.0


def without(monkeypatch: pytest.MonkeyPatch, *numbers: int) -> None:
    """Linear systems that are singular, by their numbers from 1."""
    count = itertools.count(1)
    monkeypatch.setattr(
        arc_length, "linear_step", lambda *arguments: None if next(count) in numbers else linear_step(*arguments)
    )


def test_a_path_whose_first_point_has_no_tangent_is_not_begun(monkeypatch: pytest.MonkeyPatch) -> None:
    without(monkeypatch, 1)
    assert stages_of(wall(), 40) == []


def test_a_step_into_a_singular_matrix_is_made_shorter(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = stages_of(wall(), 10)
    without(monkeypatch, 2)
    assert stages_of(wall(), 10)[0].step == pytest.approx(arc_length.SHRINK * whole[0].step, rel=1e-12)


def test_a_path_on_which_no_step_is_accepted_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is as close as that without a correction."""
    monkeypatch.setattr(arc_length, "CLOSE", 0.0)
    monkeypatch.setattr(arc_length, "MOST_CORRECTIONS", 0)
    assert stages_of(wall(), 300) == []


@pytest.mark.parametrize("cause", ["singular", "no room"])
def test_a_point_that_cannot_be_brought_nearer_stays(cause: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its tangent is found anew where there is one: the direction at a point of the path is that already."""
    path = wall()
    stage = stages_of(path, 10)[-1]
    follower = arc_length._Follower(path, sense=1.0)
    if cause == "singular":
        without(monkeypatch, 1)
    else:
        monkeypatch.setattr(arc_length, "ON_PATH", 0.0)
        monkeypatch.setattr(arc_length, "step_to_boundary", lambda *arguments: 0.0)
    point, direction = arc_length._refreshed(follower, stage.point, stage.direction)
    assert point is stage.point
    assert (direction is stage.direction) is (cause == "singular")
    assert follower.factorizations == 1
    assert abs(direction.log_sigma / stage.direction.log_sigma) == pytest.approx(1.0, rel=1e-2)


def test_a_tangent_within_the_plane_of_corrections_gives_none() -> None:
    path = wall()
    point = first_point(path)
    linear = linear_step(path, point, missing_at(path, point))
    assert linear is not None
    metric = Metric(path.joints, point)
    across = np.zeros_like(metric.coordinates(linear.tangent))
    correction, size = arc_length._correction(linear, metric, across)
    assert correction is linear.newton
    assert size == np.inf


@BOTH
def test_the_change_keeps_the_constraints_and_no_other_costs_less(components: int) -> None:
    """Equilibrium, compatibility and power hold after the step; against random changes in their null space."""
    path = mixed(components)
    joints, program, point = path.joints, path.program, somewhere(path, 4)
    missing, sigma = missing_at(path, point), float(np.exp(point.log_sigma))
    change = least_change.least_change(joints, point, missing, 0.5 * sigma, 0.1)
    assert change is not None
    matrix, live = program.equilibrium_matrix.toarray(), program.live_load
    forces = np.column_stack([change.normal, change.shear])
    closing = np.zeros(4)
    closing[joints.crushable] = change.crushing
    slacks = np.column_stack([change.opening - closing, change.slip])
    assert matrix @ forces.ravel() + change.factor * live == pytest.approx(-missing.balance[:-1], abs=1e-10)
    assert live @ change.u == pytest.approx(-missing.balance[-1], abs=1e-10)
    known = np.column_stack([missing.normal, missing.shear])
    assert slacks == pytest.approx(joints.stiffness.velocities(change.u) + known, abs=1e-9)
    hessian, gradient = least_change._local_cost(joints, point, missing, 0.5 * sigma, 0.1)

    def cost_of(*parts: FloatArray) -> float:
        z = np.column_stack(parts)
        return float(0.5 * np.einsum("ki,kij,kj", z, hessian, z) + (gradient * z).sum())

    constraints = np.column_stack([matrix, live])
    free = np.linalg.svd(constraints)[2][np.linalg.matrix_rank(constraints) :, :-1]
    still = np.linalg.svd(live[None, :])[2][1:]
    here = (forces, slacks, change.speed, closing)
    rng, least = np.random.default_rng(1), cost_of(*here)
    for _ in range(30):
        other = (
            (rng.normal(size=len(free)) @ free).reshape(forces.shape),
            joints.stiffness.velocities(rng.normal(size=len(still)) @ still),
            change.speed * rng.normal(size=4),
            closing * rng.normal(size=4),
        )
        for size in (1e-3, -1e-3, 1.0):
            assert cost_of(*(a + size * b for a, b in zip(here, other, strict=True))) >= least - 1e-9 * abs(least)


@BOTH
def test_products_of_every_kind_come_down_together(components: int) -> None:
    """The block with four different corners: all products small in the end, the state one of the exact law."""
    path = path_of(mixed_program(components), 0.1, 2)
    points = list(descend(path, first_point(path), 120))
    best = min(points, key=lambda point: state_of(path, point).residual)
    assert state_of(path, best).residual < 1e-7
    assert descent._largest(missing_at(path, best)) < 1e-6


def test_a_wall_comes_down_to_the_law_from_far_away() -> None:
    path = wall()
    residual = [state_of(path, point).residual for point in descend(path, first_point(path), 150)]
    assert residual[0] > 0.1
    assert min(residual) < 1e-7


@pytest.mark.parametrize("cause", ["not finite", "singular"])
def test_a_descent_ends_where_its_system_breaks_down(cause: str, monkeypatch: pytest.MonkeyPatch) -> None:
    path = path_of(mixed_program(), 0.1, 2)
    if cause == "singular":
        monkeypatch.setattr(least_change, "factorize", lambda *arguments, **named: None)
    else:
        made = least_change._local_cost
        monkeypatch.setattr(least_change, "_local_cost", lambda *a: tuple(np.inf * part for part in made(*a)))
    with np.errstate(invalid="ignore", over="ignore"):
        assert list(descend(path, first_point(path), 10)) == []


@pytest.mark.parametrize("outside", [1, 3])
def test_a_step_that_ends_outside_is_halved(outside: int, monkeypatch: pytest.MonkeyPatch) -> None:
    path = path_of(mixed_program(), 0.1, 2)
    first = first_point(path)
    whole = next(descend(path, first, 1))
    answers = iter([False] * outside)
    monkeypatch.setattr(descent, "inside", lambda *arguments: next(answers, True))
    shorter = next(descend(path, first, 1))
    assert (shorter.factor - first.factor) / (whole.factor - first.factor) == pytest.approx(0.5**outside, rel=1e-9)


def test_a_descent_ends_where_every_step_leads_outside(monkeypatch: pytest.MonkeyPatch) -> None:
    path = path_of(mixed_program(), 0.1, 2)
    monkeypatch.setattr(descent, "inside", lambda *arguments: False)
    assert list(descend(path, first_point(path), 10)) == []


# --- Where a try leaves its path ------------------------------------------------------------------------------------

BEGIN = Start(0.0, 0.1, 0)


class Made:
    """A path and a descent whose points carry their residual as σ; takes note of where descents begin."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.stiffness = stiffness_of(line_of(BLOCK).program)
        self.first = first_point(central_path(self.stiffness, 0.1, 0, None, 0.0))
        self.stages: Iterator[Stage] = iter(())
        self.below: list[Iterate] = []
        self.descents: list[float] = []
        monkeypatch.setattr(one_try, "follow", lambda *arguments: self.stages)
        monkeypatch.setattr(one_try, "descend", self.descend)
        monkeypatch.setattr(one_try, "state_of", self.state)
        monkeypatch.setattr(one_try, "polished", lambda stiffness, state, sizes: (state, 0))

    def point(self, residual: float) -> Iterate:
        return replace(self.first, log_sigma=float(np.log(residual)))

    def path(self, *residuals: float, folds: int = 0, each: int = 1) -> None:
        """Points of the path, some factorisations each; the last ones turn."""
        self.stages = iter(
            [
                Stage(self.point(value), self.first, each * (i + 1), max(0, i + 1 + folds - len(residuals)), 0.1)
                for i, value in enumerate(residuals)
            ]
        )

    def state(self, path: CentralPath, point: Iterate) -> LawState:
        return LawState(path.joints.forces(point), point.u, 0.0, float(np.exp(point.log_sigma)))

    def descend(self, path: object, first: Iterate, most: int) -> Iterator[Iterate]:
        self.descents.append(float(np.exp(first.log_sigma)))
        return iter(self.below)

    def tried(self, begin: Start = BEGIN) -> Try:
        attempt = Try(self.stiffness, 10_000, lambda moment: None, lambda: False)
        go(attempt, begin, None)
        return attempt


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> Made:
    return Made(monkeypatch)


def test_a_path_without_points_leaves_nothing(made: Made) -> None:
    attempt = made.tried()
    assert (attempt.best, attempt.factorizations) == (None, 0)
    assert not made.descents


def test_from_a_path_that_ends_a_descent_begins_at_its_lowest_point(made: Made) -> None:
    made.path(1e-1, 4e-3, 6e-3)
    made.below = [made.point(2e-3), made.point(1e-3)]
    attempt = made.tried()
    assert made.descents == pytest.approx([4e-3])
    assert attempt.best is not None
    assert attempt.best.residual == pytest.approx(1e-3)
    assert attempt.factorizations == 3 + 2


def test_a_start_that_does_not_descend_ends_with_its_path(made: Made) -> None:
    made.path(1e-1, 4e-3, 6e-3, folds=2)
    attempt = made.tried(replace(BEGIN, descends=False))
    assert not made.descents
    assert attempt.best is not None
    assert attempt.best.residual == pytest.approx(4e-3)


def test_a_path_that_comes_no_lower_is_left(made: Made) -> None:
    """Near the law for long, in factorisations: the points after that are not looked at."""
    low = 0.5 * one_try.NEAR
    made.path(low, 2 * low, 2 * low, 2 * low, each=one_try.PATIENCE)
    attempt = made.tried()
    assert len(list(made.stages)) == 1
    assert made.descents == pytest.approx([low])
    assert attempt.factorizations == 3 * one_try.PATIENCE


def test_exact_steps_are_ended_by_their_number(monkeypatch: pytest.MonkeyPatch) -> None:
    """One step for each size, and the best of them is kept."""
    path = wall()
    points = descend(path, first_point(path), 100)
    state = min((state_of(path, point) for point in points), key=lambda found: found.residual)
    monkeypatch.setattr(one_try, "MOST_STEPS", 1)
    monkeypatch.setattr(one_try, "POLISHED_RESIDUAL", 0.0)
    steps: list[float] = []

    def step(law: LawProblem, *arguments: Any) -> LawStep:
        steps.append(law.rho)
        return exact_step(law, *arguments)

    monkeypatch.setattr(one_try, "exact_step", step)
    best, count = polished(path.joints.stiffness, state, one_try.STEPS)
    size = float((state.forces**2).sum())
    assert [rho * size for rho in steps] == pytest.approx(one_try.STEPS)
    assert best.residual < state.residual
    assert count >= len(steps)
