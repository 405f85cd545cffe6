"""Whether a pushover ends as it says: its end held against its rows.

Three ends follow from the rows alone, and rows that show one of these have no other end: the load factor asked for, or
nothing, the displacement asked for, the steps asked for. A curve that was cut off shows none of the three.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise

from mbla.model.model import LoadCase
from mbla.solution.pushover.curve_rows import CurveEnd, CurveRow

ROUNDING = 2e-6
"""of the displacement asked for and of the load factor at first, within which it is reached, and nothing is left"""

SHOWN = (CurveEnd.NOTHING_LEFT, CurveEnd.FACTOR_REACHED, CurveEnd.REACHED, CurveEnd.STEPS_DONE)
"""ends that the rows show"""


def end_shown(case: LoadCase, curve: Sequence[CurveRow]) -> CurveEnd:
    """The end that the last of some rows shows, the displacement where it is several; ``NONE`` where they show none."""
    asked, last = case.pushover, curve[-1]
    if asked is None:
        return CurveEnd.NONE
    if last.displacement >= asked.until * (1.0 - 2.0 * ROUNDING):
        return CurveEnd.REACHED
    end = asked.until_load_factor
    if case.question.multiplies and last.load_factor <= end + ROUNDING * abs(curve[0].load_factor):
        return CurveEnd.FACTOR_REACHED if end else CurveEnd.NOTHING_LEFT
    return CurveEnd.STEPS_DONE if len(curve) > asked.steps else CurveEnd.NONE


def end_failure(case: LoadCase, curve: Sequence[CurveRow], end: CurveEnd) -> str:
    """Why a curve does not end as it says, in words; empty where its rows show that end, or cannot show it.

    curve : at least the structure as built
    """
    for row in range(1, len(curve)):
        if (earlier := end_shown(case, curve[:row])) and not _within_rounding(case, curve[row - 1]):
            return f"the pushover goes on after step {curve[row - 1].step}, where {earlier}"
    shown = end_shown(case, curve)
    if shown is not end and shown is not CurveEnd.NONE:
        return f"the pushover ends because {shown}, the file says: {end or 'nothing'}"
    if end is CurveEnd.NONE or (end in SHOWN and shown is not end):
        return f"the rows of the pushover do not show that {end or 'it ends'}: rows are missing"
    return ""


def _within_rounding(case: LoadCase, row: CurveRow) -> bool:
    """Whether a row is so near an end that another machine may go on from there."""
    asked = case.pushover
    short = asked is not None and row.displacement < asked.until
    near = asked is not None and row.displacement >= asked.until * (1.0 - 2.0 * ROUNDING)
    return (near and short) or row.load_factor == 0.0


ON_STEP = 1e-3
"""of the step asked for, within which a row is at a multiple of it"""


def gaps(case: LoadCase, curve: Sequence[CurveRow]) -> Iterator[tuple[CurveRow, str]]:
    """Rows before which a multiple of the step asked for has no row, and what the file says of it; "" for nothing.

    That the structure jumps there, that a row was not found, or that a tie has broken.
    """
    asked = case.pushover
    if asked is None:
        return
    farthest = max(curve[0].displacement, 0.0)
    for before, row in pairwise(curve):
        passed = math.floor(row.displacement / asked.step - ON_STEP) - math.floor(farthest / asked.step + ON_STEP)
        if passed > 0:
            says = {
                "it jumps there": row.jumps,
                "none was found there": row.unsolved,
                "a tie breaks there": row.broken != before.broken,
            }
            yield row, " and ".join(words for words, holds in says.items() if holds)
        farthest = max(farthest, row.displacement)
