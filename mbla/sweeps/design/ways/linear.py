"""A range in equal steps; drawn, all of it equally often."""

from __future__ import annotations

from mbla.arrays import FloatArray
from mbla.sweeps.design.ways.rounding import decimals_of, rounded_within
from mbla.sweeps.design.ways.way import Filled, Vector, Way, WayError, plain, points_of, register
from mbla.sweeps.file.content import LinearRange, Uniform


def steps(start: float, end: float, count: int, whole: int) -> list[float]:
    """The first ``count`` of the values that divide a range into ``whole`` equal steps, both ends exact.

    Those between are rounded to 12 significant digits of the span.
    """
    places = decimals_of(start, end)
    if places is None:
        raise WayError("sweep-values", "has ends that numbers do not tell apart, or lie too far apart for them")
    values = [round(start * (1 - i / whole) + end * (i / whole), places) for i in range(count)]
    values[0] = start
    if count > whole:
        values[-1] = end
    if len(set(values)) < count:
        raise WayError(
            "sweep-values", f"has {count} points that numbers do not tell apart: widen the range, or take fewer"
        )
    return values


def between(start: float, end: float, u: FloatArray) -> list[float]:
    """Values at shares u (n,) of the range, to 12 significant digits."""
    values = start * (1 - u) + end * u
    return rounded_within(values.tolist(), min(start, end), max(start, end))


def at_share(section: LinearRange | Uniform, u: FloatArray, vector: Vector | None) -> Filled:
    """Values at quantiles u (n, 1) where all of the range is equally likely."""
    return plain(between(float(section.start), float(section.end), u[:, 0]))


def _levels(section: LinearRange, vector: Vector | None) -> Filled:
    points = points_of(section)
    return plain(steps(float(section.start), float(section.end), points, points - 1))


register("linear", Way(_levels, at_share, random=False))
