"""Ticks of axes and marks of points, as all diagrams have them."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.sweeps.drawn import names_in_legend
from tests.sweeps.pictures.drawing import draw, lines_with, names_along
from tests.sweeps.pictures.hand_made import FAILED, Row, grid, sphere


def test_a_range_of_equal_ratios_has_a_log_axis_with_its_values(tmp_path: Path, figures: list[Any]) -> None:
    draw(grid({"k": [1e6, 1e7, 1e8]}, lambda k: k), tmp_path, "curve")
    (axes,) = figures[0].axes
    assert axes.get_xscale() == "log"
    assert axes.get_xticks().tolist() == [1e6, 1e7, 1e8]
    assert names_along(axes, "x") == ["1e+06", "1e+07", "1e+08"]


@pytest.mark.parametrize(
    ("values", "named"),
    [
        ([0.1, 0.2, 0.4], ["0.1", "0.2", "0.4"]),
        ([0.1, 0.1001, 0.4], None),  # two names would lie over each other
        ([0.1, 0.20001, 0.4], None),  # which has no name of four digits
    ],
)
def test_ticks_stand_at_values_whose_names_have_room_and_are_exact(
    tmp_path: Path, figures: list[Any], values: list[float], named: list[str] | None
) -> None:
    draw(grid({"mu": values}, lambda mu: mu), tmp_path, "curve")
    (axes,) = figures[0].axes
    if named is not None:
        assert axes.get_xticks().tolist() == values
        assert names_along(axes, "x") == named
    else:
        steps = np.diff(axes.get_xticks())
        assert steps == pytest.approx(steps[0])
        assert len(steps) > 3


def test_a_value_that_is_not_verified_is_marked_at_its_place(tmp_path: Path, figures: list[Any]) -> None:
    def solve(mu: float) -> Row:
        return {"status": "not_verified" if mu == 2 else "solved", "load_factor": 10 * mu}

    draw(grid({"mu": [1.0, 2.0, 3.0]}, solve), tmp_path, "curve")
    (axes,) = figures[0].axes
    (mark,) = lines_with(axes, "o")
    assert mark.get_data()[0].tolist() == [2.0]
    assert mark.get_data()[1].tolist() == [20.0]
    (line,) = [line for line in axes.lines if len(line.get_xdata()) == 3]
    assert np.array_equal(line.get_ydata(), [10.0, np.nan, 30.0], equal_nan=True)
    assert names_in_legend(figures[0]) == ["not verified"]


def test_a_median_that_holds_whatever_failed_is_drawn_and_marked(tmp_path: Path, figures: list[Any]) -> None:
    """Of three points of mu 2 two have the same value: whatever the third would have, it is the median."""
    table = sphere([(0.0, 0.0), (120.0, 0.0), (240.0, 0.0)], {"mu": [1.0, 2.0]},
                   lambda to_azimuth, to_elevation, mu: FAILED if mu == 2 and to_azimuth == 240 else mu)  # fmt: skip
    draw(table, tmp_path, "curve")
    (axes,) = figures[0].axes
    (mark,) = lines_with(axes, "o")
    assert mark.get_data()[0].tolist() == mark.get_data()[1].tolist() == [2.0]
    assert names_in_legend(figures[0]) == ["some points without a verified value"]
