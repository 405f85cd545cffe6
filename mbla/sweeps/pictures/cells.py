"""Points of equal values of some parameters as one cell: its value, or the median of several with their range."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.sweeps.answers import Answer, Answers
from mbla.sweeps.pictures.view import Axis


@dataclass(frozen=True)
class Cells:
    """Arrays with an axis for each axis asked for, in that order.

    value : the point's, or the median of several; nan where there is none
    low, high : least and greatest value of several points; nan where there is none
    answer : of ``Answer``; NO_POINT where there is none
    count : points
    """

    value: FloatArray
    low: FloatArray
    high: FloatArray
    answer: IntArray
    count: IntArray

    def shaped(self, shape: tuple[int, ...]) -> Cells:
        """The same cells in arrays of another shape."""
        value, low, high = (array.reshape(shape) for array in (self.value, self.low, self.high))
        return Cells(value, low, high, self.answer.reshape(shape), self.count.reshape(shape))

    def part(self, *place: int) -> Cells:
        """The cells at a place of the first axes."""
        value, low, high = (array[place] for array in (self.value, self.low, self.high))
        return Cells(value, low, high, self.answer[place], self.count[place])

    @property
    def several(self) -> bool:
        """Whether any cell has more than one point."""
        return bool(self.count.max(initial=0) > 1)


NO_POINT = -1


def pooled(answers: Answers, axes: Sequence[Axis]) -> Cells:
    """The points of a result by their values of some parameters.

    The median is one in rank: what does not stand lies below all values, what nothing brings down above all.
    """
    shape = tuple(len(axis.levels) for axis in axes)
    place = np.ravel_multi_index(tuple(axis.place for axis in axes), shape)
    count = np.bincount(place, minlength=int(np.prod(shape)))
    value, low, high = (np.full(len(count), np.nan) for _ in range(3))
    answer = np.full(len(count), NO_POINT, dtype=np.int64)
    single = count[place] == 1
    answer[place[single]] = answers.answer[single]
    for array in (value, low, high):
        array[place[single]] = answers.values[single]
    order = np.argsort(place, kind="stable")
    for first, cell in zip(np.cumsum(count)[count > 1] - count[count > 1], np.flatnonzero(count > 1), strict=True):
        own = order[first : first + count[cell]]
        answer[cell], value[cell], low[cell], high[cell] = _together(answers, own)
    return Cells(value, low, high, answer, count).shaped(shape)


def _together(answers: Answers, own: IntArray) -> tuple[int, float, float, float]:
    """Answer, median, least and greatest of some points."""
    kinds, values = answers.answer[own], answers.values[own]
    good = values[kinds == Answer.VALUE]
    if answers.categories:
        if len(good) == len(own) and np.ptp(good) == 0:
            return Answer.VALUE, float(good[0]), float(good[0]), float(good[0])
        same = bool(np.all(kinds == kinds[0]) and kinds[0] != Answer.VALUE)
        return (int(kinds[0]) if same else Answer.MIXED), np.nan, np.nan, np.nan
    below, above = int(answers.below[own].sum()), int(answers.above[own].sum())
    ranked = np.sort(np.concatenate([np.full(below, -np.inf), good, np.full(above, np.inf)]))
    if not len(ranked):
        return int(kinds.max()), np.nan, np.nan, np.nan
    lower, upper = ranked[(len(ranked) - 1) // 2], ranked[len(ranked) // 2]
    low, high = (float(good.min()), float(good.max())) if len(good) else (np.nan, np.nan)
    if not np.isfinite(lower):
        return (Answer.NO_EQUILIBRIUM if lower < 0 else Answer.UNBOUNDED), np.nan, low, high
    median = float((lower + upper) / 2) if np.isfinite(upper) else float(lower)
    unknown = len(own) - len(ranked)
    if not unknown:
        return Answer.VALUE, median, low, high
    ends = [np.sort(np.append(ranked, np.full(unknown, end)))[len(own) // 2] for end in (-np.inf, np.inf)]
    return (Answer.PARTLY, median, low, high) if np.isfinite(ends).all() else (int(kinds.max()), np.nan, low, high)
