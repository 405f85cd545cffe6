"""Bars, whiskers and words of tornados."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.sweeps.pictures.drawing import draw, names_along, words
from tests.sweeps.pictures.hand_made import sample

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
    axes, right = figures[0].axes
    ranks = np.argsort(np.argsort(MIXED)), np.arange(12)
    of_mixed = -float(np.corrcoef(*ranks)[0, 1])
    assert names_along(axes, "y") == ["mu", "mixed", "same"]
    assert names_along(right, "y") == ["-1.00", f"{of_mixed:+.2f}", "does not vary"]
    assert bars(axes) == pytest.approx([-1.0, of_mixed, 0.0], abs=1e-12)
    ends = whiskers(axes)
    assert set(ends) == {0, 1}  # what does not vary has no interval
    assert ends[1][0] < of_mixed < ends[1][1]
    told = words(figures[0])
    assert "bars: Spearman rank correlation over 12 points with a verified value; whiskers: 95% interval" in told
    assert "no order, so not here: bond" in told
    assert "cannot be told apart" not in told


def test_parameters_of_a_sample_that_go_together_are_told(tmp_path: Path, figures: list[Any]) -> None:
    draw(sample({"mu": UP, "mixed": MIXED, "thickness": UP[::-1]}, lambda mu, mixed, thickness: mu), tmp_path,
         "tornado")  # fmt: skip
    told = words(figures[0])
    assert told.endswith("parameters that go together, so that their bars cannot be told apart: mu with thickness")
