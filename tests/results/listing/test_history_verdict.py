"""What a structure does in time, in one sentence."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mbla.results.listing.answers import case_status_words
from mbla.results.listing.history_verdict import history_verdict
from mbla.solution.solution import Status
from mbla.solution.time_history.history import HalfStep
from mbla.solution.time_history.step_rows import HistoryEnd
from tests.results.rocking import peaks, rocking_case, rocks
from tests.results.synthetic import tower_results

RESULTS = tower_results()
ALONE = "; not checked with half of the step"


def told(**changed: Any) -> str:
    case = rocking_case(RESULTS.cases[0], **changed)
    return history_verdict(RESULTS.model, case)


def test_a_tower_that_rocks() -> None:
    assert told() == "rocks, peak 0.0713 m at 0.4 s (tower[0]), comes back to 0.001 m; no block falls"


def test_slides_and_what_stays() -> None:
    slid = replace(peaks(), openings=np.zeros(2), slips=np.array([0.07, 0.0]), residuals=np.array([0.0, 0.07, 0.0]))
    half = HalfStep(0.0713, 0.4, 0.07, HistoryEnd.DURATION)
    assert told(peaks=slid, half=half).startswith("slides, peak 0.0713 m")
    assert "0.07 m of displacement stay; no block falls" in told(peaks=slid, half=half)
    assert told(peaks=replace(slid, openings=np.array([0.05, 0.0]))).startswith("rocks and slides, ")


def test_stands_still() -> None:
    moved = replace(peaks(), displacements=np.array([0.0, 1e-4, 0.0]), openings=np.zeros(2), slips=np.full(2, 1e-5))
    assert told(peaks=moved, half=None) == f"stays still: it moves by at most 0.0001 m at 0.4 s (tower[0]){ALONE}"


def test_does_not_stand() -> None:
    case = rocking_case(RESULTS.cases[0], **dict.fromkeys(("rows", "frames", "histories", "peaks", "half")))
    words = "no equilibrium: the structure does not stand under its dead load"
    assert history_verdict(RESULTS.model, replace(case, status=Status.NO_EQUILIBRIUM)) == words
    assert (
        history_verdict(RESULTS.model, replace(case, solution=replace(case.solution, reason="x"))) == "NOT VERIFIED: x"
    )


def test_falls() -> None:
    fallen = replace(peaks(), falling=np.array([np.nan, 3.4, 3.6]))
    words = told(peaks=fallen, end=HistoryEnd.COLLAPSE, half=None)
    assert words == f"rocks, and tower[0] falls at 3.4 s, and 1 block after it{ALONE}"


def test_still_moves_at_the_end() -> None:
    moving = replace(peaks(), residuals=np.array([0.0, 0.01, 0.0]), wanders=np.array([0.0, 0.02, 0.0]))
    assert "still moves at the end, about 0.01 m (+- 0.02); no block has fallen" in told(peaks=moving)


def test_what_has_come_to_rest_does_not_still_move_however_unsure_what_stays_is() -> None:
    unsure = replace(peaks(), wanders=np.array([0.0, 0.002, 0.0]))
    assert "comes back to 0.001 m (+- 0.002); no block falls" in told(peaks=unsure)


def test_moves_on_slowly_beyond_its_unstable_equilibrium() -> None:
    """It is displaced most in the last step, where it has lost most of its kinetic energy."""
    moving = replace(peaks(), times=np.array([0.0, 4.0, 0.0]))
    assert "still moves at the end, about 0.001 m (+- 0.0002); no block has fallen" in told(peaks=moving)


def test_a_peak_that_depends_on_the_step_is_given_with_that_of_half() -> None:
    words = told(half=HalfStep(0.08, 0.3, 0.0, HistoryEnd.DURATION))
    assert words.startswith("rocks, peak 0.0713 m (0.08 m with half of the step) at 0.4 s")
    assert words.endswith("; approximate")


@pytest.mark.parametrize(
    ("end", "words"),
    [
        (HistoryEnd.LATE, "NOT SOLVED (the time ran out): followed to 4 s of 4 s; up to there it rocks, peak 0.0713 m"),
        (HistoryEnd.STOPPED, "NOT SOLVED (stopped): followed to 4 s of 4 s; up to there it rocks"),
        (HistoryEnd.DISPLACED, "rocks, peak 0.0713 m at 0.4 s (tower[0]), where it ends as asked; no block has fallen"),
    ],
)
def test_ends(end: HistoryEnd, words: str) -> None:
    half = replace(rocks().half or HalfStep(0.0, 0.0, 0.0, end), end=end)
    assert told(end=end, half=half).startswith(words)


def test_a_run_that_was_stopped_has_that_as_its_status() -> None:
    stopped, late = (rocking_case(RESULTS.cases[0], end=end) for end in (HistoryEnd.STOPPED, HistoryEnd.LATE))
    assert (case_status_words(stopped), case_status_words(late)) == ("STOPPED", "TIME LIMIT")
