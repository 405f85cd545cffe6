import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.program.convex.friction_limit import FrictionLimit, curve_size, curve_support, nearest

NONE = None


def sets(n: int, seed: int = 1) -> tuple[FrictionLimit, FloatArray, FloatArray]:
    """Sets of many sizes, their θ, and trial forces around them."""
    rng = np.random.default_rng(seed)
    theta = np.where(np.arange(n) % 7 == 0, 1.0, rng.uniform(0.0, 1.0, n))
    total = rng.uniform(0.5, 2.0, n)
    return limit_of(total, total * rng.uniform(0.1, 0.95, n)), theta, 2.0 * rng.normal(size=(n, 3))


def limit_of(total: FloatArray, share: FloatArray) -> FrictionLimit:
    return FrictionLimit(total, share, NONE, NONE)  # type: ignore[arg-type]


def needed(point: FloatArray, limit: FrictionLimit, theta: FloatArray) -> FloatArray:
    """Size of the curve that a point needs, over the one there is."""
    beyond = np.maximum(np.hypot(point[:, 0], point[:, 1]) - (limit.total - limit.share), 0.0)
    return curve_size(beyond, np.abs(point[:, 2]), theta) / limit.share


def test_nearest_point_is_in_the_set_and_nearer_than_others_in_it() -> None:
    limit, theta, trial = sets(60)
    found = nearest(trial, limit, theta).point
    assert needed(found, limit, theta).max() <= 1 + 1e-12
    others = 1.5 * np.random.default_rng(2).normal(size=(4000, 3))
    for i in range(60):
        alone = limit_of(np.full(4000, limit.total[i]), np.full(4000, limit.share[i]))
        inside = others[needed(others, alone, np.full(4000, theta[i])) <= 1]
        # a nearest point of a convex set: no point of the set lies beyond it, seen from the trial
        assert ((inside - found[i]) @ (trial[i] - found[i])).max() <= 1e-9


def test_points_inside_stay() -> None:
    limit, theta, trial = sets(200)
    inside = needed(trial, limit, theta) <= 1
    assert inside.any()
    assert nearest(trial, limit, theta).point[inside] == pytest.approx(trial[inside], abs=1e-15)


def test_derivatives() -> None:
    limit, theta, trial = sets(400)
    exact, h = nearest(trial, limit, theta), 1e-6
    for j in range(3):
        up, down = (nearest(trial + s * h * np.eye(3)[j], limit, theta).point for s in (1, -1))
        off = np.abs((up - down) / (2 * h) - exact.by_point[:, :, j]).max(axis=1)
        assert np.mean(off < 1e-6) > 0.99  # the others have a kink between the two ends
    for name, by in (("total", exact.by_total), ("share", exact.by_share)):
        shift = {"total": (h, 0.0), "share": (0.0, h)}[name]
        up, down = (
            nearest(trial, limit_of(limit.total + s * shift[0], limit.share + s * shift[1]), theta).point
            for s in (1, -1)
        )
        off = np.abs((up - down) / (2 * h) - by).max(axis=1)
        assert np.mean(off < 1e-6) > 0.99


def test_support_is_the_greatest_power_over_the_curve() -> None:
    rng = np.random.default_rng(5)
    m = np.linspace(0, 1, 20001)
    for theta in (0.0, 0.65, 1.0):
        t = np.sqrt((1 - m) * (1 + (1 - theta) * m))
        for slip, twist in rng.uniform(0, 1, (20, 2)):
            most = (slip * t + twist * m).max()
            found = curve_support(np.array([slip]), np.array([twist]), np.array([theta]))
            assert found == pytest.approx(most, abs=1e-5)
