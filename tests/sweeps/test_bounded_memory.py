"""Memory over a sweep of 10,000 points of one block, of 1,000 by the long tests: processes of points do not grow."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.trust.watching import POINTS, watched

SOME = 1_000
GROWTH = 0.05
"""of the processes of points, whose structures to be shared are bounded in number and size"""
KILOBYTES = 6.0
"""that the command may keep of each point, its answers and the values that were set, until the table is written"""


@pytest.mark.parametrize(
    "points", [pytest.param(SOME, marks=pytest.mark.long), pytest.param(POINTS, marks=pytest.mark.trust)]
)
@pytest.mark.parametrize("workers", [1, 2])
def test_thousands_of_points(tmp_path: Path, workers: int, points: int) -> None:
    found = watched(tmp_path, points, workers)
    assert len(found.begun) == workers  # none was replaced because it had grown
    assert found.last(found.points) < (1.0 + GROWTH) * found.first(found.points)
    assert 0.0 < found.kilobytes_per_point < KILOBYTES
