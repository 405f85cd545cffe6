"""The path where interfaces twist under uniform pressure: closed forms, alone and with stress blocks."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.solution.law.interfaces import Interfaces
from tests.line import Line, line_of
from tests.solution.convex_structures import TWIST
from tests.solution.flow.paths import load_factor_of, reduced, rest_of, stress_blocks, torsion

SQUARE = (np.sqrt(2) + np.log(1 + np.sqrt(2))) / 6
THETA = 2 - 4 * SQUARE * np.arcsinh(1.0)

CLOSE = 1.5e-3
"""Relative: where the force point is in the middle a thousandth of the torsion is given up."""


def twisting(line: Line) -> float:
    return load_factor_of(line, interfaces=torsion(line))


def test_square_under_uniform_pressure() -> None:
    assert twisting(line_of(TWIST)) == pytest.approx(2 * 0.6 * SQUARE, rel=CLOSE)
    assert load_factor_of(line_of(TWIST)) == pytest.approx(2 * 0.6 * np.sqrt(0.5), rel=2e-5)  # corners: 85 % more


@pytest.mark.every(2)
@pytest.mark.parametrize(("e1", "e2"), [(0.3, 0.0), (0.0, -0.5), (0.4, 0.3), (-0.6, 0.2)])
def test_eccentric_force_leaves_less_of_the_area(e1: float, e2: float) -> None:
    """The force 2 W is at (e1, e2)/2; the tangent to ρ(a', b') takes ρ (e1' + e2')/a off."""
    expected = 0.6 * 2 * SQUARE * (1 - abs(e1) / 2 - abs(e2) / 2)
    assert twisting(line_of(TWIST, f"parameters.e1={e1}", f"parameters.e2={e2}")) == pytest.approx(expected, rel=2e-5)


@pytest.mark.parametrize("arm", [0.1, 0.5, 3.0])
def test_shear_and_torsion_follow_the_safe_curve(arm: float) -> None:
    """t² = (1 − m)(1 + (1 − θ) m) with t = λ/μ, m = λ arm/(μ ρ): a quadratic equation for λ."""
    m = arm / SQUARE
    size = 0.5 * (THETA * m + np.sqrt(((2 - THETA) * m) ** 2 + 4))
    assert twisting(line_of(TWIST, f"parameters.arm={arm}", case=1)) == pytest.approx(0.6 / size, rel=CLOSE)


def test_cohesion_twists_with_the_whole_area() -> None:
    base = ("parameters.c=0.7", "parameters.ft=0.5", "parameters.e1=0.4")
    # shifted by f_t: c' = c − μ f_t all over, friction of N' = 2 W + f_t A, whose point is at 0.4/2.5
    expected = SQUARE * ((0.7 - 0.6 * 0.5) + 0.6 * 2.5 * (1 - 0.4 / 2.5))
    assert twisting(line_of(TWIST, *base)) == pytest.approx(expected, rel=2e-5)
    assert twisting(line_of(TWIST, "parameters.c=0.7", "parameters.mu=0")) == pytest.approx(0.7 * SQUARE, rel=CLOSE)


@pytest.mark.parametrize("strength", [pytest.param(3.2, marks=pytest.mark.long), 3.5])
def test_stress_blocks_beside_it_take_nothing_from_torsion(strength: float) -> None:
    """Twice the weight, a fifth of the side off the middle, needs 2/0.6 = 3.33 weights over the area."""
    text = TWIST.replace('cohesion: "=c*W/(a*a)"', f'compressive_strength: "={strength}*W/(a*a)"')
    line = line_of(text, "parameters.e1=0.4")
    both = Interfaces(stress_blocks(line).crushing, torsion(line).twisting)
    stands = strength > 2 / 0.6
    assert rest_of(line, interfaces=both).carried is stands
    if stands:
        expected = 0.6 * 2 * SQUARE * (1 - 0.4 / 2)
        assert load_factor_of(line, interfaces=both) == pytest.approx(expected, rel=1e-4)


def test_what_moves_in_a_plane_does_not_twist() -> None:
    line = line_of(TWIST, "parameters.arm=0", case=1)
    assert reduced(line).components == 2
    assert torsion(line).rows_of(reduced(line)) == ()
    assert twisting(line) == pytest.approx(0.6, rel=2e-5)


def test_torsion_goes_without_dilatancy() -> None:
    line = line_of(TWIST)
    with pytest.raises(ValueError, match="without dilatancy"):
        load_factor_of(line, associative_flow=True, interfaces=torsion(line))
