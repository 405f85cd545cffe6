"""Figures of a structure in time, and what a deck expects of them."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mbla.deck.content import Expectation
from mbla.results.exit_status import differences
from mbla.results.history_figures import balance_error, drift_of, history_figures
from mbla.results.notebook.case import Case
from mbla.results.outcome import answer_bounds, answer_of
from mbla.solution.solution import Status
from mbla.solution.time_history.step_rows import HistoryEnd
from tests.results.rocking import peaks, rocking_case, rocks, step_rows
from tests.results.synthetic import tower_results

RESULTS = tower_results()
CASE = rocking_case(RESULTS.cases[0])


def test_what_is_missing_in_the_balance() -> None:
    rows = step_rows()
    assert balance_error(rows) == 0.0
    off = rows.base.copy()
    off[200] += 1e-3 * off.max()
    assert balance_error(replace(rows, base=off)) == pytest.approx(1e-3, rel=1e-6)


def test_drift_is_over_the_height_above_the_lowest_support() -> None:
    figures = history_figures(rocks())
    assert figures is not None
    assert drift_of(RESULTS.assembly, CASE.load_case, figures) == pytest.approx(figures.peak / 2.0)
    loose = replace(CASE.load_case, dead_load=np.zeros((3, 6)))
    assert np.isnan(drift_of(RESULTS.assembly, loose, figures))


def test_the_answer_is_the_peak_and_its_range() -> None:
    assert answer_of(CASE) == pytest.approx(0.0713, abs=1e-4)
    assert answer_bounds(CASE) == pytest.approx((answer_of(CASE), 1.01 * answer_of(CASE)))


def test_for_python_users() -> None:
    case = Case(RESULTS, CASE)
    assert case.verified
    assert case.time_history is not None
    assert case.time_history.peak == answer_of(CASE)
    assert Case(RESULTS, replace(CASE, status=Status.NOT_VERIFIED)).time_history is None


def expected(case: Any = CASE, **wanted: Any) -> list[str]:
    said = {"shaken": Expectation(source="by hand", **wanted)}
    return differences([case], said, RESULTS.model.blocks.name)


def test_what_a_deck_expects() -> None:
    assert expected(peak=0.0713, peak_time=0.4, residual=0.001, falls="none", end="duration", tolerance=0.01) == []
    (off,) = expected(peak=0.0713, tolerance=1e-4)
    assert off.startswith("shaken: peak 0.0712639")
    assert off.endswith(", expected 0.0713 within 0.0001 (by hand)")
    assert expected(residual=0.0012, tolerance=0.01) == []  # of the peak
    assert expected(residual=0.002, tolerance=0.01) != []
    assert expected(falls="tower[0]", end="collapse") == [
        "shaken: falls none, expected tower[0] (by hand)",
        "shaken: end duration, expected collapse (by hand)",
    ]
    fallen = replace(peaks(), falling=np.array([np.nan, 3.4, np.nan]))
    falls = rocking_case(RESULTS.cases[0], peaks=fallen, end=HistoryEnd.COLLAPSE, half=None)
    assert expected(falls, falls="tower[0]", end="collapse") == []
    assert expected(rocking_case(RESULTS.cases[0], end=HistoryEnd.LATE), peak=0.07, end="duration") == [
        "shaken: no peak, expected 0.07 (by hand)",
        "shaken: end not known, expected duration (by hand)",
    ]
