from __future__ import annotations

import numpy as np
import pytest

from mbla.solution.modes.polygons import clipped, lifted, moments_of

SQUARE = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]])
L_SHAPE = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]])


def test_moments_of_polygons_one_after_the_other() -> None:
    found = moments_of(np.vstack([SQUARE, L_SHAPE]), np.array([0, 4, 10]))
    assert found[0] == pytest.approx([4, 4, 4, 16 / 3, 4, 16 / 3])
    squares = [moments_of(SQUARE / 2 + np.array(corner), np.array([0, 4]))[0] for corner in ((0, 0), (1, 0), (0, 1))]
    assert found[1] == pytest.approx(np.sum(squares, axis=0))


def test_a_line_cuts_off_what_lies_below() -> None:
    part = clipped(SQUARE, SQUARE[:, 0] - 0.5)
    assert moments_of(part, np.array([0, len(part)]))[0][:3] == pytest.approx([3, 3 * 1.25, 3])
    assert len(clipped(SQUARE, np.full(4, -1.0))) == 0
    part = clipped(L_SHAPE, L_SHAPE[:, 1] - 0.5)
    assert moments_of(part, np.array([0, len(part)]))[0][0] == pytest.approx(2)


@pytest.mark.parametrize("volume", [1e-9, 0.01, 3.0, 40.0])
def test_a_plane_is_lifted_until_it_has_a_volume(volume: float) -> None:
    """Of y_1 − 3/2 over a square of 2 by 2: a strip of the breadth w has w², until all of it has 4 (s − 1/2)."""
    found = lifted(SQUARE, SQUARE[:, 0] - 1.5, volume)
    greatest = np.sqrt(volume) if volume < 4.0 else volume / 4.0 + 1.0
    assert found.max() == pytest.approx(greatest, rel=1e-6)  # the plane is known to 1e-16 of its heights
    assert found - found[0] == pytest.approx(SQUARE[:, 0])
