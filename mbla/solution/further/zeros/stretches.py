"""Where a function of one variable is zero over a stretch: from which value on, and up to which.

Each end lies between a sample that is zero, as far as the function is known, and one that is not. The next one is tried
where the tangent at the latter, or the secant of the last two such, leaves what zero may be off; without slopes the
first of all right next to the former, where most stretches are single values. What makes no progress is cut in half.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Generic, TypeAlias

from mbla.solution.further.zeros.samples import S, Sample, Zero, apart, is_zero, steep

MOST = 50
"""Evaluations for one end: bisection alone reaches rounding within that"""
GUESSES = 8
"""Of these by tangents and secants at most"""
PAST, SHORT = 0.25, 0.9
"""Of the tolerance: how far behind the end that is guessed, and how far from the last zero, is looked at"""

At: TypeAlias = Callable[[float], S]


@dataclass(frozen=True)
class _End(Generic[S]):
    """An end of a stretch.

    inside   : the last sample that is zero
    outside  : the next one that is not; None where there are no samples beyond
    complete : they are within the tolerance
    """

    inside: S
    outside: S | None
    complete: bool

    @property
    def error(self) -> float:
        """How far from ``inside`` the end may be."""
        return 0.0 if self.outside is None else abs(self.outside.x - self.inside.x)


def runs(samples: Sequence[S]) -> list[tuple[S | None, list[S], S | None]]:
    """Neighbours that are zero, and the samples before and after them; two with slopes are zeros of their own."""
    found, last = list[tuple[S | None, list[S], S | None]](), len(samples) - 1
    for row, sample in enumerate(samples):
        if not is_zero(sample):
            continue
        before, after = samples[row - 1] if row else None, samples[row + 1] if row < last else None
        if before is not None and is_zero(before) and not apart(before, sample):
            found[-1] = (found[-1][0], [*found[-1][1], sample], after)
        else:
            found.append((before, [sample], after))
    return found


def find_stretch(before: S | None, zeros: Sequence[S], after: S | None, at: At[S], tolerance: float) -> Zero[S]:
    """The stretch, or the single value, around samples that are zero.

    before, after : the next samples, which may be zero too where they belong to another zero; None where there is none
    tolerance     : of x at each end
    """
    first, last = zeros[0], zeros[-1]
    if len(zeros) == 1 and steep(first, max(abs(each.x - first.x) for each in (before, after) if each is not None)):
        return _point(before, first, after)
    lower, upper = (_end(first, before, at, tolerance), _end(last, after, at, tolerance))
    bracket = lower.outside or lower.inside, upper.outside or upper.inside
    error, complete = max(lower.error, upper.error), lower.complete and upper.complete
    if upper.inside.x - lower.inside.x > tolerance:
        return Zero(lower.inside, bracket, error, complete, stretch=(lower.inside, upper.inside))
    if not complete or (bracket[0].y * bracket[1].y > 0.0 and not any(map(is_zero, bracket))):
        return Zero(lower.inside, bracket, error, complete, stretch=(lower.inside, lower.inside))
    low, high = bracket
    return Zero(lower.inside, (low, high) if low.y < high.y else (high, low), error, complete)


def _point(before: S | None, zero: S, after: S | None) -> Zero[S]:
    """A sample with a slope that is zero: no other next to it is."""
    known = [each if each is not None and not math.isnan(each.y) else zero for each in (before, after)]
    bracket = (known[0], known[1]) if zero.slope > 0.0 else (known[1], known[0])
    return Zero(zero, bracket, zero.uncertainty / abs(zero.slope), complete=True)


def _end(inside: S, outside: S | None, at: At[S], tolerance: float) -> _End[S]:
    """The end between a sample that is zero and one that is not."""
    if outside is None or is_zero(outside):
        return _End(inside, None, complete=True)
    seen, slow = [outside], False
    for step in range(MOST):
        width = abs(outside.x - inside.x)
        if width <= tolerance or math.isnan(outside.y):
            break
        next_to_it = step == 0 and math.isnan(inside.slope)
        share = 1.0 - SHORT * tolerance / width if next_to_it else _guess(inside, seen, tolerance)
        middle = slow or step >= GUESSES or math.isnan(share)
        sample = at(outside.x + (inside.x - outside.x) * (0.5 if middle else share))
        nearer = not is_zero(sample) and abs(sample.y) < 0.5 * abs(outside.y)
        if is_zero(sample):
            inside = sample
        else:
            outside = sample
            seen.append(sample)
        slow = not nearer and abs(outside.x - inside.x) > 0.5 * width
    return _End(inside, outside, not math.isnan(outside.y) and abs(outside.x - inside.x) <= tolerance)


def _guess(inside: Sample, seen: Sequence[Sample], tolerance: float) -> float:
    """Share of the way from the last sample that is not zero to the one that is; nan without a guess."""
    outside = seen[-1]
    width = inside.x - outside.x
    room = SHORT * tolerance / abs(width)
    slope = outside.slope
    if math.isnan(slope) and len(seen) > 1:
        slope = (outside.y - seen[-2].y) / (outside.x - seen[-2].x)
    if not (math.isfinite(outside.y) and slope * width * outside.y < 0.0):
        return math.nan
    left = math.copysign(inside.uncertainty, outside.y) - outside.y
    share = left / (slope * width) + PAST * tolerance / abs(width)
    return min(max(share, room), 1.0 - room) if share < 1.0 + room else math.nan
