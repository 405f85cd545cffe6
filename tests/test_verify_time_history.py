"""``mbla verify`` on a structure in time: what is changed, left out or of another deck, and what ``--again`` adds."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mbla.process.run_options import RunOptions
from mbla.results.results import Results
from mbla.run import run
from mbla.solution.solution import Status
from mbla.solution.time_history.history import NO_HISTORY, HalfStep, TimeHistoryResult
from mbla.solution.time_history.step_rows import HistoryEnd
from mbla.verify import verify_file
from tests.line import HEAD
from tests.results.changed_files import written

ROCKS = (
    HEAD
    + """\
parameters: {scale: 1}
joints: {dry: {friction: 0.7}, smooth: {friction: 0.2}}
blocks:
  - box: {group: block, material: stone, min: [0, 0, 0], max: [0.2, 0.5, 1]}
supports: [{ground: {z: 0}}]
load_cases:
  quake:
    time_history:
      motion: {file: push.csv, columns: [t, a], unit: m/s2, direction: [1, 0, 0], scale: "=scale"}
      duration: 0.4
      step: 0.004
      record: {every: 0.02, points: {top: {on: block, at: [0.2, 0.5, 1]}}}
"""
)
Change = Callable[[TimeHistoryResult], TimeHistoryResult]


def run_of(folder: Path, more: str = "", *overrides: str) -> Results:
    (deck := folder / "deck.yaml").write_text(ROCKS + more, encoding="utf-8")
    (folder / "push.csv").write_text("t,a\n0,0\n0.002,4\n0.1,4\n0.102,-2\n0.3,-2\n0.302,0\n", encoding="utf-8")
    return run(deck, RunOptions(overrides=overrides, force=True))


@pytest.fixture(scope="module")
def rocks(tmp_path_factory: pytest.TempPathFactory) -> Results:
    """A block that rocks once under a record."""
    return run_of(tmp_path_factory.mktemp("rocks"))


def forged(results: Results, change: Change, status: Status | None = None) -> Results:
    """The results with another time history, and all else as the run told it."""
    (case,) = results.cases
    solution = case.solution
    further = replace(solution.further, time_history=change(solution.further.time_history))
    told = case.status if status is None else status
    case = replace(case, solution=replace(solution, further=further, status=told), status=told)
    return replace(results, cases=(case,))


def said_of(folder: Path, results: Results, *, anew: bool = False) -> tuple[Results, str]:
    """What verification finds, and what it says: that something differs, or is not confirmed."""
    found, differences = verify_file(written(folder, results), anew=anew)
    return found, "; ".join([*(f"differs: {each}" for each in differences), *found.unconfirmed])


def test_a_time_history_as_it_was_made_is_agreed_with(rocks: Results, tmp_path: Path) -> None:
    assert rocks.exit_code == 0
    for anew in (False, True):
        found, said = said_of(tmp_path, rocks, anew=anew)
        assert said == ""
        assert found.exit_code == 0
        assert found.cases[0].status is Status.SOLVED


def of_frames(name: str, by: float) -> Change:
    """An array of the frames changed by a share."""

    def change(result: TimeHistoryResult) -> TimeHistoryResult:
        assert result.frames is not None
        values = getattr(result.frames, name) * (1.0 + by)
        return replace(result, frames=replace(result.frames, **{name: values}))

    return change


@pytest.mark.parametrize(
    ("change", "identifier"),
    [
        (of_frames("forces", 0.01), "time-momentum"),
        (of_frames("base", 1e-3), "time-base"),
    ],
    ids=["forces", "base"],
)
def test_what_is_forged_is_not_verified(change: Change, identifier: str, rocks: Results, tmp_path: Path) -> None:
    found, said = said_of(tmp_path, forged(rocks, change))
    (case,) = found.cases
    assert identifier in [failure.identifier for failure in case.checks.failures]
    assert case.status is Status.NOT_VERIFIED
    assert found.exit_code == 4
    assert "differs" in said


def another_law(result: TimeHistoryResult) -> TimeHistoryResult:
    assert result.frames is not None
    sets = tuple(replace(points, laws=np.ones_like(points.laws)) for points in result.frames.sets)
    return replace(result, frames=replace(result.frames, sets=sets))


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (lambda result: NO_HISTORY, "quake: the deck asks for the time history, which the file does not have"),
        (
            lambda result: replace(result, end=HistoryEnd.LATE),
            "the deck has no time limit, the file says of its time history: the time limit was reached",
        ),
        (
            lambda result: replace(result, half=HalfStep(0.1, 0.2, 0.0, HistoryEnd.DURATION)),
            "the file has a time history with half of the step, which the deck does not ask for",
        ),
        (another_law, "search 0 of the time history has contact points with a joint law that its deck does not give"),
    ],
    ids=["none", "late", "half", "law"],
)
def test_what_the_deck_does_not_ask_for(change: Change, says: str, rocks: Results, tmp_path: Path) -> None:
    _, said = said_of(tmp_path, forged(rocks, change))
    assert says in said


def test_a_status_that_is_not_that_of_the_history(rocks: Results, tmp_path: Path) -> None:
    _, said = said_of(tmp_path, forged(rocks, lambda result: result, Status.APPROXIMATE))
    assert "quake: the load case is approximate, its time history is solved" in said


@pytest.mark.long
def test_half_of_the_step_is_confirmed_by_following_it_anew_alone(tmp_path: Path) -> None:
    results = run_of(tmp_path, "      check: true\n")
    found, said = said_of(tmp_path, results)
    assert said.startswith("quake: what half of the step comes to is not verified; the file says: a peak of 0.")
    assert found.exit_code == 4
    assert said_of(tmp_path, results, anew=True)[1] == ""

    def change(result: TimeHistoryResult) -> TimeHistoryResult:
        assert result.half is not None
        return replace(result, half=replace(result.half, peak=1.1 * result.half.peak))

    _, said = said_of(tmp_path, forged(results, change), anew=True)
    assert "quake: followed anew, the structure in time comes to others: what half of the step comes to" in said


@pytest.mark.long
def test_a_history_that_the_time_limit_cut_off(tmp_path: Path) -> None:
    """What it has is verified, why it ends not; followed anew as far, it comes to the same."""
    limit, long = "analysis: {time_limit: 4}\n", "load_cases.quake.time_history.duration=60"
    results = run_of(tmp_path, limit, long)
    (case,) = results.cases
    assert case.solution.further.time_history.end is HistoryEnd.LATE
    found, said = said_of(tmp_path, results)
    assert said == "quake: why the time history ends is not verified; the file says: the time limit was reached"
    assert found.cases[0].status is Status.TIME_LIMIT
    assert said_of(tmp_path, results, anew=True)[1] == ""
