"""Bounds of one contact point, by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from mbla.program.program import Program
from mbla.solution.nonassociative.collapse_state import CollapseState
from mbla.solution.proof.bounds import (
    ProvedBounds,
    dissipation,
    factor_size,
    falling_motion,
    kinematic_value,
    proved_bounds,
)
from tests.solution.by_hand import own_points

# One contact point, friction 1/2: velocities of the rows are those of the point.


@pytest.mark.parametrize(
    ("opening", "strengths", "power"),
    [
        (2.0, {}, 0.0),
        (2.0, {"cohesion": 3.0}, 6.0),
        (2.0, {"tension": 5.0}, 5.0),
        (2.0, {"cohesion": 3.0, "tension": 5.0}, 11.0),
        (0.0, {"cohesion": 3.0, "tension": 5.0}, 6.0 + 10.0),  # the lack of 1 is charged
        (0.0, {"cohesion": 3.0, "compression": 7.0}, 6.0 + 7.0),
        (2.0, {"compression": 7.0}, 0.0),
        (-1.0, {"compression": 7.0}, 14.0),
    ],
)
@pytest.mark.parametrize("components", [2, 3])
def test_what_joints_dissipate(opening: float, strengths: dict[str, float], power: float, components: int) -> None:
    velocities = [opening, 2.0] if components == 2 else [opening, 1.2, -1.6]
    program = own_points([0.0] * components, [1.0] * components, components, friction=0.5, **strengths)
    assert dissipation(program, np.array(velocities), 10.0) == pytest.approx(power, abs=1e-14)


def test_points_add_up() -> None:
    program = own_points([0.0] * 4, [1.0] * 4, friction=0.5, cohesion=[1.0, 3.0], tension=[2.0, 4.0])
    assert dissipation(program, np.array([2.0, 2.0, 5.0, -4.0]), 10.0) == 2.0 + 2.0 + 12.0 + 12.0


def test_the_value_of_a_motion() -> None:
    """(c s − f_D·u) / f_L·u."""
    program = own_points([-3.0, 0.0], [0.0, 4.0], friction=0.5, cohesion=2.0)
    assert kinematic_value(program, np.array([1.0, 2.0]), 10.0) == (4.0 + 3.0) / 8.0
    assert kinematic_value(program, np.array([0.0, 2.0]), 10.0) == (4.0 + 10.0) / 8.0
    assert np.isnan(kinematic_value(program, np.array([1.0, 0.0]), 10.0))
    assert np.isnan(kinematic_value(program, np.array([1.0, -2.0]), 10.0))


@pytest.mark.parametrize(
    ("dead", "strengths", "size"),
    [
        ([3.0, 4.0], {"cohesion": 7.0}, 2.5),
        ([0.0, 0.0], {"cohesion": 7.0, "tension": 3.0}, 5.0),
        ([0.0, 0.0], {"tension": 3.0}, 1.5),
        ([0.0, 0.0], {}, 0.5),
    ],
)
def test_the_size_of_load_factors(dead: list[float], strengths: dict[str, float], size: float) -> None:
    assert factor_size(own_points(dead, [0.0, 2.0], **strengths)) == size


@pytest.fixture
def mended(monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    """What the repair makes of forces and of velocities: set by the test."""
    of: dict[str, Any] = {"forces": None, "motions": None}
    monkeypatch.setattr("mbla.solution.proof.bounds.repaired_forces", lambda *_: of["forces"])
    monkeypatch.setattr(
        "mbla.solution.proof.bounds.repaired_mechanisms",
        lambda _, u: [u] if of["motions"] is None else of["motions"],
    )
    return of


# One point that slides at unit speed under a live load of 1, and what it would have to open for it.

GIVEN = np.array([[4.0, -2.0]])


def gap_of(program: Program, load_factor: float = 3.0) -> ProvedBounds:
    return proved_bounds(program, CollapseState(GIVEN, np.array([0.0, 1.0]), load_factor, np.nan))


def test_forces_that_were_mended(mended: dict[str, Any]) -> None:
    better = np.array([[5.0, -1.0]])
    mended["forces"] = (better, 0.25)
    found = gap_of(own_points([-1.0, 0.0], [0.0, 1.0], cohesion=0.5))
    assert (found.static, found.kinematic, found.gap, found.load_factor) == (0.25, 0.5, 0.5, 0.25)
    assert found.forces is better
    assert found.velocities.tolist() == [0.0, 1.0]


def test_forces_that_cannot_be_mended(mended: dict[str, Any]) -> None:
    mended["forces"] = None
    found = gap_of(own_points([-1.0, 0.0], [0.0, 1.0], cohesion=0.5))
    assert np.isnan(found.static)
    assert np.isnan(found.gap)
    assert found.load_factor == 3.0
    assert found.forces is GIVEN


@pytest.mark.parametrize(("repaired", "static"), [(None, 0.0), (-0.5, 0.0), (0.0, 0.0), (0.25, 0.25)], ids=str)
def test_no_forces_balance_no_dead_load(repaired: float | None, static: float, mended: dict[str, Any]) -> None:
    better = np.array([[5.0, -1.0]])
    mended["forces"] = None if repaired is None else (better, repaired)
    found = gap_of(own_points([0.0, 0.0], [0.0, 1.0], cohesion=0.5))
    assert (found.static, found.load_factor) == (static, static)
    assert found.gap == (0.5 - static) / 0.5
    kept = repaired is not None and repaired >= 0.0
    assert found.forces.tolist() == (better if kept else 0.0 * better).tolist()


@pytest.mark.parametrize("dead", [[-1.0, 0.0], [-1.0, -1.0]])
def test_less_than_nothing_may_be_all_that_a_dead_load_leaves(dead: list[float], mended: dict[str, Any]) -> None:
    mended["forces"] = (GIVEN, -0.5)
    assert gap_of(own_points(dead, [0.0, 1.0], cohesion=0.5)).static == -0.5


@pytest.mark.parametrize("size", [1.0, 0.125])
def test_what_a_motion_lacks_is_charged_with_twice_the_largest_normal_force(
    size: float, mended: dict[str, Any]
) -> None:
    mended["forces"] = (GIVEN, 1.0)
    program = own_points([-1.0, 0.0], [0.0, 1.0], friction=0.5)
    found = proved_bounds(program, CollapseState(size * GIVEN, np.array([0.0, 1.0]), 3.0, np.nan))
    assert found.kinematic == 2.0 * 4.0 * size * 0.5


def test_the_least_value_counts(mended: dict[str, Any]) -> None:
    mended["forces"] = (GIVEN, 0.5)
    mended["motions"] = [np.array(u) for u in ([0.0, -1.0], [3.0, 1.0], [1.0, 1.0], [2.0, 1.0])]
    found = gap_of(own_points([-1.0, 0.0], [0.0, 1.0]))
    assert found.kinematic == 1.0
    assert found.velocities.tolist() == [1.0, 1.0]


def test_the_gap_of_nearly_nothing_is_over_a_thousandth_of_dead_over_live_load(mended: dict[str, Any]) -> None:
    mended["forces"] = (GIVEN, 0.001)
    found = gap_of(own_points([-4.0, 0.0], [0.0, 2.0], cohesion=0.003))
    assert found.kinematic == 0.0015
    assert found.gap == pytest.approx(0.0005 / (1e-3 * 2.0), rel=1e-12)


# Without friction: a point closes by what its normal velocity is below zero.


def does_fall(dead: list[float], velocities: list[float], **limits: float) -> bool:
    return falling_motion(own_points(dead, [0.0, 1.0], **limits), np.array(velocities)) is not None


@pytest.mark.usefixtures("mended")
def test_the_motion_is_scaled() -> None:
    motion = falling_motion(own_points([0.0, 1.0], [0.0, 1.0]), np.array([0.0, 0.25]))
    assert motion is not None
    assert motion.tolist() == [0.0, 1.0]


@pytest.mark.usefixtures("mended")
@pytest.mark.parametrize("size", [0.0, np.inf, np.nan])
def test_nothing_and_more_than_there_is_prove_nothing(size: float) -> None:
    assert not does_fall([0.0, 1.0], [0.0, size])


@pytest.mark.usefixtures("mended")
@pytest.mark.parametrize("weight", [0.5, 2.0])
@pytest.mark.parametrize(("closing", "falls"), [(0.99995e-4, True), (1.00005e-4, False)])
def test_closing_is_charged_with_ten_thousand_times_the_load(weight: float, closing: float, falls: bool) -> None:
    assert does_fall([0.0, weight], [-closing, 1.0]) is falls


@pytest.mark.usefixtures("mended")
@pytest.mark.parametrize(("cohesion", "falls"), [(0.9, True), (1.1, False)])
def test_joints_may_take_more_than_the_load_gains(cohesion: float, falls: bool) -> None:
    assert does_fall([0.0, 1.0], [0.0, 1.0], cohesion=cohesion) is falls


@pytest.mark.usefixtures("mended")
@pytest.mark.parametrize("size", [0.25, 4.0])
@pytest.mark.parametrize(("more", "falls"), [(1e-13, False), (3e-13, True)])
def test_work_that_is_the_rounding_of_its_parts_is_none(more: float, falls: bool, size: float) -> None:
    """Two parts that cancel but for the 1e-13 of their sum, and a little more."""
    assert does_fall([size, -size], [1.0, 1.0 - more]) is falls


@pytest.mark.usefixtures("mended")
def test_no_load_does_not_fall() -> None:
    assert not does_fall([0.0, 0.0], [0.0, 1.0])


def test_the_first_motion_that_falls_counts(mended: dict[str, Any]) -> None:
    mended["motions"] = [np.array(u) for u in ([-1.0, 1.0], [0.0, 0.5], [0.0, 1.0])]
    motion = falling_motion(own_points([0.0, 1.0], [0.0, 1.0]), np.array([0.0, 1.0]))
    assert motion is not None
    assert motion.tolist() == [0.0, 0.5]
