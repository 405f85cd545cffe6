"""How much the curve of a pushover depends on the size of its steps.

What steps of twice the size change of a load factor is its error: only what friction remembers depends on them. So is
the change of the displacement at the end, where which blocks drop first may depend on the step.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.model import LoadCase
from mbla.solution.pushover.curve_rows import CurveEnd
from mbla.solution.pushover.pushover import Pushover

STEP_DEPENDENCE = 0.02
"""Change with steps of twice the size, over the greatest value, from which figures of a pushover are approximate."""

SAME_PLACE = 1e-6
"""Difference of displacements over the whole, up to which rows of two curves are at the same place."""

COME_TO_AN_END = frozenset(
    {
        CurveEnd.NOTHING_LEFT,
        CurveEnd.FALLS,
        CurveEnd.NOT_CARRIED,
        CurveEnd.REACHED,
        CurveEnd.FACTOR_REACHED,
        CurveEnd.BLOCKED,
    }
)
"""Ends that are those of the structure, or asked for."""


@dataclass(frozen=True)
class StepErrors:
    """Differences from steps of twice the size, nan where these are not known.

    rows         : (n_rows,) of the load factors
    displacement : m, at the end of the curve
    load_factor  : there
    """

    rows: FloatArray
    displacement: float = np.nan
    load_factor: float = np.nan

    @staticmethod
    def unknown(n_rows: int) -> StepErrors:
        """Of none."""
        return StepErrors(np.full(n_rows, np.nan))


def step_errors(
    curve: Sequence[tuple[float, float]], end: CurveEnd, longer: Sequence[tuple[float, float]], other: CurveEnd
) -> StepErrors:
    """From two curves, displacement and load factor of each row, and why they end; the second by longer steps."""
    own, their = np.array(curve).reshape(-1, 2), np.array(longer).reshape(-1, 2)
    near = np.abs(own[:, None, 0] - their[None, :, 0])
    same = near.argmin(axis=1)
    at = near[np.arange(len(own)), same] <= SAME_PLACE * float(np.ptp(own[:, 0]))
    rows = np.where(at, np.abs(their[same, 1] - own[:, 1]), np.nan)
    rows[0] = np.nan
    if not COME_TO_AN_END.issuperset((end, other)):
        return StepErrors(rows)
    return StepErrors(rows, abs(float(own[-1, 0] - their[-1, 0])), abs(float(own[-1, 1] - their[-1, 1])))


def greatest_value(case: LoadCase, load_factors: FloatArray) -> float:
    """Greatest load factor of a curve, or reaction of a support over the unit of load factors."""
    question = case.question
    return float(np.abs([question.compared(each) / question.scale for each in load_factors]).max())


def step_dependence(case: LoadCase, pushover: Pushover) -> float:
    """The greatest change with steps of twice the size: of a value over the greatest, of the displacement at the end
    over itself; nan where none is known.
    """
    curve = pushover.curve
    if len(curve) < 2:
        return np.nan
    greatest = greatest_value(case, np.array([row.load_factor for row in curve]))
    values = [*(row.error for row in curve), pushover.curve_last_error]
    shares = [value / greatest if greatest > 0.0 else np.nan for value in values]
    way = max(abs(row.displacement) for row in curve)
    shares.append(pushover.curve_end_error / way if way > 0.0 else np.nan)
    known = [share for share in shares if np.isfinite(share)]
    return max(known, default=np.nan)
