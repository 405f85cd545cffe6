"""Loops of corners in the plane."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.contacts.convex import convex_loops, signed_areas


def test_convexity_of_loops() -> None:
    star: list[list[float]] = [[np.cos(k * 4 * np.pi / 5), np.sin(k * 4 * np.pi / 5)] for k in range(5)]
    square: list[list[float]] = [[0, 0], [1, 0], [1, 1], [0, 1]]
    notched: list[list[float]] = [[0, 0], [1, 0], [0.5, 0.5], [1, 1], [0, 1]]
    flat_corner: list[list[float]] = [[0, 0], [0.5, 0], [1, 0], [1, 1], [0, 1]]
    turned = square[::-1]
    twice = [*square[:2], *square[1:]]
    loops = [square, turned, flat_corner, notched, star, twice, twice[::-1]]
    start = np.concatenate([[0], np.cumsum([len(loop) for loop in loops])])
    assert convex_loops(np.concatenate(loops), start).tolist() == [True, True, True, False, False, True, True]


def test_areas_of_loops_have_the_sign_of_their_turn() -> None:
    """A rectangle of 3 by 2, the same the other way round, and a triangle of half of it, away from the origin."""
    rectangle = np.array([[0.0, 0.0], [3.0, 0.0], [3.0, 2.0], [0.0, 2.0]]) + np.array([10.0, -7.0])
    loops = [rectangle, rectangle[::-1], rectangle[:3]]
    start = np.array([0, 4, 8, 11])
    assert signed_areas(np.concatenate(loops), start) == pytest.approx([6.0, -6.0, 3.0], rel=1e-12)
