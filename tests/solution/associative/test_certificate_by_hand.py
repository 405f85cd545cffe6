"""Certificates of a body or two, by hand."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.program.kinematic import ConeProgram
from mbla.solution.associative.certificate import cleaned_certificate, failing_parts, steepest_fall
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status
from tests.solution.by_hand import limits_of, own_points

SETTINGS = SolverSettings(tolerance=1e-8)

# Two bodies on a point of their own each, without friction: the second gains 1, the first what it is given.

MOTION = np.array([1.0, 0.0, 0.5, 1.0])


def kept_of(motion: FloatArray = MOTION, gain: float = 2.0, **first: float) -> FloatArray:
    limits = {name: [value, np.inf if name == "compression" else 0.0] for name, value in first.items()}
    program = own_points([gain, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0], **limits)
    return failing_parts(program, motion)


def second_alone(motion: FloatArray = MOTION) -> FloatArray:
    return np.concatenate([np.zeros(2), motion[2:]])


@pytest.mark.parametrize(("tension", "falls"), [(1.9, True), (2.1, False), (2.0, False), (2.9, False)])
def test_tension_is_taken_from_what_a_part_gains(tension: float, falls: bool) -> None:
    assert kept_of(tension=tension).tolist() == (MOTION if falls else second_alone()).tolist()


@pytest.mark.parametrize(("cohesion", "falls"), [(0.9, True), (1.1, False)])
def test_cohesion_is_taken_as_well(cohesion: float, falls: bool) -> None:
    motion = np.array([1.0, -2.0, 0.5, 1.0])
    kept = kept_of(motion, cohesion=cohesion)
    assert kept.tolist() == (motion if falls else second_alone(motion)).tolist()


@pytest.mark.parametrize(("compression", "falls"), [(1.9, True), (2.1, False)])
def test_crushing_is_taken_as_well(compression: float, falls: bool) -> None:
    motion = np.array([-1.0, 0.0, 0.5, 1.0])
    kept = kept_of(motion, gain=-2.0, compression=compression)
    assert kept.tolist() == (motion if falls else second_alone(motion)).tolist()


def test_joints_that_open_are_not_crushed() -> None:
    assert kept_of(compression=1e9).tolist() == MOTION.tolist()


def test_a_part_without_gain_is_put_at_rest() -> None:
    assert kept_of(gain=0.0).tolist() == second_alone().tolist()
    assert kept_of(gain=-0.5).tolist() == second_alone().tolist()


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize(("closing", "proves"), [(0.4e-4, True), (0.6e-4, False)])
def test_what_closes_joints_is_given_back_as_it_is(closing: float, proves: bool, turned: bool) -> None:
    """Ten thousand times the dead load, of 2 in all, is charged: a gain of 1 may close 5e-5."""
    motion = np.array([1.0, 0.0, -closing, 1.0])
    kept = kept_of(motion, gain=-1.0 if not turned else 1.0, tension=0.0 if not turned else 1.5)
    assert kept.tolist() == (second_alone(motion) if proves else motion).tolist()


def test_friction_asks_for_opening() -> None:
    """μ s = 1 is more than the opening of 1/2: too little to be called a fall."""
    program = own_points([0.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0], friction=1.0)
    assert failing_parts(program, MOTION).tolist() == MOTION.tolist()
    program = own_points([0.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0], friction=0.5)
    assert failing_parts(program, MOTION).tolist() == second_alone().tolist()


def test_bodies_that_touch_are_one_part() -> None:
    """Three on a line with a joint between neighbours: the first lifts what the second loses, the third stands."""
    joints = np.zeros((6, 4))
    joints[[0, 2], [0, 0]] = [1.0, -1.0]
    joints[[2, 4], [2, 2]] = [1.0, -1.0]
    program = replace(
        own_points([2.0, 0.0, -1.0, 0.0, -1.0, 0.0], [0.0, 1.0] * 3),
        equilibrium_matrix=sp.csr_array(joints),
        limits=limits_of(2),
    )
    motion = np.array([1.0, 0.0, 0.5, 0.0, 0.0, 0.0])
    assert failing_parts(program, motion).tolist() == motion.tolist()


def test_neighbours_that_do_not_touch_are_parts_of_their_own() -> None:
    program = own_points([0.0, 0.0, -0.5, 0.0, 2.0, 0.0], [0.0, 1.0] * 3)
    motion = np.array([0.0, 0.0, 1.0, 1.0, 1.0, 1.0])
    assert failing_parts(program, motion).tolist() == [0.0, 0.0, 0.0, 0.0, 1.0, 1.0]


def test_where_no_part_gains_the_motion_is_given_back() -> None:
    motion = np.array([1.0, 0.5])
    assert failing_parts(own_points([-1.0, 0.0], [0.0, 1.0]), motion).tolist() == motion.tolist()


@pytest.mark.parametrize("fall", [None, np.array([0.0, 0.0, 0.0, 1.0])])
def test_a_cleaned_certificate(fall: FloatArray | None, monkeypatch: pytest.MonkeyPatch) -> None:
    """The steepest fall, or the given motion without the part that gains nothing."""
    monkeypatch.setattr("mbla.solution.associative.certificate.steepest_fall", lambda *_: fall)
    program = own_points([-0.5, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0])
    cleaned = cleaned_certificate(program, MOTION, SETTINGS, lambda record: None)
    assert cleaned.tolist() == (second_alone() if fall is None else fall).tolist()


# Two bodies, weights 1 and 3, without friction, the first with strength; the cone solver answers what the test says.

PROGRAM = own_points(
    [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [0.0, 1.0, 0.0, 0.0, 0.0, 0.0] * 2,
    3,
    cohesion=[0.5, 0.0, 0.0, 0.0],
    tension=[0.25, 0.0, 0.0, 0.0],
)


def fall_of(
    monkeypatch: pytest.MonkeyPatch, first: list[float], status: Status = Status.SOLVED, second: float = 0.0
) -> FloatArray | None:
    """The steepest fall, where the solver answers these velocities of the first body and that of the second."""
    asked: list[tuple[Any, ...]] = []

    def solve(*arguments: Any) -> SimpleNamespace:
        asked.append(arguments)
        x = np.array([*first, *[0.0] * (6 - len(first)), second, *[0.0] * 5, 7.0, 7.0])
        return SimpleNamespace(status=status, x=x)

    def solver(program: ConeProgram, settings: SolverSettings, _: object) -> SimpleNamespace:
        assert settings.tolerance == 1e-12
        assert program.n_equations == 0
        assert program.quadratic is not None
        multipliers = len(program.cost) - 12
        assert program.quadratic.tolist() == [0.5] * 6 + [1.5] * 6 + [0.0] * multipliers
        assert program.matrix.shape == (len(program.rhs), 12 + multipliers)
        assert len(program.rhs) == program.n_half_lines + 3 * program.n_cones
        assert program.cost[:12].tolist() == (-PROGRAM.dead_load + 0.25 * np.eye(12)[0]).tolist()
        return SimpleNamespace(solve=solve)

    monkeypatch.setattr("mbla.solution.associative.certificate.interior_point_solver", solver)
    found = steepest_fall(PROGRAM, SETTINGS, lambda record: None)
    assert asked == [(1, 0.0)]  # the first program, without a load factor to be told
    return found


@pytest.mark.parametrize("status", Status)
def test_only_what_is_solved_proves_a_fall(status: Status, monkeypatch: pytest.MonkeyPatch) -> None:
    found = fall_of(monkeypatch, [0.5], status)
    assert (found is not None) == (status in (Status.SOLVED, Status.APPROXIMATE))


@pytest.mark.parametrize(("size", "falls"), [(0.9e-7, False), (1e-7, False), (1.1e-7, True), (3.0, True)])
def test_a_share_of_rounding_is_carried(size: float, falls: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    found = fall_of(monkeypatch, [size])
    assert (None if found is None else found.tolist()) == ([1.0, *[0.0] * 11] if falls else None)


@pytest.mark.parametrize(("creep", "kept"), [(0.9e-7, False), (1e-7, False), (1.1e-7, True)])
def test_what_creeps_is_at_rest(creep: float, kept: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    found = fall_of(monkeypatch, [1.0, 0.0, 0.0, 0.0, 0.0, -creep])
    assert found is not None
    assert found.tolist() == [1.0, 0.0, 0.0, 0.0, 0.0, -creep if kept else 0.0, *[0.0] * 6]


def test_a_motion_against_the_load_is_no_fall(monkeypatch: pytest.MonkeyPatch) -> None:
    assert fall_of(monkeypatch, [-1.0]) is None


@pytest.mark.parametrize(("slip", "falls"), [(1.45, True), (1.55, False)])
def test_strength_may_take_all_of_a_fall(slip: float, falls: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """Opening by 1 the load gains 1 less 1/4 of tension, and sliding takes 1/2 for each unit."""
    found = fall_of(monkeypatch, [1.0, 0.6 * slip, 0.8 * slip])
    assert (found is not None) == falls


@pytest.mark.parametrize(("closing", "falls"), [(2.9 / 4e4, True), (3.1 / 4e4, False)])
def test_closing_is_charged_with_ten_thousand_times_the_load(
    closing: float, falls: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The second body gains 3 of the load of 4."""
    assert (fall_of(monkeypatch, [-closing], second=1.0) is not None) == falls


def test_nothing_falls_without_a_load() -> None:
    assert steepest_fall(own_points([0.0, 0.0], [0.0, 1.0]), SETTINGS, lambda record: None) is None
