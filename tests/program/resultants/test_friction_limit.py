import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.program.resultants.conditions import M1, M2, N
from mbla.program.resultants.friction_limit import (
    FrictionLimit,
    curve_size,
    curve_support,
    friction_limit,
    nearest,
    torsion_reserve,
)
from mbla.program.resultants.torsion import TorsionLimits, torsion_limits
from tests.program.resultants.test_shapes import shapes_of

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


TRIANGLE = ((0.0, 0.0), (1.0, 0.0), (0.25, 0.75))


def triangle(friction: float = 0.5, cohesion: float = 0.0) -> TorsionLimits:
    return torsion_limits(shapes_of(*TRIANGLE), np.array([friction]), np.array([cohesion]))


def pressed_at(place: FloatArray, normal: float = 2.0) -> FloatArray:
    """Resultants of a normal force at a place of the interface, from its centroid."""
    r = np.zeros((1, 6))
    r[0, N], r[0, M1], r[0, M2] = normal, place[1] * normal, -place[0] * normal
    return r


@pytest.mark.parametrize("cohesion", [0.0, 0.25])
def test_what_acts_over_the_whole_area_falls_to_the_corners_and_edges(cohesion: float) -> None:
    """R = μ N (1 - t) + c A with the force on the way t from the centroid to the outline."""
    limits = triangle(cohesion=cohesion)
    corners = limits.corners
    for place in (*corners, *(0.5 * (corners + np.roll(corners, -1, axis=0)))):
        for t in (0.0, 0.25, 1.0):
            size = friction_limit(limits, pressed_at(t * place))
            assert size.total == pytest.approx(0.5 * 2.0 + cohesion)
            assert size.share == pytest.approx((1 - t) * 0.5 * 2.0 + cohesion, abs=1e-12)
    beyond = friction_limit(limits, pressed_at(3.0 * corners[0]))
    assert beyond.share == pytest.approx(0.0)


def test_sizes_change_with_the_resultants_as_their_derivatives_say() -> None:
    limits, h = triangle(cohesion=0.1), 1e-6
    draw = np.random.default_rng(4)
    for _ in range(20):
        r = np.append(draw.uniform(-1, 3), draw.normal(scale=0.2, size=5))[None]
        exact = friction_limit(limits, r)
        for j in range(6):
            up, down = (friction_limit(limits, r + s * h * np.eye(6)[j]) for s in (1, -1))
            for name, by in (("total", exact.of_total), ("share", exact.of_share)):
                rise = (getattr(up, name) - getattr(down, name)) / (2 * h)
                assert rise == pytest.approx(by.toarray()[:, j], abs=1e-6)


def test_reserve_is_what_no_twist_needs() -> None:
    """All of it at rest, none where the limit is reached or passed, and over the largest of all interfaces."""
    limits = triangle()
    r = pressed_at(np.zeros(2))
    assert torsion_reserve(limits, r) == pytest.approx(1.0)
    for twist, left in ((0.25, 0.75), (1.0, 0.0), (2.0, 0.0)):  # μ N = 1: m of the curve of this size
        r[0, 3] = twist * limits.radii[0]
        assert torsion_reserve(limits, r) == pytest.approx(left, abs=1e-12)
    nothing = torsion_limits(shapes_of(*TRIANGLE), np.zeros(1), np.zeros(1))
    assert np.isinf(torsion_reserve(nothing, r)).all()
