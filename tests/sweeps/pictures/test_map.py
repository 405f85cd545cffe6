"""Cells of maps."""

from pathlib import Path
from typing import Any

import pytest

from tests.sweeps.drawn import names_in_legend
from tests.sweeps.pictures.drawing import draw, words
from tests.sweeps.pictures.hand_made import FAILED, Row, grid


def mechanism(name: str) -> Row:
    return {"status": "solved", "load_factor": 1.0, "mechanism.class": name}


def test_cells_of_several_points_are_their_median(tmp_path: Path, figures: list[Any]) -> None:
    levels = {"mu": [1.0, 2.0, 3.0], "thickness": [1.0, 2.0, 3.0], "height": [1.0, 2.0], "width": [1.0, 2.0]}
    draw(grid(levels, lambda mu, thickness, height, width: 100 * mu + 10 * thickness + height + width / 10), tmp_path,
         "map")  # fmt: skip
    low, high, _ = figures[0].axes
    assert [axes.get_title() for axes in (low, high)] == ["height 1", "height 2"]
    shown = [100 * mu + 10 * thickness + 1.15 for thickness in (1, 2, 3) for mu in (1, 2, 3)]
    assert low.collections[0].get_array().ravel().tolist() == pytest.approx(shown, rel=1e-12)
    assert "cell: median of up to 2 points of the other parameters" in words(figures[0])


def test_cells_of_several_classes_are_their_class_where_it_is_one(tmp_path: Path, figures: list[Any]) -> None:
    """With mu 1 both widths slide, with mu 2 one of them hinges, with mu 3 neither has a class."""

    def solve(mu: float, thickness: float, height: float, width: float) -> Row:
        return FAILED if mu == 3 else mechanism("hinging" if (mu, width) == (2, 2) else "sliding")

    levels = {"mu": [1.0, 2.0, 3.0], "thickness": [1.0, 2.0, 3.0], "height": [1.0, 2.0], "width": [1.0, 2.0]}
    draw(grid(levels, solve), tmp_path, "map", result="mechanism.class")
    shown = figures[0].axes[0].collections[0].get_array()
    assert shown.tolist() == [[1.0, None, None]] * 3
    assert names_in_legend(figures[0]) == ["sliding", "failed", "different from point to point"]
