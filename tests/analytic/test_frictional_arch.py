"""The theory of the arch with friction against the published figures and against linear programs."""

from __future__ import annotations

import pytest

from tests.analytic.frictional_arch import (
    least_friction,
    least_thickness,
    rotational_friction,
    rotational_thickness,
)
from tests.analytic.planar import arch_load_factor, centre_line_arch

PUBLISHED = {0.7: 0.107426, 0.38: 0.122192, 0.35: 0.152920, 0.31: 0.199653}
HALF_A_DIGIT = 5.1e-7
"""six digits are printed, rounded"""


@pytest.mark.parametrize("mu", PUBLISHED)
def test_the_least_thickness_is_the_published_one(mu: float) -> None:
    assert least_thickness(mu) == pytest.approx(PUBLISHED[mu], abs=HALF_A_DIGIT)


def test_the_ends_of_the_curve_are_the_published_ones() -> None:
    assert rotational_thickness() == pytest.approx(0.107426, abs=HALF_A_DIGIT)
    assert rotational_friction() == pytest.approx(0.395832, abs=HALF_A_DIGIT)
    assert least_friction() == pytest.approx(0.309215, abs=HALF_A_DIGIT)
    assert least_thickness(0.3092) is None


@pytest.mark.parametrize("mu", [0.32, 0.34, 0.36, 0.42])
def test_a_linear_program_of_many_joints_stands_above_the_curve_and_falls_below_it(mu: float) -> None:
    """With 180 joints the arch stands down to a thickness that is smaller by less than 2e-4, never larger."""
    least = least_thickness(mu)
    assert least is not None
    assert arch_load_factor(centre_line_arch(least + 1e-6, 180), mu) is not None
    assert arch_load_factor(centre_line_arch(least - 2e-4, 180), mu) is None
