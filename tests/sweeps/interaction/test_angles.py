from __future__ import annotations

import math

import pytest

from mbla.sweeps.design.directions import horizontal
from mbla.sweeps.interaction.question import angles_between, closes, stretched


def test_ranges() -> None:
    assert angles_between(0.0, 360.0, 4) == (0.0, 90.0, 180.0, 270.0)
    assert angles_between(0.0, 90.0, 3) == (0.0, 45.0, 90.0)
    assert angles_between(-90.0, 270.0, 4) == (-90.0, 0.0, 90.0, 180.0)
    assert closes(-90.0, 270.0)
    assert not closes(0.0, 359.0)


def test_angles_are_even_in_the_units_of_both_axes() -> None:
    """(cos, sin / 20) of the angles lies at 0, 30, 60, 90 degrees."""
    angles = angles_between(0.0, 90.0, 4, ratio=20.0)
    seen = [math.degrees(math.atan2(horizontal(angle, 1.0)[1] / 20, horizontal(angle, 1.0)[0])) for angle in angles]
    assert seen == pytest.approx([0, 30, 60, 90], abs=1e-9)
    assert (angles[0], angles[-1]) == (0.0, 90.0)


@pytest.mark.parametrize("ratio", [1e-6, 0.3, 7.0, 1e6])
def test_a_stretched_circle_keeps_its_axes_and_its_turns(ratio: float) -> None:
    angles = angles_between(-90.0, 270.0, 8, ratio)
    assert angles[::2] == (-90.0, 0.0, 90.0, 180.0)
    assert list(angles) == sorted(angles)
    assert stretched(stretched(200.0, ratio), 1 / ratio) == pytest.approx(200.0, rel=1e-9)
