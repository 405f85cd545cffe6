"""Cumulative curves with their bands, and how they are drawn."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.errors import UsageError
from mbla.sweeps.answers import answers_of
from mbla.sweeps.pictures.distribution import cumulative
from mbla.sweeps.pictures.plot import SweepPictures, pictures_of
from mbla.sweeps.pictures.view import chosen_results
from mbla.sweeps.tables.sweep_table import SweepTable
from tests.sweeps.drawn import names_in_legend
from tests.sweeps.pictures.drawing import draw, words
from tests.sweeps.pictures.hand_made import FAILED, FALLEN, UNBOUNDED, Row, grid, sample, table_of


def test_the_band_holds_the_whole_curve_as_often_as_it_says() -> None:
    """Of uniform numbers, whose curve is the diagonal; the inequality promises at least 95 %: 300 samples, 3σ below."""
    rng, held = np.random.default_rng(3), 0
    for _ in range(300):
        table = sample({"mu": list(rng.uniform(size=50))}, lambda mu: mu)
        found = cumulative(answers_of(table, chosen_results(table, None)[0]), np.ones(50, dtype=bool))
        before = np.concatenate([[found.high[0] - 1 / 50], found.high[:-1]])  # up to a value the curve is the earlier
        held += bool(np.all(found.low <= found.values) and np.all(found.values <= np.maximum(before, 0)))
    assert held / 300 > 0.95 - 3 * np.sqrt(0.95 * 0.05 / 300)


def test_what_does_not_stand_lies_below_and_what_nothing_brings_down_above() -> None:
    answers: list[Row | float] = [FALLEN, 0.2, 0.4, UNBOUNDED]
    table = sample({"mu": [0.0, 1.0, 2.0, 3.0]}, lambda mu: answers[int(mu)])
    found = cumulative(answers_of(table, chosen_results(table, None)[0]), np.ones(4, dtype=bool), band=False)
    assert found.share.tolist() == pytest.approx([0.5, 0.75])
    assert (found.below, found.above, found.unknown) == (1, 1, 0)


def test_a_failed_point_may_lie_anywhere() -> None:
    answers: list[Row | float] = [0.2, 0.4, FAILED, 0.6]
    table = sample({"mu": [0.0, 1.0, 2.0, 3.0]}, lambda mu: answers[int(mu)])
    found = cumulative(answers_of(table, chosen_results(table, None)[0]), np.ones(4, dtype=bool), band=False)
    assert found.low.tolist() == pytest.approx([0.25, 0.5, 0.75])
    assert found.high.tolist() == pytest.approx([0.5, 0.75, 1.0])
    assert found.share.tolist() == pytest.approx([1 / 3, 2 / 3, 1.0])


def test_curves_of_a_grid_are_shares_of_its_points(tmp_path: Path, figures: list[Any]) -> None:
    levels = {"thickness": [0.1, 0.2], "mu": [1.0, 2.0, 3.0, 4.0]}
    draw(grid(levels, lambda thickness, mu: mu + 10 * thickness), tmp_path, "distribution", by="thickness")
    _, lower = figures[0].axes
    curves = [line for line in lower.lines if line.get_drawstyle() == "steps-post"]
    assert [line.get_xdata().tolist() for line in curves] == [[2.0, 2.0, 3.0, 4.0, 5.0], [3.0, 3.0, 4.0, 5.0, 6.0]]
    assert [line.get_ydata().tolist() for line in curves] == [[0.0, 0.25, 0.5, 0.75, 1.0]] * 2
    assert lower.get_ylabel() == "share of the points"
    assert names_in_legend(figures[0]) == ["thickness 0.1 m", "thickness 0.2 m"]
    assert "points of no random sample: shares of the points, no probabilities" in words(figures[0])


def over_heights(heights: int, solve: Any) -> SweepTable:
    """Twenty random values of mu at each height."""
    mu = np.linspace(0.05, 1.0, 20).tolist()
    rows = [{"height": float(height), "mu": value} for height in range(heights) for value in mu]
    places = [(i, j) for i in range(heights) for j in range(20)]
    return table_of(rows, solve, [("height", heights), ("random", 20)], places, {"height": "height", "mu": "random"},
                    samples="random", sampling="random")  # fmt: skip


@pytest.mark.parametrize(
    ("swept", "changes", "told"),
    [
        (over_heights(13, lambda height, mu: mu), {},
         "13 combinations of the other parameters; 12 have room, choose one with --by"),
        (over_heights(2, lambda height, mu: mu), {"result": "mechanism.class"},
         "the result is text"),
    ],
)  # fmt: skip
def test_what_is_not_drawn_is_refused_with_the_reason(swept: SweepTable, changes: Any, told: str) -> None:
    with pytest.raises(UsageError, match=told):
        pictures_of(swept, SweepPictures(("distribution",), **changes))
