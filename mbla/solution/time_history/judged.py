"""What may be said of a structure in time: its status, and why it is not solved."""

from __future__ import annotations

import math

from mbla.model.model import LoadCase
from mbla.solution.pushover.followed import STEP_DEPENDENCE
from mbla.solution.solution import Status
from mbla.solution.time_history.history import TimeHistoryResult
from mbla.solution.time_history.step_rows import HistoryEnd, StepRows

MISSED = 1e-3
"""share of steps that did not converge, from which a history is approximate"""
CUT_SHORT = {HistoryEnd.LATE: "the time limit was reached", HistoryEnd.STOPPED: "the run was stopped"}
"""ends that are not those of the structure, in words"""


def judged(case: LoadCase, found: TimeHistoryResult) -> tuple[Status, str]:
    """Status of a history by itself, before anything of it is verified, and why it is not solved."""
    rows, asked = found.rows, case.time_history
    if found.end is HistoryEnd.NO_REST or rows is None or asked is None:
        return Status.NOT_VERIFIED, "no state of rest was found on elastic joints, from which it could be followed"
    if found.end in CUT_SHORT:
        return Status.TIME_LIMIT, f"{CUT_SHORT[found.end]} at {rows.times[-1]:.4g} of {asked.duration:.4g} s"
    why = [missed_words(rows)] if is_rough(rows) else []
    if asked.check and found.half is None:
        why.append("the time limit was reached before it was followed with half of the step")
    if words := differs_by_step(found):
        why.append(words)
    return (Status.APPROXIMATE if why else Status.SOLVED), "; ".join(why)


def is_rough(rows: StepRows) -> bool:
    """Whether more steps did not converge than may."""
    return int(rows.missed[-1]) > MISSED * _steps(rows)


def missed_words(rows: StepRows) -> str:
    """How many did not converge, and what became of them."""
    words = f"{rows.missed[-1]} of {_steps(rows)} steps were not solved even when halved four times: they were taken "
    return f"{words}with the forces of the law and their momentum"


def _steps(rows: StepRows) -> int:
    """That were made, small ones as well."""
    return max(len(rows) - 1 + int(rows.small_steps[-1]), 1)


def differs_by_step(found: TimeHistoryResult) -> str:
    """What half of the step changes by more than is small; empty for nothing, and where that was not asked for."""
    half, change = found.half, change_by_half_step(found)
    if half is None:
        return ""
    if half.end is not found.end:
        return f"with half of the step it ends otherwise: {half.end}"
    if found.end is HistoryEnd.COLLAPSE or not change > STEP_DEPENDENCE:  # of what falls the peak says little
        return ""
    assert found.peaks is not None  # else the change is not known
    words = f"with half of the step the greatest displacement changes by {100.0 * change:.2g} %"
    words += f", from {found.peaks.peak:.4g} to {half.peak:.4g}"
    return f"{words}: it may lie outside of both; halve the step until they agree"


def change_by_half_step(found: TimeHistoryResult) -> float:
    """Change of the greatest displacement with half of the step, over that; nan where it is not known.

    What is less than the sag counts as that: by so much joints give without any motion.
    """
    if found.half is None or found.peaks is None:
        return math.nan
    peak = found.peaks.peak
    size = max(peak, 0.0 if math.isnan(found.sag) else found.sag, 1e-300)
    return abs(found.half.peak - peak) / size
