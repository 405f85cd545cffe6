"""Sensitivities against closed forms, and how tornados draw them."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.stats import spearmanr

from mbla.sweeps.pictures.tornado import correlation, swing
from mbla.sweeps.pictures.view import View, axis_of, chosen_results, column_by_name, view_of
from tests.sweeps.pictures.drawing import draw, names_along, words
from tests.sweeps.pictures.hand_made import FAILED, grid, sample

UP = list(np.linspace(0.1, 0.9, 12))
MIXED = [0.1 * ((5 * i) % 12) for i in range(12)]
"""of no rank correlation with UP worth a name: 5 i modulo 12"""


def bars(axes: Any) -> list[float]:
    return [bar.get_width() for bar in axes.patches]


def whiskers(axes: Any) -> dict[float, list[float]]:
    """Ends by row."""
    return {line.get_ydata()[0]: list(line.get_xdata()) for line in axes.lines if line.get_marker() == "|"}


def test_bars_of_a_sample_are_rank_correlations_with_their_interval(tmp_path: Path, figures: list[Any]) -> None:
    table = sample({"mixed": MIXED, "mu": UP, "same": [2.0] * 12, "bond": ["stack", "running"] * 6},
                   lambda mixed, mu, same, bond: -mu)  # fmt: skip
    draw(table, tmp_path, "tornado")
    (axes,) = figures[0].axes
    ranks = np.argsort(np.argsort(MIXED)), np.arange(12)
    of_mixed = -float(np.corrcoef(*ranks)[0, 1])
    assert names_along(axes, "y") == ["mu\n-1.00", f"mixed\n{of_mixed:+.2f}", "same\ndoes not vary"]
    assert bars(axes) == pytest.approx([-1.0, of_mixed, 0.0], abs=1e-12)
    ends = whiskers(axes)
    assert set(ends) == {0, 1}  # what does not vary has no interval
    assert ends[1][0] < of_mixed < ends[1][1]
    told = words(figures[0])
    assert "12 points: 12 with a verified value bars: Spearman rank correlation" in told


def view(table: object) -> View:
    return view_of(table, chosen_results(table, None)[0])  # type: ignore[arg-type]


def test_rank_correlation_is_that_of_scipy() -> None:
    rng = np.random.default_rng(1)
    mu = np.round(rng.normal(size=60), 1)  # equal values too
    table = sample({"mu": list(mu)}, lambda mu: round(mu + rng.normal(), 1))
    found = correlation(view(table), column_by_name(table, "mu"))
    assert found.value == pytest.approx(spearmanr(mu, table["load_factor"]).statistic, rel=1e-12)


def test_the_interval_holds_the_true_value_as_often_as_it_says() -> None:
    """Rank correlation of normal variables of correlation r is 6/π asin(r/2) (Pearson 1907).

    Of 400 samples a share of 0.95 ± 0.011 (one standard deviation) holds it; three of them are allowed.
    """
    rng, r, held = np.random.default_rng(7), 0.6, 0
    true = 6 / np.pi * np.arcsin(r / 2)
    for _ in range(400):
        x = rng.normal(size=40)
        y = iter(r * x + np.sqrt(1 - r * r) * rng.normal(size=40))
        table = sample({"mu": list(x)}, lambda mu, y=y: next(y))
        found = correlation(view(table), column_by_name(table, "mu"))
        held += found.low <= true <= found.high
    assert abs(held / 400 - 0.95) < 0.033


def test_swings_of_a_product() -> None:
    """mu t over mu in {1, 2, 4}, t in {1, 3}: changes 3 t of mu, 2 mu of t."""
    table = grid({"mu": [1.0, 2.0, 4.0], "thickness": [1.0, 3.0]}, lambda mu, thickness: mu * thickness)
    mu, thickness = (swing(view(table), axis_of(table, column_by_name(table, name))) for name in ("mu", "thickness"))
    assert (mu.value, mu.low, mu.high, mu.size) == (6.0, 3.0, 9.0, 6.0)
    assert thickness.value == pytest.approx(14 / 3)
    assert (thickness.low, thickness.high) == (2.0, 8.0)


def test_combinations_with_a_failed_point_are_left_out() -> None:
    table = grid({"mu": [1.0, 2.0], "thickness": [1.0, 3.0]},
                 lambda mu, thickness: FAILED if mu == 2 and thickness == 3 else mu * thickness)  # fmt: skip
    found = swing(view(table), axis_of(table, column_by_name(table, "mu")))
    assert (found.value, found.words) == (1.0, "+1, range 1 over 1 of 2 combinations")


def test_what_solvers_leave_open_is_no_effect() -> None:
    """A wall that slides at 0.65 whatever its length is: results that differ in the ninth digit rank by chance."""
    noise = iter(1e-9 * np.random.default_rng(3).normal(size=40))
    table = sample({"length": list(np.linspace(1, 2, 40))}, lambda length: 0.65 + next(noise))
    assert np.isnan(correlation(view(table), column_by_name(table, "length")).value)
    noise = iter(1e-9 * np.random.default_rng(3).normal(size=6))
    table = grid({"length": [1.0, 2.0, 3.0], "mu": [0.5, 0.6]}, lambda length, mu: mu + next(noise))
    found = swing(view(table), axis_of(table, column_by_name(table, "length")))
    assert (found.value, found.size) == (0.0, 0.0)
