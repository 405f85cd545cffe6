"""What a pushover found: its curve, why it ends, and what its rows follow from."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from mbla.solution.pushover.curve_rows import CurveEnd, CurveRow
from mbla.solution.pushover.record import PushedRows


@dataclass(frozen=True)
class Pushover:
    """A capacity curve.

    curve     : its steps, the structure as built first
    curve_end : why it ends
    curve_end_error, curve_last_error : change of the displacement there, m, and of the load factor there with steps of
                twice the size; nan where that is not known
    rows      : poses, contact points, forces and history of its steps; None where there is no pushover
    """

    curve: tuple[CurveRow, ...] = ()
    curve_end: CurveEnd = CurveEnd.NONE
    curve_end_error: float = math.nan
    curve_last_error: float = math.nan
    rows: PushedRows | None = field(default=None, compare=False)


NOT_PUSHED = Pushover()
