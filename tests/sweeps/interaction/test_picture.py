"""What is drawn of a study made by hand: curves, polygons, edges of the diagram and marks at them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.sweeps.interaction.domain import Point
from mbla.sweeps.interaction.picture import ROOM, draw_study
from mbla.sweeps.interaction.question import TWO_LOADS
from tests.sweeps.drawn import names_in_legend, places
from tests.sweeps.interaction.hand_made import around, point, study

pytest.importorskip("matplotlib")
NAN = float("nan")
NO_FIGURE: dict[str, Any] = {
    "load_factor": NAN, "associative": NAN, "static_bound": NAN, "kinematic_bound": NAN, "powers": {},
}  # fmt: skip
SAFE = "safe by static bounds (associative flow)"
BOUND = "bound by mechanisms (associative flow)"
FACTOR = "load factor, associative flow"


def free(angle: float) -> Point:
    """A ray on which nothing brings collapse."""
    return replace(point(angle), exit_code=5, status="unbounded", **NO_FIGURE)


def late(angle: float) -> Point:
    """A point that was stopped."""
    return replace(point(angle), answered=False, exit_code=7, status="", standing="",
                   reason="stopped after 3 s", **NO_FIGURE)  # fmt: skip


def drawn(folder: Path, figures: list[Any], points: Sequence[Point], *kind: str) -> Any:
    """The figure of a study."""
    draw_study(folder / "diagram.png", study(points, *kind))
    return figures[-1]


def test_of_two_loads_the_factors_are_the_coordinates(tmp_path: Path, figures: list[Any]) -> None:
    points = [point(0.0, 0.4), point(45.0, 0.3), point(90.0, 0.25)]
    figure = drawn(tmp_path, figures, points, TWO_LOADS)
    (axes,) = figure.axes
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("factor of A", "factor of B")
    (curve,) = [line for line in axes.lines if line.get_linestyle() == "-" and len(line.get_xdata()) == 3]
    corners = [(0.4, 0.0), (0.3 * np.sqrt(0.5), 0.3 * np.sqrt(0.5)), (0.0, 0.25)]
    assert places(curve) == pytest.approx(np.array(corners), abs=1e-15)
    assert axes.get_xlim() == pytest.approx((-0.02 * ROOM * 0.4, ROOM * 0.4))
    assert axes.get_ylim() == pytest.approx((-0.02 * ROOM * 0.25, ROOM * 0.25))
    safe = [(float(x), float(y)) for x, y in axes.patches[0].get_xy()[:-1]]  # the last corner is the first
    assert sorted(safe) == pytest.approx(np.array(sorted([(0.0, 0.0), *corners])), abs=1e-15)
    assert names_in_legend(figure) == [SAFE, BOUND, FACTOR]


@pytest.mark.parametrize(
    ("angle", "place"),
    [
        (45.0, (ROOM * 0.25, ROOM * 0.25)),  # at the upper edge, which is nearer than the right one
        (90.0, (0.0, ROOM * 0.25)),
    ],
)
def test_what_never_collapses_is_marked_at_the_edge(
    tmp_path: Path, figures: list[Any], angle: float, place: tuple[float, float]
) -> None:
    points = {0.0: point(0.0, 0.4), 90.0: point(90.0, 0.25), 120.0: point(120.0, 0.25 / np.sin(np.radians(120)))}
    points = {**{key: one for key, one in points.items() if key != angle}, angle: free(angle)}
    figure = drawn(tmp_path, figures, [points[key] for key in sorted(points)], TWO_LOADS)
    (mark,) = [line for line in figure.axes[0].lines if line.get_marker() == "^"]
    assert places(mark) == pytest.approx(np.array([place]), abs=1e-12)
    assert "never collapses (at the rim)" in names_in_legend(figure)


@pytest.mark.parametrize(
    ("doubt", "told"),
    [
        (False, "ERROR OF VERIFICATION: bounds contradict each other"),
        (True, "ERROR OF VERIFICATION: bounds contradict each other; NOT VERIFIED at 1 point of 6"),
    ],
)
def test_on_bounds_that_contradict_each_other_nothing_is_called_safe(
    tmp_path: Path, figures: list[Any], doubt: bool, told: str
) -> None:
    points = around(6)
    points[0] = replace(points[0], static_bound=1.5, kinematic_bound=1.5)
    points[3] = late(180.0) if doubt else points[3]
    figure = drawn(tmp_path, figures, points)
    assert told in [text.get_text() for text in figure.texts]
    assert SAFE not in names_in_legend(figure)
    assert not figure.axes[0].patches
    assert BOUND in names_in_legend(figure)
