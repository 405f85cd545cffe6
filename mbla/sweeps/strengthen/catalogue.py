"""Capacities that there are: those of a catalogue, and above its greatest what several beside each other have.

Of a candidate only those up to its greatest allowed capacity are taken. Sums are searched by their remainders over the
greatest of them: of the sums of the others with one remainder the least is enough, as the greatest makes up the rest.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from heapq import heappop, heappush

import numpy as np

from mbla.arrays import FloatArray

ACCURACY = 1e-4
"""share by which capacities are larger than the program says: its accuracy on large structures"""
ROUNDING = 1e-6
"""share by which a capacity may miss one that there is"""
REMAINDERS = 100_000
"""that are told apart: all, where the capacities of a catalogue are multiples of that part of the greatest"""


def rounded_up(capacities: FloatArray, catalogue: Sequence[float] | None, most: FloatArray) -> FloatArray:
    """Capacities, (k,), as there are: the next in the catalogue, or above its greatest the least sum that is enough.

    most : (k,) greatest ones, of those that there are
    """
    if catalogue is None:
        return np.minimum(capacities * (1.0 + ACCURACY), most)
    return np.minimum(_of_each(capacities, catalogue, most, _next), most)


def greatest_there(most: FloatArray, catalogue: Sequence[float] | None) -> FloatArray:
    """Greatest capacities, (k,), of those that there are, up to given ones, of which none is below the least."""
    if catalogue is None:
        return most
    return np.where(np.isinf(most), np.inf, _of_each(np.nan_to_num(most, posinf=0.0), catalogue, most, _last))


def _of_each(
    capacities: FloatArray,
    catalogue: Sequence[float],
    most: FloatArray,
    found: Callable[[FloatArray, FloatArray], FloatArray],
) -> FloatArray:
    """What a function finds of capacities, (k,), and of the part of the catalogue that is allowed; 0 of 0."""
    values = np.array(catalogue)
    allowed = np.searchsorted(values, most * (1.0 + ROUNDING), side="right")
    answer = np.zeros_like(capacities)
    for count in np.unique(allowed).tolist():
        rows = np.flatnonzero((allowed == count) & (capacities > 0.0))
        answer[rows] = found(capacities[rows], values[:count])
    return answer


def _next(capacities: FloatArray, values: FloatArray) -> FloatArray:
    """The least there are that are no less than capacities, (n,): of one up to the greatest value, of several above."""
    needed, greatest = capacities * (1.0 - ROUNDING), values[-1]
    answer = values[np.minimum(np.searchsorted(values, needed), len(values) - 1)]
    above = np.flatnonzero(needed > greatest)
    if len(above):
        sums = _sums(values, float(needed.max() + values[0]))
        for row in above.tolist():
            several = np.ceil(np.maximum(needed[row] - sums, 0.0) / greatest)
            answer[row] = np.min(sums + several * greatest)
    return answer


def _last(capacities: FloatArray, values: FloatArray) -> FloatArray:
    """The greatest sums that are no more than capacities, (n,)."""
    limits, greatest = capacities * (1.0 + ROUNDING), values[-1]
    sums, answer = _sums(values, float(limits.max(initial=0.0))), np.zeros_like(limits)
    for row, limit in enumerate(limits.tolist()):
        below = sums[sums <= limit]
        answer[row] = np.max(below + np.floor((limit - below) / greatest) * greatest)
    return answer


def _sums(values: FloatArray, limit: float) -> FloatArray:
    """Of all values but the greatest: for each remainder over it the least sum up to a limit, ascending from 0."""
    *smaller, greatest = values.tolist()
    least, waiting = {0: 0.0}, [0.0]
    while waiting:
        total = heappop(waiting)
        for value in smaller:
            more = total + value
            remainder = round(more / greatest * REMAINDERS) % REMAINDERS
            if more <= limit and more < least.get(remainder, np.inf):
                least[remainder] = more
                heappush(waiting, more)
    return np.array(sorted(least.values()))
