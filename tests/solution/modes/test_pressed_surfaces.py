from __future__ import annotations

import numpy as np
import pytest

from mbla.solution.modes.pressed_surfaces import clipped, moments_of

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
