"""What a time history in a file shows, and what it says that only the run can know.

Its frames, rows, histories and peaks are derived anew before (:mod:`mbla.solution.verification.in_time.history`). Here
they are held against what the deck asks for, its joint laws and its status.
"""

from __future__ import annotations

from collections.abc import Iterator

from mbla.assembly.assembly import Assembly
from mbla.deck import Deck
from mbla.results.results import CaseResult
from mbla.solution.solution import Status
from mbla.solution.time_history.history import TimeHistoryResult
from mbla.solution.time_history.judged import CUT_SHORT, judged
from mbla.solution.time_history.step_rows import HistoryEnd
from mbla.solution.verification.row_laws import search_of_another_law


def history_differences(deck: Deck, assembly: Assembly, case: CaseResult) -> Iterator[str]:
    """Where a time history is not what its deck and its own rows give, in words.

    case : with checks and status recomputed
    """
    load_case, found = case.load_case, case.solution.further.time_history
    asked = load_case.time_history
    if asked is None:
        return
    if found.end is HistoryEnd.NONE:
        if case.status is Status.SOLVED:  # what does not stand is not followed
            yield "the deck asks for the time history, which the file does not have"
        return
    if found.end is HistoryEnd.LATE and deck.analysis.time_limit is None:
        yield f"the deck has no time limit, the file says of its time history: {found.end}"
    status = judged(load_case, found)[0]
    if found.rows is not None and case.solution.status is not status:
        yield f"the load case is {case.solution.status}, its time history is {status}"
    yield from _of_half_step(found, check=asked.check)
    if found.frames is not None:
        search = search_of_another_law(assembly, deck.contacts, load_case, found.frames)
        if search is not None:
            yield f"search {search} of the time history has contact points with a joint law that its deck does not give"


def _of_half_step(found: TimeHistoryResult, *, check: bool) -> Iterator[str]:
    """The same with half of the step where that is asked for and the time was enough, and nowhere else."""
    whole = found.rows is not None and found.end not in CUT_SHORT
    if found.half is None and check and whole:
        yield "the deck asks for the time history with half of the step, which the file does not have"
    elif found.half is not None and not check:
        yield "the file has a time history with half of the step, which the deck does not ask for"


def history_claims(case: CaseResult) -> Iterator[str]:
    """What a time history says that nothing in the file shows, in words: ``--again`` follows it anew."""
    found = case.solution.further.time_history
    if found.half is not None:
        yield f"what half of the step comes to is not verified; the file says: a peak of {found.half.peak:.6g}"
    if found.end in CUT_SHORT:
        yield f"why the time history ends is not verified; the file says: {found.end}"
