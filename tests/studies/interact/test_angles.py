from __future__ import annotations

import math

import pytest

from mbla.studies.interact.angles import angles_around, angles_between, closes, unit_vector


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
