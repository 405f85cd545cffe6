"""What still moves far at the end of its time history, and what does not."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mbla.solution.time_history.remarks import history_remarks
from mbla.solution.time_history.step_rows import HistoryEnd
from mbla.solution.time_history.still_moves import still_moves
from tests.results.rocking import asked, peaks, rocks, step_rows
from tests.results.synthetic import tower_results

RESULTS = tower_results()
MODEL, KINETIC = RESULTS.model, step_rows().kinetic
LAST = np.array([0.0, step_rows().times[-1], 0.0])


def ends_with(share: float) -> np.ndarray:
    """Kinetic energies of which the last is a share of the greatest."""
    return np.append(KINETIC[:-1], share * KINETIC.max())


@pytest.mark.parametrize(
    ("of_peaks", "kinetic", "end", "moves"),
    [
        ({}, 0.9e-3, HistoryEnd.DURATION, False),
        ({}, 1.1e-3, HistoryEnd.DURATION, True),
        ({}, 1.1e-3, HistoryEnd.AT_REST, False),
        ({}, 1.1e-3, HistoryEnd.DISPLACED, False),
        ({"times": LAST}, 0.0, HistoryEnd.DURATION, True),
        ({"times": LAST, "wanders": np.zeros(3)}, 0.0, HistoryEnd.DURATION, False),
        ({"wanders": np.array([0.0, 0.01, 0.0])}, 0.0, HistoryEnd.DURATION, True),
        ({"displacements": np.array([0.0, 1e-4, 0.0])}, 0.5, HistoryEnd.DURATION, False),
        ({"falling": np.array([np.nan, 3.0, np.nan])}, 0.5, HistoryEnd.DURATION, False),
    ],
)
def test_still_moves(of_peaks: dict[str, Any], kinetic: float, end: HistoryEnd, moves: bool) -> None:
    """Of a peak of 0.07 m, with displacements that vary by 0.2 mm at the end; what has fallen is not asked."""
    rows = replace(step_rows(), kinetic=ends_with(kinetic))
    found = replace(rocks(), end=end, rows=rows, peaks=replace(peaks(), **of_peaks))
    assert still_moves(MODEL, found) is moves
    case = replace(RESULTS.cases[0].load_case, time_history=asked())
    identifiers = [remark.identifier for remark in history_remarks(MODEL, RESULTS.contacts, case, found)]
    assert ("history-still-moves" in identifiers) is moves
