"""Where a function of one variable is zero, in few evaluations: between two values with different signs.

Between the nearest values known on both sides of zero the next one is tried. With slopes that is the zero of the cubic
x(y) with values and slopes of the two best ones where these slopes are alike, else of the tangents (Newton): of a
concave function both lie short of its zero, and the further one is better; of a convex one the nearer. Without slopes
it is that of the parabola x(y) through the last three values, or of the secant (Brent 1973). What does not lie between
them, or follows two steps that made little progress, is the middle. A value may be infinite: a structure that does not
stand, or one that no load brings down, is on one side, but has no size.

Where the function scatters, smaller brackets say nothing more, and the search ends
(:mod:`mbla.solution.further.zeros.steps`).

A value that is zero as far as it is known, without a slope that tells where, may be one of a stretch of such values:
its ends are looked for then (:mod:`mbla.solution.further.zeros.stretches`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise

from mbla.solution.further.zeros.samples import S, Sample, Zero, is_zero, level, steep
from mbla.solution.further.zeros.steps import jumps_over, scattered
from mbla.solution.further.zeros.stretches import find_stretch, runs

MOST = 50
"""Evaluations for one zero: bisection alone reaches rounding within that"""
CLOSE = 1e-3
"""Share of the bracket by which the next value keeps from its ends at least, up to half the tolerance"""
ALIKE = 3.0
"""Ratio of slopes up to which a cubic goes through both"""
PATIENCE = 2
"""Steps in a row with little progress that are allowed"""


def scan(low: float, high: float, steps: int, at: Callable[[float], S]) -> list[S]:
    """Samples at equal steps from bound to bound; in the middle too where the two bounds alone are alike."""
    samples = [*(at(low + (high - low) * row / steps) for row in range(steps)), at(high)]
    if steps == 1 and is_level(samples):
        samples.insert(1, at(0.5 * (low + high)))
    return samples


def scan_to_first(low: float, high: float, steps: int, at: Callable[[float], S]) -> list[S]:
    """Samples at equal steps upwards, up to the one with which the function is or has passed zero."""
    samples = list[S]()
    for row in range(steps + 1):
        samples.append(at(high if row == steps else low + (high - low) * row / steps))
        if is_zero(samples[-1]) or any(changes(samples)):
            break
    return samples


def is_level(samples: Sequence[Sample]) -> bool:
    """Whether the function is the same at all samples, as far as it is known."""
    least, greatest = (side(samples, key=lambda each: each.y) for side in (min, max))
    return level(least, greatest) and all(level(one, other) for one, other in pairwise(samples))


def find_zeros(samples: Sequence[S], at: Callable[[float], S], tolerance: float) -> list[Zero[S]]:
    """All that neighbouring samples show, from the least on: passed with a change of sign, or met.

    tolerance : of x
    """
    passed = [find_zero(*pair, at, tolerance) for pair in changes(samples)]
    met = [find_stretch(*run, at, tolerance) for run in runs(samples)]
    return sorted([*passed, *met], key=lambda each: each.best.x)


def changes(samples: Sequence[S]) -> Iterator[tuple[S, S]]:
    """Neighbours of different signs, neither zero; those where nothing is known are left out."""
    known = [each for each in samples if not math.isnan(each.y)]
    for one, other in pairwise(known):
        if (one.y < 0.0) != (other.y < 0.0) and not (is_zero(one) or is_zero(other)):
            yield one, other


def find_zero(one: S, other: S, at: Callable[[float], S], tolerance: float) -> Zero[S]:
    """The zero between two samples with different signs.

    tolerance : of x
    """
    below, above = (one, other) if one.y < 0.0 else (other, one)
    seen, slow = [one, other], 0
    while True:
        best, error = _best(below, above, seen)
        around = scattered(below, above, seen)
        if math.isfinite(around):
            return Zero(best, (below, above), around, complete=True)
        if error <= tolerance or len(seen) > MOST:
            complete = error <= tolerance
            jumps = complete and jumps_over(below, above, seen, error)
            return Zero(best, (below, above), _with_rounding(best, error), complete, jumps)
        middle = 0.5 * (below.x + above.x)
        sample = at(middle if slow >= PATIENCE else _next(below, above, seen, tolerance))
        if math.isnan(sample.y):
            return Zero(best, (below, above), error, complete=False)
        if is_zero(sample) and not steep(sample, abs(other.x - one.x)):
            before, after = (below, above) if below.x < above.x else (above, below)
            return find_stretch(before, [sample], after, at, tolerance)
        replaced, width = below if sample.y < 0.0 else above, abs(above.x - below.x)
        below, above = (sample, above) if sample.y < 0.0 else (below, sample)
        progress = abs(sample.y) < 0.5 * abs(replaced.y) or abs(above.x - below.x) < 0.5 * width
        slow = 0 if progress or slow >= PATIENCE else slow + 1
        seen.append(sample)


def _best(below: S, above: S, seen: Sequence[S]) -> tuple[S, float]:
    """The end nearer to zero, and how far from it that may be: by its slope, or by that to the sample next to it."""
    width, found = abs(above.x - below.x), []
    for end in (below, above):
        slope = end.slope
        if math.isnan(slope) and math.isfinite(end.y):
            others = [each for each in seen if math.isfinite(each.y) and each.x != end.x]
            nearest = min(others, key=lambda each: abs(each.x - end.x), default=end)
            slope = (nearest.y - end.y) / (nearest.x - end.x) if nearest is not end else math.nan
        towards = slope * (above.x - below.x) > 0.0
        distance = abs(end.y / slope) if towards and math.isfinite(end.y) else width
        found.append((end, 0.0 if end.y == 0.0 else min(width, distance)))
    return min(found, key=lambda each: (each[1], abs(each[0].y)))


def _with_rounding(best: Sample, error: float) -> float:
    """The error of x, no less than what the function may be off is worth by its slope."""
    return max(error, best.uncertainty / abs(best.slope)) if is_zero(best) else error


def _next(below: S, above: S, seen: Sequence[S], tolerance: float) -> float:
    """Where to look next: the first guess that lies between the ends, not too near to them."""
    width = above.x - below.x
    room = min(0.5 * tolerance / abs(width), CLOSE)
    for share in _guesses(below, above, seen):
        if 0.0 < share < 1.0:
            return below.x + width * min(max(share, room), 1.0 - room)
    return 0.5 * (below.x + above.x)


def _guesses(below: S, above: S, seen: Sequence[S]) -> Iterator[float]:
    """Shares of the way from the end below zero to the one above."""
    width, rise = above.x - below.x, above.y - below.y
    low, high = below.slope * width, above.slope * width
    towards = [each for each in seen if each.slope * width > 0.0 and math.isfinite(each.y)]
    nearest = sorted(towards, key=lambda each: abs(each.y))[:2]
    if len(nearest) == 2 and nearest[0].y != nearest[1].y:
        yield (_cubic(*nearest) - below.x) / width
    tangents = [-below.y / low] if low > 0.0 else []
    tangents += [1.0 - above.y / high] if high > 0.0 else []
    inside = [share for share in tangents if 0.0 < share < 1.0]
    if inside:
        yield max(inside) if not low < high else min(inside)
    last = [each for each in seen if math.isfinite(each.y)][-3:]
    if len({each.y for each in last}) == 3:
        yield (_parabola(last) - below.x) / width
    if math.isfinite(rise):
        yield -below.y / rise


def _cubic(one: Sample, other: Sample) -> float:
    """x(0) of the cubic with the values and slopes of two samples; nan where their slopes are not alike."""
    first, last = sorted([abs(one.slope), abs(other.slope)])
    if last > ALIKE * first:
        return math.nan
    width, step = other.y - one.y, other.x - one.x
    s = -one.y / width
    curved = s * (1 - s) ** 2 * width / one.slope + s**2 * (s - 1) * width / other.slope
    return one.x + step * s**2 * (3 - 2 * s) + curved


def _parabola(samples: Sequence[Sample]) -> float:
    """x(0) of the parabola through three samples."""
    a, b, c = samples
    return (
        a.x * b.y * c.y / ((a.y - b.y) * (a.y - c.y))
        + b.x * a.y * c.y / ((b.y - a.y) * (b.y - c.y))
        + c.x * a.y * b.y / ((c.y - a.y) * (c.y - b.y))
    )
