"""Loops of corners in the plane."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from mbla.arrays import FloatArray, starts
from mbla.contacts.convex import clip_convex, convex_loops


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


def clip(first: FloatArray, second: FloatArray) -> FloatArray:
    start = np.array([0, len(first)]), np.array([0, len(second)])
    corners, _ = clip_convex(first, start[0], second, start[1])
    return corners


def area(corners: FloatArray) -> float:
    following = np.roll(corners, -1, axis=0)
    return float((corners[:, 0] * following[:, 1] - corners[:, 1] * following[:, 0]).sum() / 2)


SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])


def shifted(x: float, y: float) -> FloatArray:
    return np.asarray(SQUARE + np.array([x, y]))


def test_orientation_of_either_does_not_matter() -> None:
    other = shifted(0.25, 0.5)
    for first in (SQUARE, SQUARE[::-1]):
        for second in (other, other[::-1]):
            assert area(clip(first, second)) == pytest.approx(0.375, rel=1e-15)


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_size_of_both_does_not_matter(scale: float) -> None:
    common = area(clip(scale * SQUARE, scale * shifted(0.25, 0.5)))
    assert common / scale**2 == pytest.approx(0.375, rel=1e-14)


def test_squares_that_differ_by_rounding_are_not_lost() -> None:
    """For this pair the general overlay of a library returns two points."""
    first = np.array(
        [
            [-0.2988805948014821, -0.4632796822577667],
            [0.4988542772999263, -0.2347383308309684],
            [0.2988805948014856, 0.4632796822577602],
            [-0.4988542772999304, 0.2347383308309725],
        ]
    )
    second = np.array(
        [
            [0.4988542772999264, -0.2347383308309684],
            [-0.298880594801482, -0.4632796822577667],
            [-0.4988542772999304, 0.2347383308309725],
            [0.2988805948014857, 0.4632796822577602],
        ]
    )
    assert area(clip(first, second)) == pytest.approx(area(first), rel=1e-12)


def convex_polygon(seed: int, corners: int) -> FloatArray:
    rng = np.random.default_rng(seed)
    hull = shapely.convex_hull(shapely.multipoints(rng.normal(size=(corners + 3, 2))))
    return np.asarray(shapely.get_coordinates(hull)[:-1])


@settings(max_examples=60)
@given(st.lists(st.tuples(st.integers(0, 10**6), st.integers(3, 40)), min_size=2, max_size=12))
def test_agrees_with_a_general_overlay(seeds: list[tuple[int, int]]) -> None:
    polygons = [convex_polygon(*seed) for seed in seeds]
    pairs = list(itertools.pairwise(polygons))
    first, second = zip(*pairs, strict=True)
    corners, start = clip_convex(
        np.concatenate(first),
        starts(np.array([len(p) for p in first])),
        np.concatenate(second),
        starts(np.array([len(p) for p in second])),
    )
    for i, (a, b) in enumerate(pairs):
        found = corners[start[i] : start[i + 1]]
        expected = shapely.intersection(shapely.Polygon(a), shapely.Polygon(b)).area
        assert (area(found) if len(found) else 0.0) == pytest.approx(expected, abs=1e-9)
