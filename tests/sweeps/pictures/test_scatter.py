"""Points, axes and titles of scatters."""

from pathlib import Path
from typing import Any

import numpy as np

from mbla.results.pictures.page import CASES
from tests.sweeps.drawn import names_in_legend
from tests.sweeps.pictures.drawing import draw, names_along, words
from tests.sweeps.pictures.hand_made import FALLEN, Row, sample

BONDS = ["stack", "running", "flemish"]


def dots(axes: Any) -> list[Any]:
    """Lines of full markers, those of each class together."""
    full = [line for line in axes.lines if line.get_linestyle() == "None" and line.get_markerfacecolor() != "none"]
    return [line for line in full if len(line.get_xdata())]


def test_texts_and_truth_values_are_columns_of_points(tmp_path: Path, figures: list[Any]) -> None:
    """Each point lies within its column, the points of a column at different places; there is no rank correlation."""
    table = sample({"bond": BONDS * 4, "bonded": [True, False] * 6}, lambda bond, bonded: len(bond) + bonded)
    draw(table, tmp_path, "scatter")
    for axes, names, column in zip(figures[0].axes, (BONDS, ["yes", "no"]), ([0, 1, 2] * 4, [0, 1] * 6), strict=True):
        assert names_along(axes, "x") == names
        (points,) = dots(axes)
        assert np.abs(points.get_xdata() - column).max() < 0.3
        assert len(set(points.get_xdata() - column)) == 12
        assert points.get_ydata().tolist() == table["load_factor"].tolist()
        assert axes.get_title() == ""
    assert "rank correlation" not in words(figures[0])


def test_mechanism_classes_have_their_colours(tmp_path: Path, figures: list[Any]) -> None:
    """Those of which a point is seen stand in the legend; what has a value but no class is grey."""
    classes = ["hinging", "sliding", None]

    def solve(mu: float) -> Row:
        if mu == 0:
            return {**FALLEN, "mechanism.class": "mixed"}
        return {"status": "solved", "load_factor": mu, "mechanism.class": classes[int(mu) % 3]}

    draw(sample({"mu": [float(i) for i in range(7)]}, solve), tmp_path, "scatter")
    (axes,) = figures[0].axes
    shown = {line.get_color(): line.get_xdata().tolist() for line in dots(axes)}
    assert shown == {CASES[0]: [3.0, 6.0], CASES[2]: [1.0, 4.0], "#777777": [2.0, 5.0]}
    assert names_in_legend(figures[0]) == ["hinging", "sliding", "no equilibrium (does not stand)"]
