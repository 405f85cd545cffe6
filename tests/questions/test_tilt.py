"""The unit circle of a tilting table and the half-planes that bound it."""

from __future__ import annotations

import math

import pytest

from mbla.questions.tilt import Line, angle_above, never_left


@pytest.mark.parametrize("mu", [0.0, 0.3, 1.0, 40.0])
def test_friction_alone(mu: float) -> None:
    """b <= mu a is left at atan(mu)."""
    assert Line(-mu, 1.0, 0.0).first_crossing() == pytest.approx(math.atan(mu), rel=1e-14, abs=1e-14)


def test_friction_and_cohesion() -> None:
    """b <= mu a + c is left where sin(t - atan(mu)) = c cos(atan(mu))."""
    phi, c = math.atan(0.4), 0.7
    expected = phi + math.asin(c * math.cos(phi))
    assert Line(-0.4, 1.0, c).first_crossing() == pytest.approx(expected, rel=1e-14)


def test_a_line_that_the_circle_never_reaches() -> None:
    assert math.isinf(Line(0.3, 0.4, 0.6).first_crossing())
    assert math.isinf(Line(0.0, 0.0, 0.0).first_crossing())


def test_beyond_the_upright() -> None:
    """a >= -1/2 is left at 120 degrees."""
    assert Line(-1.0, 0.0, 0.5).first_crossing() == pytest.approx(math.radians(120))


def test_what_is_proved_reaches_the_angle_as_the_share_reaches_one() -> None:
    found = [angle_above(2.0, share, math.radians(60)) for share in (0.9, 0.99, 0.999999, 1.0)]
    assert found == sorted(found)
    assert found[0] < math.radians(60) - 1e-3
    assert found[3] == math.radians(60)
    # the point at the angle proved lies on the straight line between (1, 2) and the share of the chord
    a, b = 1 - 0.9 * (1 - math.cos(math.radians(60))), 0.9 * math.sin(math.radians(60))
    run, rise = math.cos(found[0]) - 1, math.sin(found[0]) - 2
    assert run * (b - 2) == pytest.approx(rise * (a - 1), rel=1e-12)


def test_nothing_is_proved_where_the_level_table_bears_too_little() -> None:
    assert math.isnan(angle_above(math.tan(math.radians(29)), 1.0, math.radians(60)))
    assert not math.isnan(angle_above(math.inf, 0.5, math.radians(60)))


def test_left_at_its_beginning() -> None:
    """Rounding on either side of nothing is nothing, not a whole turn."""
    for limit in (1.0, 1.0 - 1e-16, 1.0 + 1e-16):
        assert Line(limit, 1.0, limit - 1e-16).first_crossing() <= 1e-7
        assert Line(1.0, 1.0, limit).first_crossing() <= 1e-7


def test_what_is_borne_all_the_way_round() -> None:
    """The side from (1, u) to (1 - 2 o, 0) touches the circle where (2 o - 1) u = hypot(2 o, u); u = 2 at o = 4/3."""
    assert never_left(math.inf, 1.0)
    assert not never_left(math.inf, 0.999)
    assert never_left(2.0, 4.0 / 3.0 + 1e-6)
    assert not never_left(2.0, 4.0 / 3.0 - 1e-6)
    assert not never_left(0.0, 1e9)
    assert not never_left(math.nan, 2.0)
    assert not never_left(2.0, math.nan)
