"""Moved corners against limit loads of soil that are known."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.soil_mesh.moving import move_corners
from mbla.soil_mesh.planar_program import find_mechanism
from tests.soil_mesh.scenes import SoilCase, slope, strip, wall


def error(case: SoilCase) -> float:
    return move_corners([case.scene], case.points, case.motions).load_factor / case.exact - 1.0


def test_strip_on_clay_is_that_of_prandtl() -> None:
    case = strip(0.0, 0.5, 1.8, 1.0)
    assert 0.0 < error(case) < 0.03


def test_vertical_cut_stands_as_high_as_bounds_say() -> None:
    case = slope(0.0, 0.5, exact=3.776)
    assert 0.0 < error(case) < 0.03


def test_a_mesh_that_locks_is_freed() -> None:
    case = strip(30.0, 0.5, 4.8, 1.7, crossed=False)
    assert find_mechanism(case.scene, case.points) is None
    assert 0.0 < error(case) < 0.1


@pytest.mark.parametrize("passive", [False, True])
def test_smooth_wall_has_the_pressure_of_rankine(passive: bool) -> None:
    sign = 1.0 if passive else -1.0
    exact = sign * np.tan(np.radians(45.0 + sign * 15.0)) ** 2 / 2.0
    assert 0.0 < sign * error(wall(30.0, 0.0, 0.5, passive, exact=exact)) < 0.03


def test_a_mesh_is_moved_for_two_load_cases_at_once() -> None:
    """Soil of no weight and friction under a strip: the load down and up, as it is glued to it."""
    case = strip(0.0, 0.5, 1.8, 1.0)
    up = replace(case.scene, live=-case.scene.live)
    moved = move_corners([case.scene, up], case.points, case.motions)
    first, last = moved.load_factors[0], moved.load_factors[-1]
    assert (last < first).all()
    assert (last / case.exact > 1.0).all()
    assert (last / case.exact < 1.04).all()
