"""Points, axes and titles of scatters."""

from pathlib import Path
from typing import Any

from tests.sweeps.pictures.drawing import draw, names_along, words
from tests.sweeps.pictures.hand_made import sample

BONDS = ["stack", "running", "flemish"]


def dots(axes: Any) -> list[Any]:
    """Lines of full markers, those of each class together."""
    full = [line for line in axes.lines if line.get_linestyle() == "None" and line.get_markerfacecolor() != "none"]
    return [line for line in full if len(line.get_xdata())]


def test_texts_and_truth_values_are_columns_of_points(tmp_path: Path, figures: list[Any]) -> None:
    """Each point lies in its column; there is no rank correlation."""
    table = sample({"bond": BONDS * 4, "bonded": [True, False] * 6}, lambda bond, bonded: len(bond) + bonded)
    draw(table, tmp_path, "scatter")
    for axes, names, column in zip(figures[0].axes, (BONDS, ["yes", "no"]), ([0, 1, 2] * 4, [0, 1] * 6), strict=True):
        assert names_along(axes, "x") == names
        (points,) = dots(axes)
        assert points.get_xdata().tolist() == column
        assert points.get_ydata().tolist() == table["load_factor"].tolist()
        assert axes.get_title() == ""
    assert "rank correlation" not in words(figures[0])
