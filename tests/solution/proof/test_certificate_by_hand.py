"""Certificates of a body or two, by hand."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.program.kinematic import ConeProgram
from mbla.solution.proof.certificate import steepest_fall
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status
from tests.solution.by_hand import own_points

SETTINGS = SolverSettings(tolerance=1e-8)

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

    monkeypatch.setattr("mbla.solution.proof.certificate.cone_solver", solver)
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
