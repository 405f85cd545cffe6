"""Limits of contact points, and the warning where these overstate an interface."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.program.yield_conditions import CONDITIONS, Crushing, TensionCutOff, YieldLimits, yield_violation
from tests.program.random_points import mixed_program


def limits_of(mu: float = 0.5, c: float = 0.0, ft: float = 0.0, fc: float = np.inf) -> YieldLimits:
    return YieldLimits(*(np.array([value]) for value in (mu, 0.0, c, ft, fc)))


def force(n: float, t1: float = 0.0, t2: float = 0.0) -> FloatArray:
    return np.array([[n, t1, t2]])


@pytest.mark.parametrize("angle", np.linspace(0, 2 * np.pi, 13))
def test_the_friction_cone_is_round(angle: float) -> None:
    shear = np.array([np.cos(angle), np.sin(angle)])
    assert yield_violation(force(2.0, *shear), limits_of(mu=0.5))[0] == pytest.approx(0.0, abs=1e-15)
    assert yield_violation(force(2.0, *(1.25 * shear)), limits_of(mu=0.5))[0] == pytest.approx(0.25)


@pytest.mark.parametrize(
    ("x", "limits", "excess"),
    [
        (force(-0.1), limits_of(), 0.1),
        (force(-0.1), limits_of(mu=0.0), 0.1),
        (force(-0.1), limits_of(c=1.0, ft=0.1), 0.0),
        (force(-0.3), limits_of(c=1.0, ft=0.1), 0.2),
        (force(5.0), limits_of(fc=4.0), 1.0),
        (force(1.0, 1.6), limits_of(c=1.0), 0.1),
        (force(1e9), limits_of(), 0.0),
    ],
)
def test_excess_over_each_limit(x: FloatArray, limits: YieldLimits, excess: float) -> None:
    assert yield_violation(x, limits)[0] == pytest.approx(excess)


def test_dry_joints_need_no_row_for_tension_because_the_cone_ends_at_zero() -> None:
    assert not TensionCutOff.applies(limits_of(mu=0.5))[0]
    assert TensionCutOff.applies(limits_of(mu=0.5, c=1.0))[0]
    assert TensionCutOff.applies(limits_of(mu=0.0))[0]
    assert not Crushing.applies(limits_of())[0]


def test_scaling_leaves_friction_and_unlimited_compression_alone() -> None:
    scaled = limits_of(mu=0.5, c=2.0, ft=1.0).scaled(10.0)
    assert (scaled.friction[0], scaled.cohesion[0], scaled.tension[0]) == (0.5, 20.0, 10.0)
    assert np.isinf(scaled.compression[0])
    assert limits_of(fc=4.0).scaled(10.0).compression[0] == 40.0


def test_conditions_that_do_not_apply_are_implied_by_those_that_do() -> None:
    draw = np.random.default_rng(1)
    limits = mixed_program(3, 1).limits
    n = len(limits.friction)
    for _ in range(200):
        forces = draw.normal(scale=0.5, size=(n, 3))
        forces[draw.random((n, 3)) < 0.3] = 0.0
        left = np.full(n, np.inf)
        for condition in CONDITIONS:
            demand = np.linalg.norm(forces[:, 1:], axis=1) if condition.bounds_shear else 0.0
            room = condition.offset(limits) + condition.slope(limits) * forces[:, 0] - demand
            left = np.where(condition.applies(limits), np.minimum(left, room), left)
        assert np.array_equal(left >= 0, yield_violation(forces, limits) == 0)
