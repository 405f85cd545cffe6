"""``mbla verify --again``: a structure followed in time anew from the deck in a file, beside what the file has.

On the same machine it comes to the same figures. Another may round otherwise: where a structure rocks long, or all but
falls, that shows, and what is then another figure is no contradiction but the range that the figure has.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from mbla.assembly.assembly import Assembly
from mbla.deck import Deck
from mbla.results.results import CaseResult
from mbla.results.verification.asked import Found
from mbla.solution.settings import settings_for, solver_settings
from mbla.solution.time_history.follow import follow
from mbla.solution.time_history.history import HalfStep, TimeHistoryResult
from mbla.solution.time_history.judged import CUT_SHORT

ALLOWED = 0.02
"""Change of a peak up to which it is the same, as that with half of the step."""


def held_against_history(found: Found, deck: Deck, assembly: Assembly, case: CaseResult) -> None:
    """What a time history that is followed anew shows, added to what was found of a case: it confirms, or differs.

    case : with checks and status recomputed; cut short it is followed as far as it came
    """
    own, load_case = case.solution.further.time_history, case.load_case
    asked = load_case.time_history
    assert asked is not None  # who calls has seen to that
    assert own.rows is not None
    cut = own.end in CUT_SHORT
    if cut:
        load_case = replace(load_case, time_history=replace(asked, duration=float(own.rows.times[-1]), check=False))
    settings = replace(settings_for(load_case, solver_settings(deck.analysis)), deadline=None)
    again, _ = follow(assembly, deck.contacts, load_case, settings)
    against = list(_others(own, again, cut=cut))
    if against:
        found.unconfirmed.append(f"followed anew, the structure in time comes to others: {', '.join(against)}")
    else:
        found.of_history.clear()


def _others(own: TimeHistoryResult, again: TimeHistoryResult, *, cut: bool) -> Iterator[str]:
    """What is another, in words."""
    if again.end is not own.end and not cut:
        yield f"its end ({again.end})"
    if own.peaks is not None and again.peaks is not None:
        if not _same(own.peaks.peak, again.peaks.peak):
            yield f"the peak ({again.peaks.peak:.6g})"
        one, other = (float(each.residuals.max(initial=0.0)) for each in (own.peaks, again.peaks))
        if not cut and not abs(one - other) <= ALLOWED * max(own.peaks.peak, again.peaks.peak):
            yield f"the residual displacement ({other:.6g})"
    if not cut and not _same_half(own.half, again.half):
        yield "what half of the step comes to"


def _same(one: float, other: float) -> bool:
    return abs(one - other) <= ALLOWED * max(abs(one), abs(other))


def _same_half(own: HalfStep | None, again: HalfStep | None) -> bool:
    if own is None or again is None:
        return own is again
    return own.end is again.end and _same(own.peak, again.peak)
