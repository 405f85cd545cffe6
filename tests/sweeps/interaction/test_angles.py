from __future__ import annotations

import math

import pytest

from mbla.sweeps.interaction.angles import angles_around, angles_between, closes, stretched, unit_vector


@pytest.mark.parametrize("degrees", [-390.0, -30.0, 0.1, 17.0, 44.9, 135.0, 271.0, 359.5])
def test_unit_vectors_are_cosine_and_sine(degrees: float) -> None:
    expected = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    assert unit_vector(degrees) == pytest.approx(expected, abs=1e-15)


def test_quarters_are_exact_and_without_negative_zeros() -> None:
    found = [unit_vector(angle) for angle in (0.0, 90.0, 180.0, 270.0, 360.0, -90.0)]
    assert found == [(1, 0), (0, 1), (-1, 0), (0, -1), (1, 0), (0, -1)]
    assert all(math.copysign(1.0, value) > 0 or value for pair in found for value in pair)


def test_images_of_an_angle_have_the_same_digits() -> None:
    """So that a symmetric structure is asked symmetric questions."""
    cosine, sine = unit_vector(25.0)
    assert unit_vector(155.0) == (-cosine, sine)
    assert unit_vector(205.0) == (-cosine, -sine)
    assert unit_vector(65.0) == (sine, cosine)


def test_ranges() -> None:
    assert angles_around(4) == (0.0, 90.0, 180.0, 270.0)
    assert angles_between(0.0, 90.0, 3) == (0.0, 45.0, 90.0)
    assert angles_between(-90.0, 270.0, 4) == (-90.0, 0.0, 90.0, 180.0)
    assert closes(-90.0, 270.0)
    assert not closes(0.0, 359.0)


def test_angles_are_even_in_the_units_of_both_axes() -> None:
    """(cos, sin / 20) of the angles lies at 0, 30, 60, 90 degrees."""
    angles = angles_between(0.0, 90.0, 4, ratio=20.0)
    seen = [math.degrees(math.atan2(unit_vector(angle)[1] / 20, unit_vector(angle)[0])) for angle in angles]
    assert seen == pytest.approx([0, 30, 60, 90], abs=1e-9)
    assert (angles[0], angles[-1]) == (0.0, 90.0)


@pytest.mark.parametrize("ratio", [1e-6, 0.3, 7.0, 1e6])
def test_a_stretched_circle_keeps_its_axes_and_its_turns(ratio: float) -> None:
    angles = angles_between(-90.0, 270.0, 8, ratio)
    assert angles[::2] == (-90.0, 0.0, 90.0, 180.0)
    assert list(angles) == sorted(angles)
    assert stretched(stretched(200.0, ratio), 1 / ratio) == pytest.approx(200.0, rel=1e-9)
