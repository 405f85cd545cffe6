"""Metrics against the barriers they come from, differentiated numerically."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from mbla.program.yield_conditions import YieldLimits
from mbla.solution.associative.repair import force_metric, velocity_hessian

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
