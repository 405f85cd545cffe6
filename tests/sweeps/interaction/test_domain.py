"""Polygons about the safe domain, and bounds that contradict each other: each breaks one thing."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.sweeps.interaction.domain import area, clipped, convex_hull, domain_of, everywhere
from tests.sweeps.interaction.hand_made import around, point, study

PAIR = ("A", "B")
SQUARE = np.array([[1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]])


def test_hull_leaves_out_what_lies_inside_and_on_its_sides() -> None:
    found = convex_hull(np.array([*SQUARE.tolist(), [0.0, 0.0], [1.0, 0.5], [0.3, 1.0]]))
    assert sorted(map(tuple, found.tolist())) == sorted(map(tuple, SQUARE.tolist()))
    assert area(found) == 4.0


def test_clipping() -> None:
    assert area(clipped(SQUARE, np.array([1.0, 1.0, 0.0]))) == pytest.approx(2.0)
    assert area(clipped(SQUARE, np.array([1.0, 0.0, 5.0]))) == 4.0
    assert len(clipped(SQUARE, np.array([1.0, 0.0, -5.0]))) == 0


def test_tangents_and_chords_of_a_circle() -> None:
    domain = domain_of(around(6), PAIR, closed=True)
    assert domain is not None
    assert not domain.crossings
    assert not domain.cut_off
    assert area(domain.inner) == pytest.approx(0.25 * 3 * np.sqrt(3) / 2)
    assert area(domain.outer) == pytest.approx(0.25 * 6 / np.sqrt(3))
    assert everywhere(domain, closed=True) == pytest.approx(0.5 * np.sqrt(3) / 2)


def test_a_safe_point_beyond_a_half_plane_of_another_is_an_error() -> None:
    """Its own bound is far enough, that of its neighbour at 60 degrees allows 0.5 / cos 60 = 1 there."""
    points = around(6)
    points[0] = replace(points[0], static_bound=1.01, kinematic_bound=1.01)
    domain = domain_of(points, PAIR, closed=True)
    assert domain is not None
    worst = domain.crossings[0]
    assert worst.safe == 0.0
    assert worst.angle in (60.0, 300.0)
    assert worst.share == pytest.approx(0.01 / 1.01, rel=0.02)
    assert everywhere(domain, closed=True) is None
    assert study(points).exit_code == 4


def test_a_point_that_its_neighbours_leave_behind_is_an_error_without_any_mechanism() -> None:
    """Between 0.5 and 0.5 at 60 degrees either side the hull reaches 0.25: a bound of 0.2 cannot be one."""
    points = [replace(one, powers={}) for one in around(6)]
    points[1] = replace(points[1], static_bound=0.2, kinematic_bound=0.2)
    domain = domain_of(points, PAIR, closed=True)
    assert domain is not None
    assert len(domain.outer) == 0
    (crossing,) = domain.crossings
    assert crossing.angle == 60.0
    assert crossing.share == pytest.approx(0.05 / 0.25)


def test_the_origin_is_safe_only_where_the_structure_stands() -> None:
    """Over 90 degrees of rays the hull of the points alone is a chord's worth away from it."""
    angles = (0.0, 45.0, 90.0)
    standing = domain_of([point(angle) for angle in angles], PAIR, closed=False)
    doubtful = domain_of([point(angle, standing="doubtful") for angle in angles], PAIR, closed=False)
    assert standing is not None
    assert doubtful is not None
    assert area(standing.inner) - area(doubtful.inner) == pytest.approx(0.125)


def test_without_bounds_there_is_no_domain() -> None:
    nan = float("nan")
    assert domain_of(around(4, static_bound=nan, kinematic_bound=nan), PAIR, closed=True) is None
