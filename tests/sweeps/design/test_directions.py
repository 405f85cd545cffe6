from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy import stats
from scipy.spatial import SphericalVoronoi

from mbla.errors import DeckError
from mbla.sweeps.design.design import Design, TurnedVector
from mbla.sweeps.design.directions import sine_cosine
from tests.sweeps.design.hand_made import column, design, drawn

BASE: TurnedVector = (3.0, 4.0, -12.0)


def directions(parameter: dict[str, Any], vector: TurnedVector = BASE) -> Design:
    return design({"x": {"key": "loads.wind", **parameter}}, vectors={"x": vector})


def vectors_of(found: Design) -> np.ndarray[Any, np.dtype[np.float64]]:
    return np.array([next(iter(point.settings.values())) for point in found.points], dtype=float)


@pytest.mark.parametrize("turns", [-360, 0, 360])
def test_sine_and_cosine_are_exact_along_the_axes(turns: float) -> None:
    found = [sine_cosine(angle + turns) for angle in (0, 90, 180, 270)]
    assert found == [(0, 1), (1, 0), (0, -1), (-1, 0)]
    assert not any(math.copysign(1, value) < 0 for pair in found for value in pair if value == 0)


def test_the_horizon_turns_the_horizontal_part_and_keeps_the_vertical_one() -> None:
    found = directions({"horizon": {"points": 4}})
    assert vectors_of(found).tolist() == [[5, 0, -12], [0, 5, -12], [-5, 0, -12], [0, -5, -12]]
    assert column(found, "x") == [0, 90, 180, 270]  # the full circle has its end left out
    assert (found.columns[0].role, found.columns[0].unit, found.columns[0].random) == ("azimuth", "degree", False)


def test_drawn_azimuths_are_uniform() -> None:
    found = drawn({"horizon": {"from": 0, "to": 90}}, 500, "latin_hypercube")
    counts, _ = np.histogram(column(found, "x"), np.linspace(0, 90, 11))
    assert counts.tolist() == [50] * 10
    assert np.linalg.norm(vectors_of(found), axis=1) == pytest.approx(np.full(500, 13))
    assert found.columns[0].random


def test_points_over_a_sphere_have_equal_shares_of_it() -> None:
    """Areas of their Voronoi cells: half within 1 %, those at the poles, where no spiral is even, within 12 %."""
    points = 400
    unit = vectors_of(directions({"sphere": {"points": points, "size": 1}}))
    assert np.linalg.norm(unit, axis=1) == pytest.approx(np.ones(points), abs=1e-15)
    share = SphericalVoronoi(unit).calculate_areas() * points / (4 * math.pi)
    assert np.median(abs(share - 1)) < 0.01
    assert abs(share - 1).max() < 0.12


def test_a_band_of_the_sphere_is_filled_evenly() -> None:
    found = directions({"sphere": {"from": -30, "to": 90, "points": 300}})
    elevation = np.array(column(found, "x_elevation"))
    counts, _ = np.histogram(np.sin(np.radians(elevation)), np.linspace(-0.5, 1, 16))
    assert counts.tolist() == [20] * 15
    assert np.linalg.norm(vectors_of(found), axis=1) == pytest.approx(np.full(300, 13))
    assert [column.role for column in found.columns] == ["azimuth", "elevation"]


def test_drawn_directions_are_uniform_over_the_sphere() -> None:
    x, y, z = vectors_of(drawn({"sphere": {}}, 4000)).T / 13
    for component in (x, y, z):  # Archimedes: each component by itself is uniform; 1.63/sqrt(n) for one in a hundred
        assert stats.kstest(component, stats.uniform(-1, 2).cdf).statistic < 1.63 / math.sqrt(4000)


@pytest.mark.parametrize(
    ("parameter", "vector", "message"),
    [
        (
            {"horizon": {"points": 4}},
            (0.0, 0.0, -1.0),
            "turns a vector that has no length in these directions: give its size",
        ),
        ({"sphere": {"points": 4}}, (0.0, 0.0, 0.0), "turns a vector that has no length in these directions"),
        ({"sphere": {"points": 4}}, (1.7e308, 1.7e308, 0.0), "turns a vector that is longer than a number holds"),
    ],
)
def test_refusals(parameter: dict[str, Any], vector: TurnedVector, message: str) -> None:
    with pytest.raises(DeckError) as caught:
        directions(parameter, vector)
    [fault] = caught.value.faults
    assert fault.key == f"parameters.x.{next(iter(parameter))}"
    assert fault.message.startswith(message)
