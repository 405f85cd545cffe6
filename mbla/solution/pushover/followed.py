"""Steps of a pushover up to where they end, and how much that depends on their size.

The curve ends where the load factor is nothing, where the structure falls on without the live load, at the displacement
asked for, or where no forces or no motion are found. The error of a load factor, of first order in the step, is its
difference from the curve of steps twice as long; so is that of the displacement at the end, where which blocks drop
first may depend on the step.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.model import LoadCase
from mbla.solution.pushover.pushed import CurveEnd
from mbla.solution.pushover.steps import Pushover, Step
from mbla.solution.solution import Mechanics, Solution

BY_ITSELF, MOST_DROPPING = 100.0, 50
"""Power of the dead load over that of the live load in a mechanism by which a structure goes on whatever the live load,
and steps that it may do so until its blocks come to rest on others: the curve goes on from there, or ends where the
fall began."""

BLOCKED, MOST_SHORT = 100.0, 10
"""Load factor over that of the structure as built from which something blocks its way, and steps on end that can only
be made shorter than asked for."""

SUDDEN = 0.2
"""Load factor over the greatest from which it does not fall to nothing in one step: the structure falls there."""

STEP_DEPENDENCE = 0.02
"""Change with steps of twice the size, over the greatest value, from which figures of a pushover are approximate."""

COME_TO_AN_END = frozenset(
    {CurveEnd.NOTHING_LEFT, CurveEnd.FALLS, CurveEnd.NOT_CARRIED, CurveEnd.REACHED, CurveEnd.BLOCKED}
)
"""Ends that are those of the structure, or asked for."""


@dataclass(frozen=True)
class StepErrors:
    """Differences from steps of twice the size, nan where these are not known.

    rows         : (n_steps,) of the load factors
    displacement : m, at the end of the curve
    load_factor  : there
    """

    rows: FloatArray
    displacement: float = np.nan
    load_factor: float = np.nan

    @staticmethod
    def unknown(n_steps: int) -> StepErrors:
        """Of none."""
        return StepErrors(np.full(n_steps, np.nan))


def followed(push: Pushover, first: Mechanics, steps: list[Step]) -> tuple[list[Step], CurveEnd]:
    """Steps up to the end of the curve, and why it ends.

    steps : none yet, gets each as soon as it is done
    """
    asked, settles = push.case.pushover, push.case.settlement is not None
    assert asked is not None  # else nothing is pushed
    dropping = 0
    for step in push.steps(first):
        if step.load_factor > BLOCKED * abs(first.load_factor) and not settles:
            return steps, CurveEnd.BLOCKED
        steps.append(step)
        if step.load_factor <= 0.0 and not settles:
            greatest = max(each.load_factor for each in steps)
            if len(steps) > 1 and steps[-2].load_factor > SUDDEN * greatest:
                return steps[:-1], CurveEnd.FALLS
            return steps, CurveEnd.NOTHING_LEFT
        if step.displacement >= asked.until * (1.0 - 1e-9):
            return steps, CurveEnd.REACHED
        if len(steps) > asked.steps:
            return steps, CurveEnd.STEPS_DONE
        if push.short > MOST_SHORT:
            break
        by_itself = float(np.vdot(push.case.dead_load, step.mechanism)) > BY_ITSELF * abs(step.load_factor)
        dropping = dropping + 1 if by_itself and not settles else 0
        if dropping > MOST_DROPPING:
            break
    if push.late:
        return steps, CurveEnd.LATE
    if dropping:
        return steps[: len(steps) - dropping + 1], CurveEnd.FALLS
    if push.short > MOST_SHORT:
        return steps, CurveEnd.BLOCKED
    if push.deep:
        return steps, CurveEnd.DEEP
    return steps, CurveEnd.NOT_CARRIED if settles else CurveEnd.FALLS if push.falls else CurveEnd.STUCK


def step_errors(push: Pushover, first: Mechanics, steps: Sequence[Step], end: CurveEnd) -> StepErrors:
    """From the curve of steps of twice the size, where the deck does not leave it out and time is left."""
    unknown = StepErrors.unknown(len(steps))
    assert push.case.pushover is not None  # else nothing is pushed
    if not push.case.pushover.error or end is CurveEnd.LATE:
        return unknown
    twice = replace(push, step=2.0 * push.step, most=2.0, falls=False, deep=False, short=0)
    longer, other = followed(twice, first, [])
    moved, factors = (np.array([getattr(each, name) for each in longer]) for name in ("displacement", "load_factor"))
    own = np.array([each.displacement for each in steps])
    rows = np.abs(np.interp(own, moved, factors, right=np.nan) - [each.load_factor for each in steps])
    if not COME_TO_AN_END.issuperset((end, other)):
        return replace(unknown, rows=rows)
    (here, factor), (there, another) = _end_of(steps, end), _end_of(longer, other)
    return StepErrors(rows, abs(here - there), abs(factor - another))


def _end_of(steps: Sequence[Step], end: CurveEnd) -> tuple[float, float]:
    """Displacement, m, and load factor at the end of a curve, on the line between two steps where nothing is left."""
    last = steps[-1]
    if end is not CurveEnd.NOTHING_LEFT or len(steps) < 2:
        return last.displacement, last.load_factor
    before = steps[-2]
    share = before.load_factor / (before.load_factor - last.load_factor)
    return before.displacement + share * (last.displacement - before.displacement), 0.0


def greatest_value(case: LoadCase, load_factors: FloatArray) -> float:
    """Greatest load factor of a curve, or reaction of a support over the unit of load factors."""
    settlement = case.settlement
    if settlement is None:
        return float(np.abs(load_factors).max())
    return float(np.abs([settlement.reaction(each) / settlement.unit for each in load_factors]).max())


def step_dependence(case: LoadCase, solution: Solution) -> float:
    """The greatest change with steps of twice the size: of a value over the greatest, of the displacement at the end
    over itself; nan where none is known.
    """
    curve = solution.curve
    if len(curve) < 2:
        return np.nan
    greatest = greatest_value(case, np.array([row.load_factor for row in curve]))
    values = [*(row.error for row in curve), solution.curve_last_error]
    shares = [value / greatest if greatest > 0.0 else np.nan for value in values]
    way = max(abs(row.displacement) for row in curve)
    shares.append(solution.curve_end_error / way if way > 0.0 else np.nan)
    known = [share for share in shares if np.isfinite(share)]
    return max(known, default=np.nan)
