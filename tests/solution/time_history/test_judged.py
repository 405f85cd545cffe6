"""Status of a structure in time, and what a reader of its figures must know."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.deck import read_deck_text
from mbla.model import build_model
from mbla.solution.solution import Status
from mbla.solution.time_history.history import HalfStep, TimeHistoryResult
from mbla.solution.time_history.judged import differs_by_step, judged
from mbla.solution.time_history.remarks import history_remarks
from mbla.solution.time_history.step_rows import HistoryEnd
from tests.results.rocking import asked, rocks, step_rows
from tests.results.synthetic import tower_contacts, tower_model
from tests.solution.time_history.followed import deck_text

MODEL = tower_model()
CASE = replace(MODEL.load_cases[0], time_history=asked())
FOUND = rocks()
PEAK = float(FOUND.peaks.displacements.max()) if FOUND.peaks else 0.0
MOTION = "motion: {pulse: sine, amplitude: 0.3 g, duration: 0.5, direction: x}, step: 0.004"
NOTHING: dict[str, Any] = dict.fromkeys(("rows", "frames", "histories", "peaks", "half"))


def missed(count: int) -> TimeHistoryResult:
    rows = step_rows()
    return replace(FOUND, rows=replace(rows, missed=np.minimum(np.arange(len(rows)), count)))


def halved(peak: float, end: HistoryEnd = HistoryEnd.DURATION) -> HalfStep:
    return HalfStep(peak, 0.4, 0.0, end)


@pytest.mark.parametrize(
    ("found", "status", "reason"),
    [
        (FOUND, Status.SOLVED, ""),
        (replace(FOUND, half=None), Status.SOLVED, ""),
        (missed(0), Status.SOLVED, ""),
        (missed(1), Status.APPROXIMATE, "1 of 432 steps were not solved even when halved four times"),
        (replace(FOUND, half=halved(1.03 * PEAK)), Status.APPROXIMATE, "the greatest displacement changes by 3 %"),
        (replace(FOUND, half=halved(PEAK, HistoryEnd.COLLAPSE)), Status.APPROXIMATE, "half of the step it ends other"),
        (replace(FOUND, end=HistoryEnd.LATE), Status.TIME_LIMIT, "the time limit was reached at 4 of 4 s"),
        (replace(FOUND, end=HistoryEnd.STOPPED), Status.TIME_LIMIT, "the run was stopped at 4 of 4 s"),
        (replace(FOUND, end=HistoryEnd.NO_REST, **NOTHING), Status.NOT_VERIFIED, "no state of rest was found"),
    ],
)
def test_status(found: TimeHistoryResult, status: Status, reason: str) -> None:
    own, why = judged(CASE, found)
    assert own is status
    assert reason in why
    assert bool(reason) == bool(why)


def test_half_of_the_step_that_was_asked_for_and_is_missing() -> None:
    checked = replace(CASE, time_history=replace(asked(), check=True))
    assert judged(checked, FOUND) == (Status.SOLVED, "")
    status, why = judged(checked, replace(FOUND, half=None))
    assert (status, why[:26]) == (Status.APPROXIMATE, "the time limit was reached")


def test_the_peak_of_what_falls_is_not_compared() -> None:
    fallen = replace(FOUND, end=HistoryEnd.COLLAPSE, half=halved(3.0 * PEAK, HistoryEnd.COLLAPSE))
    assert not differs_by_step(fallen)


def test_what_joints_give_anyway_is_no_difference() -> None:
    found = replace(FOUND, sag=100.0 * PEAK, half=halved(2.0 * PEAK))
    assert not differs_by_step(found)
    assert differs_by_step(replace(found, sag=np.nan))


@pytest.mark.parametrize(
    ("found", "identifiers"),
    [
        (replace(FOUND, period=1.0), []),
        (replace(FOUND, period=np.nan), []),
        (FOUND, ["time-history-coarse"]),
        (replace(FOUND, period=1.0, sag=0.01), ["time-history-soft"]),
        (replace(FOUND, end=HistoryEnd.NO_REST, **NOTHING), []),
    ],
)
def test_remarks(found: TimeHistoryResult, identifiers: list[str]) -> None:
    assert [remark.identifier for remark in history_remarks(MODEL, tower_contacts(), CASE, found)] == identifiers


def test_a_few_missed_steps_are_told() -> None:
    rows = step_rows()
    long = {name: np.tile(getattr(rows, name), 3) for name in vars(rows)}
    many = replace(rows, **long | {"missed": np.ones(3 * len(rows), dtype=np.int64)})
    (remark,) = history_remarks(MODEL, tower_contacts(), CASE, replace(FOUND, period=1.0, rows=many))
    assert remark.startswith("1 of 1234 steps were not solved even when halved four times")


@pytest.mark.parametrize("moved", [False, True])
def test_whose_corners_of_soil_they_are(moved: bool) -> None:
    """Other load cases may have moved them, then it is told how to follow it without these."""
    soil = "[{soil: {group: sand, material: stone, width: 1, outline: [[0, 0], [1, 0], [1, 1], [0, 1]]"
    deck = read_deck_text(deck_text(f"{soil}, cells: {{size: 1}}, friction_angle: 33}}}}]", MOTION), Path("deck.yaml"))
    model = build_model(deck)
    model = replace(model, soils=tuple(replace(soil, moved=moved) for soil in model.soils))
    found = replace(FOUND, period=1.0, **NOTHING | {"rows": FOUND.rows})
    (remark,) = history_remarks(model, tower_contacts(), model.load_cases[0], found)
    assert remark.identifier == "time-history-soil"
    assert ("other load cases" in remark) is moved
    assert ("mbla run --case case" in remark) is moved
