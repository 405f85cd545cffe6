"""Crushing of interfaces against full stress over parts that are cut out of their outlines."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.program.resultants.crushing import crushing_limits, crushing_violation
from mbla.solution.verification.interface_laws import crushing_excess, crushing_power
from tests.program.resultants.polygons import points_inside
from tests.solution.outlines import OUTLINES, PIECES, STRENGTH, area_of, full_stress, laws_of, random_closing

TENSION = 3.0
"""f_t A."""
N_CUTS = 40


def at_the_border(name: str, tension: float = 0.0) -> FloatArray:
    """Resultants of full stress over random parts, (n, 6)."""
    shapes = laws_of(name, 1).shapes
    strength = STRENGTH + tension / area_of(shapes)
    carried = np.array([full_stress(shapes, q) for q in random_closing(shapes, N_CUTS, 5)]) * strength
    resultants = np.zeros((N_CUTS, 6))
    resultants[:, [0, 4, 5]] = carried
    resultants[:, 0] -= tension
    return resultants


def with_moment(resultants: FloatArray, share: float) -> FloatArray:
    changed = resultants.copy()
    changed[:, 4:] *= share
    return changed


@pytest.mark.parametrize("tension", [0.0, TENSION])
@pytest.mark.parametrize("name", OUTLINES)
def test_full_stress_over_any_part_is_at_the_border(name: str, tension: float) -> None:
    laws, border = laws_of(name, N_CUTS, tension), at_the_border(name, tension)
    assert crushing_excess(laws, border) == pytest.approx(np.zeros(N_CUTS), abs=1e-9 * laws.strength[0])
    assert np.all(crushing_excess(laws, with_moment(border, 1.001)) > 0)
    assert np.all(crushing_excess(laws, with_moment(border, 0.999)) < 0)


@pytest.mark.parametrize("tension", [0.0, TENSION])
@pytest.mark.parametrize("name", PIECES)
def test_the_conditions_of_the_program_have_the_same_border(name: str, tension: float) -> None:
    laws, border = laws_of(name, N_CUTS, tension), at_the_border(name, tension)
    limits = crushing_limits(laws.shapes, laws.strength - tension, laws.tension)
    assert crushing_violation(limits, border) == pytest.approx(np.zeros(N_CUTS), abs=1e-9 * laws.strength[0])
    assert np.all(crushing_violation(limits, with_moment(border, 1.001)) > 0)
    assert np.all(crushing_violation(limits, with_moment(border, 0.999)) < 0)


@pytest.mark.parametrize("name", PIECES)
def test_both_agree_anywhere(name: str) -> None:
    """Random forces: pressed too much, pulled, beside the middle, within."""
    laws, draw = laws_of(name, 400), np.random.default_rng(4)
    size, arm = float(laws.strength[0]), float(laws.shapes.radii[0])
    resultants = np.zeros((400, 6))
    resultants[:, 0] = draw.uniform(-0.2, 1.2, 400) * size
    resultants[:, 4:] = draw.normal(scale=0.2 * size * arm, size=(400, 2))
    excess = crushing_excess(laws, resultants)
    violation = crushing_violation(crushing_limits(laws.shapes, laws.strength, laws.tension), resultants)
    clear = np.abs(excess) > 1e-9 * size
    assert np.array_equal(excess[clear] > 0, violation[clear] > 0)
    assert set((excess > 0).tolist()) == {False, True}


def test_no_more_than_the_strength_and_no_tension() -> None:
    laws = laws_of("trapezium", 4)
    size = float(laws.strength[0])
    resultants = np.zeros((4, 6))
    resultants[:, 0] = (size, 0.0, 1.25 * size, -0.25 * size)
    expected = (0.0, 0.0, 0.25 * size, 0.25 * size)
    assert crushing_excess(laws, resultants) == pytest.approx(expected, abs=1e-9 * size)


@pytest.mark.parametrize("name", OUTLINES)
def test_power_is_that_of_full_stress_where_it_closes(name: str) -> None:
    """Against Gauss points over the whole area; what opens takes the tensile strength."""
    laws = laws_of(name, N_CUTS, TENSION)
    closing = random_closing(laws.shapes, N_CUTS, 6)
    motions = np.zeros((N_CUTS, 6))
    motions[:, [0, 4, 5]] = -closing
    motions[:, 1:4] = 7.0  # slip and twist crush nothing
    points, weights = points_inside(laws.shapes.corners[: laws.shapes.start[1]], 240)
    at_points = closing[:, :1] + closing[:, 1:2] * points[:, 1] - closing[:, 2:] * points[:, 0]
    expected = laws.strength[0] * (np.maximum(at_points, 0.0) @ weights) - TENSION * closing[:, 0]
    largest = np.abs(at_points).max(axis=1)
    assert np.abs(crushing_power(laws, motions) - expected).max() < 1e-4 * (laws.strength[0] * largest).max()
    assert crushing_power(laws, motions) == pytest.approx(expected, abs=2e-4 * float((laws.strength * largest).min()))
    border = with_moment(at_the_border(name, TENSION), 1.0)
    found = crushing_power(laws, motions)
    assert np.all(-(border @ (motions * [1, 0, 0, 0, 1, 1]).T) <= found * (1 + 1e-12) + 1e-12)


def test_what_cannot_crush_takes_any_power_or_none() -> None:
    laws = laws_of("rectangle", 2)
    laws = type(laws)(**{**vars(laws), "crushable": np.array([False, False])})
    motions = np.zeros((2, 6))
    motions[1, 0] = -1e-9
    assert crushing_power(laws, motions).tolist() == [0.0, np.inf]
    assert np.all(crushing_excess(laws, 1e9 * np.ones((2, 6))) == -np.inf)
