"""What is drawn of a trade: points, front, names beside them, and what is told where nothing can be drawn."""

from __future__ import annotations

from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import GHOST, VERMILION
from mbla.sweeps.tradeoff.picture import draw_trade, label_places
from mbla.sweeps.tradeoff.trade import Row
from tests.sweeps.drawn import places
from tests.sweeps.tradeoff.hand_made import ladder, row, trade_of

pytest.importorskip("matplotlib")


def drawn(folder: Path, figures: list[Any], runs: list[Row], **page: Any) -> Any:
    """The figure of a study of one load case."""
    draw_trade(folder / "trade.png", "A block", trade_of(runs), "Take what you like.", PictureOptions(**page))
    return figures[-1]


def told(figure: Any) -> str:
    return " ".join(" ".join(text.get_text() for text in figure.texts).split())


def test_points_are_time_and_distance_and_the_front_is_a_line(tmp_path: Path, figures: list[Any]) -> None:
    figure = drawn(tmp_path, figures, ladder())
    (axes,) = figure.axes
    marks = {line.get_label(): places(line) for line in axes.lines if line.get_linestyle() == "None"}
    assert marks["Pareto front"] == pytest.approx(np.array([(0.8, 2e-5), (2.0, 1e-9), (0.2, 1e-3)]), rel=1e-6)
    assert marks["verified"] == pytest.approx(np.array([(1.5, 4e-5)]), rel=1e-6)
    assert marks["not verified"] == [(0.1, 1e-9)]
    (front,) = [line for line in axes.lines if line.get_drawstyle() == "steps-post"]
    assert (front.get_color(), [x for x, _ in places(front)]) == (VERMILION, [0.2, 0.8, 2.0])
    names = {text.get_text(): text.get_weight() for text in axes.texts}
    assert names["accuracy: draft"] == "bold"
    assert names["solver: mbla"] == "normal"
    assert "not drawn, as their difference is no error: flow_rule: associative" in told(figure)


def crowd(count: int) -> list[Row]:
    """A reference, and runs that are all as fast and as near as each other."""
    return [
        row("accuracy: reference", 0.5, 2.0),
        *(row(f"tolerance: 1e-{i}", 0.50001, 0.5) for i in range(count)),
    ]


def test_a_name_that_went_far_is_joined_to_its_point(tmp_path: Path, figures: list[Any]) -> None:
    (axes,) = drawn(tmp_path, figures, crowd(6)).axes
    leaders = [line for line in axes.lines if line.get_color() == GHOST and line.get_linestyle() == "-"]
    assert 0 < len(leaders) < 6
    for line in leaders:
        assert places(line)[0] == pytest.approx((0.5, 2e-5), rel=1e-6)
    assert len(axes.texts) == 7


def test_a_name_without_room_is_left_out(tmp_path: Path, figures: list[Any]) -> None:
    """The point is there all the same."""
    runs = [*crowd(3), row("one knob after the other " * 8, 0.5002, 0.7)]
    (axes,) = drawn(tmp_path, figures, runs, size=(500, 400)).axes
    names = [text.get_text() for text in axes.texts]
    assert not [name for name in names if name.startswith("one knob")]
    assert "accuracy: reference" in names
    points = [place for line in axes.lines if line.get_linestyle() == "None" for place in places(line)]
    assert any(place == pytest.approx((0.7, 4e-4), rel=1e-6) for place in points)


FRAME = shapely.box(0.0, 0.0, 1000.0, 600.0)


def test_crowded_points_get_labels_apart() -> None:
    points = [(500.0 + 7.0 * place, 300.0) for place in range(10)] + [(995.0, 5.0), (2.0, 598.0)]
    boxes = label_places(points, [(120.0, 16.0)] * len(points), FRAME, 5.0)
    assert all(box is not None and box.within(FRAME) for box in boxes)
    assert all(one.intersection(two).area == 0.0 for one, two in combinations(boxes, 2))  # type: ignore[union-attr]
    marks = [shapely.box(x - 5.0, y - 5.0, x + 5.0, y + 5.0) for x, y in points]
    assert all(box.intersection(mark).area == 0.0 for box in boxes for mark in marks)  # type: ignore[union-attr]
