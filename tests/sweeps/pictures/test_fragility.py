"""Shares of records that reach limits over their scale, with intervals and curves, as they are drawn."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.errors import UsageError
from mbla.sweeps.fragility import fragility_of
from mbla.sweeps.fragility_curve import fragility_curves, probability
from mbla.sweeps.pictures.plot import Fragility, SweepPictures, pictures_of
from mbla.sweeps.tables.sweep_table import SweepTable
from tests.sweeps.drawn import names_in_legend
from tests.sweeps.pictures.drawing import draw, words
from tests.sweeps.test_fragility_in_time import FALLS, SCALES, TABLE, asked, moves, shaken


def known(table: SweepTable, **changes: Any) -> Fragility:
    what = asked(table, **changes)
    return Fragility(tuple(fragility_of(table, what)), tuple(fragility_curves(table, what)))


def test_shares_intervals_and_curves(tmp_path: Path, figures: list[Any]) -> None:
    draw(TABLE, tmp_path, "fragility", known=known(TABLE))
    (axes,) = figures[0].axes
    marks = [line for line in axes.lines if line.get_linestyle() == "None" and len(line.get_xdata()) == len(SCALES)]
    shares = [line.get_ydata().tolist() for line in marks if line.get_marker() in ("o", "s")]
    assert shares == [[0.25, 0.5, 0.875], [0.0, 0.25, 0.625]]
    (first, second) = fragility_curves(TABLE, asked(TABLE))
    curves = [line for line in axes.lines if line.get_linestyle() == "-"]
    for line, curve in zip(curves, (first, second), strict=True):
        expected = probability(np.asarray(line.get_xdata()), curve["median"], curve["dispersion"])
        assert line.get_ydata().tolist() == pytest.approx(expected.tolist())
    assert names_in_legend(figures[0]) == ["0.1 m", "falls"]
    assert axes.get_xlabel() == "scale"
    assert "values of a list, each counted alike" in words(figures[0])


def test_a_step_has_no_line(tmp_path: Path, figures: list[Any]) -> None:
    table = shaken([[moves(0.01)] * 3, [FALLS] * 3], scales=(1.0, 2.0))
    draw(table, tmp_path, "fragility", known=known(table, limits=("falls",)))
    assert not [line for line in figures[0].axes[0].lines if line.get_linestyle() == "-"]
    assert "no line where no point reaches the limit" in words(figures[0])


def test_the_result_of_the_fragility_is_drawn_unless_another_is_asked_for() -> None:
    names = [picture.name for picture in pictures_of(TABLE, SweepPictures(known=known(TABLE)))]
    assert names == [f"{kind}_time_history.peak" for kind in ("curve", "map", "fragility")]


def test_without_limits_over_a_parameter_there_is_none() -> None:
    with pytest.raises(UsageError, match="asks for no fragility of limits over a parameter"):
        pictures_of(TABLE, SweepPictures(("fragility",), result="time_history.peak", known=known(TABLE, over=None)))
