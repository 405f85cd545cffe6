"""What is drawn of a trade: numbered points and the front."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.results.pictures.page import BLUE, VERMILION, WARNING
from mbla.sweeps.tradeoff.study import draw_trade
from tests.sweeps.drawn import names_in_legend, places
from tests.sweeps.tradeoff.hand_made import rows_of_a_study, trade_of

pytest.importorskip("matplotlib")


def test_points_are_time_and_distance_and_the_front_is_a_line(tmp_path: Path, figures: list[Any]) -> None:
    draw_trade("A block", trade_of(rows_of_a_study()), "Take what you like.", tmp_path / "trade.png")
    (axes,) = figures[-1].axes
    marks = [line for line in axes.lines if str(line.get_marker()).startswith("$")]
    expected = [(0.8, 2e-5), (2.0, 1e-9), (0.2, 1e-3), (1.5, 4e-5), (0.1, 1e-9)]
    assert [places(line)[0] for line in marks] == pytest.approx(np.array(expected), rel=1e-6)
    assert [line.get_color() for line in marks] == [VERMILION, VERMILION, VERMILION, BLUE, WARNING]
    (front,) = [line for line in axes.lines if line.get_drawstyle() == "steps-post"]
    assert [x for x, _ in places(front)] == [0.2, 0.8, 2.0]
    names = names_in_legend(figures[-1])
    assert names[2:] == [
        *("accuracy: standard", "accuracy: reference", "accuracy: draft", "solver: mbla"),
        "solver: clarabel, not verified",
    ]
