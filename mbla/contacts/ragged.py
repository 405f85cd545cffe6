"""Products over ragged arrays: every item of one row with every item of another, without a loop."""

from __future__ import annotations

import numpy as np

from mbla.arrays import IntArray
from mbla.model.ragged import ranges


def rows_and_items(first: IntArray, counts: IntArray) -> tuple[IntArray, IntArray]:
    """Items first[i] ... first[i] + counts[i] - 1 of every row i, and the row of each.

    >>> rows_and_items(np.array([5, 0]), np.array([2, 3]))
    (array([0, 0, 1, 1, 1]), array([5, 6, 0, 1, 2]))
    """
    return np.repeat(np.arange(len(counts)), counts), ranges(first, counts)
