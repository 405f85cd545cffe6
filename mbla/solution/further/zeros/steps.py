"""Steps of a function of one variable around zero: jumps over it, and scatter, which is none of what it describes."""

from __future__ import annotations

import math
from collections.abc import Sequence

from mbla.solution.further.zeros.samples import S, Sample

STEEPER = 3.0
"""Slope of a bracket over the mean slope around it, from which a function scatters there"""
STEEPEST = 10.0
"""Slope that a function may have in the last bracket, over the slopes next to it: what rises faster jumps"""


def jumps_over(below: S, above: S, seen: Sequence[S], error: float) -> bool:
    """Whether both ends of the last bracket are further from zero than they are known, and than slopes explain.

    seen  : all samples
    error : of the zero, which is the width of the bracket where an end has no size
    """
    width = abs(above.x - below.x)
    if not math.isfinite(above.y - below.y):
        return error >= width > 0.0
    known = max(max(each.uncertainty, each.scatter) for each in (below, above))
    outer = [(end, next(iter(_beyond(end, other, seen)), end)) for end, other in ((below, above), (above, below))]
    slopes = [below.slope, above.slope, *(_secant(*pair) for pair in outer if pair[0] is not pair[1])]
    steepest = max((abs(slope) for slope in slopes if math.isfinite(slope)), default=math.inf)
    return min(abs(below.y), abs(above.y)) > known + STEEPEST * steepest * width


def scattered(below: S, above: S, seen: Sequence[S]) -> float:
    """How far zero may be from the ends of a bracket that rises only by scatter; nan where it does not.

    Both ends are zero up to the scatter, and the mean slope around them explains no such rise: that between the nearest
    samples on both sides whose size is more than the scatter.
    """
    scatter, width, rise = min(below.scatter, above.scatter), above.x - below.x, above.y - below.y
    if scatter == 0.0 or max(abs(below.y), abs(above.y)) > scatter:
        return math.nan
    slope = _secant(_clear(below, above, seen, scatter), _clear(above, below, seen, scatter))
    return rise / abs(slope) if rise > STEEPER * slope * width > 0.0 else math.nan


def _clear(end: S, other: S, seen: Sequence[S], scatter: float) -> S:
    """The nearest sample outside the bracket whose size is more than the scatter; without any the last one."""
    outer = [end, *_beyond(end, other, seen)]
    return next((each for each in outer if abs(each.y) > scatter), outer[-1])


def _beyond(end: S, other: S, seen: Sequence[S]) -> list[S]:
    """Samples with a size that an end of the bracket parts from the other one, the nearest first."""
    found = [each for each in seen if math.isfinite(each.y) and (each.x - end.x) * (end.x - other.x) > 0.0]
    return sorted(found, key=lambda each: abs(each.x - end.x))


def _secant(one: Sample, other: Sample) -> float:
    return (other.y - one.y) / (other.x - one.x)
