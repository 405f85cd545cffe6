"""What may be said of a structure in time: its status with the reason, and what a reader of its figures must know."""

from __future__ import annotations

import math

import numpy as np

from mbla.errors import Message
from mbla.model.model import LoadCase, Model
from mbla.solution.pushover.followed import STEP_DEPENDENCE
from mbla.solution.solution import Checks, Status
from mbla.solution.time_history.history import TimeHistoryResult
from mbla.solution.time_history.step_rows import HistoryEnd

MISSED = 1e-3
"""share of steps that did not converge, from which a history is approximate"""
LARGE_SAG = 1e-3
"""of the size of the structure: displacement under the dead load that is no longer small beside it"""
STEPS_OF_PERIOD = 20.0
"""of the first period, that are enough: the damping of a step, ωh/2, is at most π/20 there"""
CUT_SHORT = {HistoryEnd.LATE: "the time limit was reached", HistoryEnd.STOPPED: "the run was stopped"}
"""ends that are not those of the structure, in words"""


def judged(case: LoadCase, found: TimeHistoryResult) -> tuple[Status, str]:
    """Status of a history by itself, before anything of it is verified, and why it is not solved."""
    rows, asked = found.rows, case.time_history
    if found.end is HistoryEnd.NOT_STANDING or rows is None or asked is None:
        return Status.NO_EQUILIBRIUM, str(HistoryEnd.NOT_STANDING)
    if found.end in CUT_SHORT:
        return Status.TIME_LIMIT, f"{CUT_SHORT[found.end]} at {rows.times[-1]:.4g} of {asked.duration:.4g} s"
    why, steps, missed = [], len(rows) - 1, int(rows.missed[-1])
    if missed > MISSED * steps:
        why.append(f"{missed} of {steps} steps did not converge, and were taken as they were")
    if words := differs_by_step(found):
        why.append(words)
    return (Status.APPROXIMATE if why else Status.SOLVED), "; ".join(why)


def checks_of(failures: tuple[Message, ...]) -> Checks:
    """What a verification of a history found, which has no load factor, and no bounds."""
    nan = math.nan
    return Checks(nan, nan, nan, nan, nan, nan, nan, nan, nan, verified=not failures, failures=failures)


def differs_by_step(found: TimeHistoryResult) -> str:
    """What half of the step changes by more than is small; empty for nothing, and where that was not asked for."""
    half, change = found.half, change_by_half_step(found)
    if half is None:
        return ""
    if half.end is not found.end:
        return f"with half of the step it ends otherwise: {half.end}"
    if found.end is HistoryEnd.COLLAPSE or not change > STEP_DEPENDENCE:  # of what falls the peak says little
        return ""
    return f"with half of the step the greatest displacement changes by {100.0 * change:.2g} %"


def change_by_half_step(found: TimeHistoryResult) -> float:
    """Change of the greatest displacement with half of the step, over that; nan where it is not known.

    What is less than the sag counts as that: by so much joints give without any motion.
    """
    if found.half is None or found.peaks is None:
        return math.nan
    peak = float(found.peaks.displacements.max())
    size = max(peak, 0.0 if math.isnan(found.sag) else found.sag, 1e-300)
    return abs(found.half.peak - peak) / size


def history_remarks(model: Model, case: LoadCase, found: TimeHistoryResult) -> tuple[Message, ...]:
    """What a reader must know although nothing is wrong, from the deck and what is on record."""
    asked, remarks = case.time_history, list[Message]()
    if asked is None or found.rows is None:
        return ()
    size = float(np.linalg.norm(np.ptp(model.blocks.vertices, axis=0)))
    length = model.units.length
    if found.sag > LARGE_SAG * size:
        words = f"joints give by {found.sag:.2g} {length} under the dead load, {found.sag / size:.2g} of the size of "
        remarks.append(Message("history-sag", f"{words}the structure: stiffer joints are meant, or its size matters"))
    if asked.step * STEPS_OF_PERIOD > found.period:
        words = f"the step of {asked.step:.4g} s is more than 1/{STEPS_OF_PERIOD:g} of the first period of "
        words += f"{found.period:.4g} s: vibration is damped by the step, to {found.damping:.2g} of critical damping"
        remarks.append(Message("history-long-steps", words))
    missed, steps = int(found.rows.missed[-1]), len(found.rows) - 1
    if 0 < missed <= MISSED * steps:
        remarks.append(Message("history-steps-missed", f"{missed} of {steps} steps did not converge"))
    return tuple(remarks)
