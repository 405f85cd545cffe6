"""Parts of surfaces that carry a force without tension, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.solution.modes.carrying_part import carrying_part
from mbla.solution.modes.polygons import moments_of

BREADTH, WIDTH = 1.0, 0.4
CORNERS = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]) * [BREADTH / 2.0, WIDTH / 2.0]


def part(*eccentricity: float) -> FloatArray:
    found = carrying_part(CORNERS, np.array(eccentricity), 1e-3)
    assert found is not None
    return found


@pytest.mark.parametrize(("e", "strip"), [(0.1, 1.0), (0.2, 0.9), (0.3, 0.6), (0.45, 0.15), (0.49, 0.03)])
def test_a_strip_of_three_times_the_distance_from_the_edge(e: float, strip: float) -> None:
    """A triangle of pressure has its middle at a third of its length."""
    assert np.ptp(part(e, 0.0)[:, 0]) == pytest.approx(strip, rel=1e-6)


def test_a_corner_of_four_times_the_distance_from_both_edges() -> None:
    """A pyramid of pressure over a right triangle has its middle at a quarter of its legs."""
    found = part(0.45, 0.15)
    assert moments_of(found, np.array([0, len(found)]))[0, 0] == pytest.approx(0.5 * 0.2 * 0.2, rel=1e-6)


def test_on_the_edge_none_carries() -> None:
    assert carrying_part(CORNERS, np.array([0.4995, 0.0]), 1e-3) is None
