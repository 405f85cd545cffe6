"""Ticks of axes and marks of points, as all diagrams have them."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.sweeps.pictures.drawing import draw, names_along
from tests.sweeps.pictures.hand_made import grid


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
