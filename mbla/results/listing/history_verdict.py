"""What a structure does in time, in one sentence."""

from __future__ import annotations

import math

from mbla.model.model import Model
from mbla.results.history_damage import HistoryDamage, history_damage
from mbla.results.history_figures import HistoryFigures, history_figures
from mbla.results.listing.text import counted
from mbla.results.results import CaseResult
from mbla.solution.pushover.followed import STEP_DEPENDENCE
from mbla.solution.solution import Status
from mbla.solution.time_history.judged import CUT_SHORT
from mbla.solution.time_history.step_rows import HistoryEnd
from mbla.solution.time_history.still_moves import still_moves

NOTABLE = 1e-3
"""of the size of the block that moves most: openings and slips below it are not seen, as those of elastic joints"""
BOTH = 1.0 / 3.0
"""of the greater of opening and slip, from which the lesser is said as well"""
UNSURE = 0.01
"""of the peak, above which the uncertainty of what stays is said"""
COMES_BACK = 0.5
"""of the peak, up to which what stays is said as what it comes back to"""
AT_REST = "the state at rest is not confirmed, and was not followed"
"""why there is no time history where nothing else says so"""


def history_verdict(model: Model, case: CaseResult) -> str:
    """``rocks, peak 0.034 m at 2.1 s, comes back to 0.001 m; no block falls``; ``wall[3] falls at 3.4 s``.

    Without half of the step the error of its figures is not known, and it says so.
    """
    found, asked = case.solution.further.time_history, case.load_case.time_history
    figures = history_figures(found)
    if case.status is Status.NO_EQUILIBRIUM:
        return case.load_case.question.no_equilibrium
    if figures is None or asked is None:
        return f"NOT VERIFIED: {case.solution.reason or AT_REST}"
    damage = history_damage(model, found)
    moves = still_moves(model, found)
    told = motion_words(model, figures, damage, found.end, moves=moves) + _broken_words(model, damage)
    told += "" if found.half is not None else "; not checked with half of the step"
    if case.status is Status.TIME_LIMIT:
        begin = "NOT SOLVED (the time ran out)" if found.end is HistoryEnd.LATE else "NOT SOLVED (stopped)"
        return f"{begin}: followed to {_seconds(figures.lasted)} of {_seconds(asked.duration)}; up to there it {told}"
    if case.status is Status.NOT_VERIFIED:
        return f"NOT VERIFIED: what was followed does not hold; it says that it {told}"
    return told if case.status is Status.SOLVED else f"{told}; approximate"


def motion_words(model: Model, figures: HistoryFigures, damage: HistoryDamage, end: HistoryEnd, *, moves: bool) -> str:
    """What moves and how far, what falls, what stays.

    moves : whether it still moves far at the end
    """
    if figures.falls >= 0:
        others = f", and {counted(figures.fallen - 1, 'block')} after it" if figures.fallen > 1 else ""
        falls = f"{_name(model, figures.falls)} falls at {_seconds(figures.fall_time)}"
        return f"{_manner(model, figures, damage)}, and {falls}{others}"
    peak = f"{peak_words(model, figures)} at {_seconds(figures.peak_time)}{_where(model, figures)}"
    if _is_still(model, figures):
        return f"stays still: it moves by at most {peak}"
    words = f"{_manner(model, figures, damage)}, peak {peak}"
    if end is HistoryEnd.DISPLACED:
        return f"{words}, where it ends as asked; no block has fallen"
    there = f"{figures.residual:.2g} {model.units.length}"
    if end in CUT_SHORT:
        return f"{words}, {there} when it was cut short; no block has fallen"
    if moves:
        varies = f"{there} (+- {figures.residual_uncertainty:.1g})"
        return f"{words}, still moves at the end, about {varies}; no block has fallen"
    return f"{words}, {_rest_words(model, figures)}; no block falls"


def peak_words(model: Model, figures: HistoryFigures) -> str:
    """``0.034 m``; ``0.034 m (0.032 m with half of the step)`` where that gives another one, which bounds nothing."""
    length = model.units.length
    peak = f"{figures.peak:.3g} {length}"
    if not figures.half_step > STEP_DEPENDENCE:
        return peak
    return f"{peak} ({figures.peak_of_half_step:.3g} {length} with half of the step)"


def _rest_words(model: Model, figures: HistoryFigures) -> str:
    rest = f"{figures.residual:.2g} {model.units.length}"
    unsure = figures.residual_uncertainty
    varies = f" (+- {unsure:.1g})" if unsure > UNSURE * figures.peak else ""
    if figures.residual <= COMES_BACK * figures.peak:
        return f"comes back to {rest}{varies}"
    return f"{rest}{varies} of displacement stay"


def _broken_words(model: Model, damage: HistoryDamage) -> str:
    """``; tie b breaks at about 0.4 s, and 2 others after it``."""
    if not damage.broken:
        return ""
    (tie, time), *others = damage.broken
    after = f", and {counted(len(others), 'other')}" if others else ""
    return f"; tie {model.ties.names[tie]} breaks at about {_seconds(time)}{after}"


def _manner(model: Model, figures: HistoryFigures, damage: HistoryDamage) -> str:
    """Whether joints open or slip more, and whether they crush."""
    least = NOTABLE * float(model.blocks.sizes[figures.peak_block])
    moves = _opens_or_slips(figures, least)
    if not damage.crushing > least:
        return moves
    return "crushes" if moves == "moves" else f"{moves} and crushes"


def _opens_or_slips(figures: HistoryFigures, least: float) -> str:
    opens, slips = figures.opening, figures.slip
    if max(opens, slips) <= least:
        return "moves"
    if min(opens, slips) > max(least, BOTH * max(opens, slips)):
        return "rocks and slides"
    return "rocks" if opens >= slips else "slides"


def _is_still(model: Model, figures: HistoryFigures) -> bool:
    least = NOTABLE * float(model.blocks.sizes[figures.peak_block])
    return max(figures.opening, figures.slip, figures.peak) <= least


def _where(model: Model, figures: HistoryFigures) -> str:
    """The block, where there are several that move."""
    return f" ({_name(model, figures.peak_block)})" if len(model.free) > 1 else ""


def _name(model: Model, block: int) -> str:
    return model.blocks.name(block)


def _seconds(time: float) -> str:
    return "-" if math.isnan(time) else f"{time:.4g} s"
