"""What is drawn of a diagram made by hand: curves, polygons, edges of the diagram and marks at them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.sweeps.interaction.question import DIRECTION, TWO_LOADS
from mbla.sweeps.interaction.study import ROOM
from tests.sweeps.drawn import names_in_legend, places
from tests.sweeps.interaction.hand_made import both_bounds, made
from tests.sweeps.interaction.test_study_result import FREE

pytest.importorskip("matplotlib")
SAFE = "safe by static bounds (associative flow)"
BOUND = "bound by mechanisms (associative flow)"
FACTOR = "load factor, associative flow"


def drawn(folder: Path, figures: list[Any], *diagram: Any) -> Any:
    """The figure of a diagram."""
    made(folder, *diagram).study.pictures["interact"](folder / "diagram.png")
    return figures[-1]


def test_of_two_loads_the_factors_are_the_coordinates(tmp_path: Path, figures: list[Any]) -> None:
    figure = drawn(tmp_path, figures, TWO_LOADS, [0.4, 0.3, 0.25])
    (axes,) = figure.axes
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("factor of push", "factor of top")
    (curve,) = [line for line in axes.lines if line.get_marker() == "o"]
    corners = [(0.4, 0.0), (0.3 * np.sqrt(0.5), 0.3 * np.sqrt(0.5)), (0.0, 0.25)]
    assert places(curve) == pytest.approx(np.array(corners), abs=1e-15)
    assert axes.get_xlim() == pytest.approx((-0.02 * ROOM * 0.4, ROOM * 0.4))
    assert axes.get_ylim() == pytest.approx((-0.02 * ROOM * 0.25, ROOM * 0.25))
    safe = [(float(x), float(y)) for x, y in axes.patches[0].get_xy()[:-1]]  # the last corner is the first
    assert sorted(safe) == pytest.approx(np.array(sorted([(0.0, 0.0), *corners])), abs=1e-15)
    assert names_in_legend(figure) == [SAFE, BOUND, FACTOR]


def test_what_never_collapses_is_marked_at_the_edge_and_no_line_leads_to_it(tmp_path: Path, figures: list[Any]) -> None:
    figure = drawn(tmp_path, figures, TWO_LOADS, [0.4, 0.3, 0.25], {1: FREE})
    (mark,) = [line for line in figure.axes[0].lines if line.get_marker() == "^"]
    assert places(mark) == pytest.approx(np.array([(ROOM * 0.25, ROOM * 0.25)]), abs=1e-12)
    assert "unbounded (no collapse)" in names_in_legend(figure)
    (curve,) = [line for line in figure.axes[0].lines if line.get_marker() == "o"]
    assert np.isnan(np.array(places(curve))[1]).all()


def test_on_bounds_that_contradict_each_other_nothing_is_called_safe(tmp_path: Path, figures: list[Any]) -> None:
    figure = drawn(tmp_path, figures, DIRECTION, [0.5] * 6, {0: both_bounds(1.5)})
    assert "ERROR OF VERIFICATION: bounds contradict each other" in [text.get_text() for text in figure.texts]
    assert SAFE not in names_in_legend(figure)
    assert not figure.axes[0].patches
    assert BOUND in names_in_legend(figure)
