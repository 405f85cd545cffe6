"""What a pushover in a file shows, and what it says that only the run can know.

Its rows are recomputed before: where forces are off their law or out of balance there must be a remark. Here its end is
held against its rows, the rows against the steps asked for, the energies against poses and load factors.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mbla.assembly.assembly import Assembly
from mbla.deck import Deck
from mbla.results.results import CaseResult
from mbla.solution.pushover.curve_rows import CurveEnd
from mbla.solution.pushover.ends import SHOWN, end_failure, gaps
from mbla.solution.pushover.record import PushedRows
from mbla.solution.pushover.start import why_not_pushed
from mbla.solution.solution import Status
from mbla.solution.verification.row_energies import energy_failure, energy_lost
from mbla.solution.verification.row_laws import row_of_another_law

NOTABLE = 0.02
"""Energy over the greatest whose loss must have a reason."""

SKEW = 1e-6
"""Products of the unit vectors of a frame up to which they are at right angles."""


def pushover_differences(deck: Deck, assembly: Assembly, case: CaseResult) -> Iterator[str]:
    """Where a pushover is not what its deck and its own rows give, in words.

    case : with checks, status and curve recomputed
    """
    solution, load_case = case.solution, case.load_case
    model = assembly.model.of_case(load_case)
    against = why_not_pushed(model, assembly.contacts, load_case, solution, case.status is Status.SOLVED)
    if solution.further.pushover.rows is None:
        if not against:
            yield "the deck asks for the pushover, which the file does not have"
        return
    if against:
        yield f"the file has a pushover, which no run makes of this case: {against}"
        return
    if failure := end_failure(load_case, solution.further.pushover.curve, solution.further.pushover.curve_end):
        yield failure
    elif solution.further.pushover.curve_end is CurveEnd.LATE and deck.analysis.time_limit is None:
        yield f"the deck has no time limit, the file says of its pushover: {solution.further.pushover.curve_end}"
    yield from _rows_missing(case)
    if failure := energy_failure(load_case, solution.further.pushover.rows):
        yield failure
    if (row := row_of_another_law(assembly, deck.contacts, load_case, solution.further.pushover.rows)) is not None:
        yield f"step {row} of the pushover has contact points with a joint law that its deck does not give them"
    if (row := _row_of_skew_frames(solution.further.pushover.rows)) is not None:
        yield f"step {row} of the pushover has contact points whose frames are not of unit vectors at right angles"
    if _comes_back(solution.further.pushover.rows):
        yield "blocks that have fallen are part of the structure again further on in the pushover"


def _rows_missing(case: CaseResult) -> Iterator[str]:
    without = [row.step for row, says in gaps(case.load_case, case.solution.further.pushover.curve) if not says]
    if without:
        yield f"before step {without[0]} the pushover has no row where its deck asks for one: rows are missing"


def _row_of_skew_frames(rows: PushedRows) -> int | None:
    """The first row with a frame that is not orthonormal, or None."""
    frames = rows.points.frames[rows.points.bodies[:, 0] >= 0]
    skew = np.abs(frames @ frames.transpose(0, 2, 1) - np.eye(3)).max(axis=(1, 2), initial=0.0) > SKEW
    if not skew.any():
        return None
    point = int(np.flatnonzero(rows.points.bodies[:, 0] >= 0)[skew.argmax()])
    return int(np.searchsorted(rows.point_start, point, side="right")) - 1


def _comes_back(rows: PushedRows) -> bool:
    return bool((rows.fallen[:-1] & ~rows.fallen[1:]).any())


def pushover_claims(case: CaseResult) -> Iterator[str]:
    """What a pushover says that nothing in the file shows, in words: ``--again`` follows it anew."""
    solution, load_case = case.solution, case.load_case
    rows, curve = solution.further.pushover.rows, solution.further.pushover.curve
    if rows is None or load_case.pushover is None:
        return
    if solution.further.pushover.curve_end not in SHOWN:
        yield f"why the pushover ends is not verified; the file says: {solution.further.pushover.curve_end}"
        if load_case.assessment is not None:
            yield "the verdict of the code rests on where the pushover ends, which is not verified"
    said = [(row.step, says) for row, says in gaps(load_case, curve) if says]
    if said:
        step, says = said[0]
        yield f"that the pushover has no row before step {step} is not verified; the file says: {says}"
    if rows.fallen.any():
        fallen = int(rows.fallen[-1].sum())
        first = int(np.argmax(rows.fallen.any(axis=1)))
        says = f"{fallen}, the first before step {first}"
        yield f"blocks that fall without the rest are not verified; the file says: {says}"
    if (lost := energy_lost(load_case, rows)) > NOTABLE:
        yield f"that {lost:.2g} of the energy of the pushover is lost where blocks drop is not verified"
