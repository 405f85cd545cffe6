"""Index arithmetic on ragged arrays (see :mod:`mbla.arrays`)."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray


def numbered(codes: IntArray) -> tuple[IntArray, IntArray]:
    """Number of the code of each item, (n,), from 0 in order of first appearance, and where each appears, (n_codes,).

    >>> numbered(np.array([7, 3, 7, 5]))
    (array([0, 1, 0, 2]), array([0, 1, 3]))
    """
    _, first, row = np.unique(codes, return_index=True, return_inverse=True)
    order = np.argsort(first)
    return np.asarray(np.argsort(order)[row.reshape(-1)], dtype=np.int64), np.asarray(first[order], dtype=np.int64)


def ranges(first: IntArray, counts: IntArray) -> IntArray:
    """Concatenated ranges first[i] ... first[i] + counts[i] - 1, (n_items,) from (n,) and (n,).

    >>> ranges(np.array([5, 0]), np.array([2, 3])).tolist()
    [5, 6, 0, 1, 2]
    """
    total = int(counts.sum())
    before = np.cumsum(counts) - counts
    return np.asarray(np.arange(total) + np.repeat(first - before, counts), dtype=np.int64)


def items_of_rows(start: IntArray, rows: IntArray) -> IntArray:
    """Positions (m,) in the flat array of all items of some rows (n,), row by row."""
    return ranges(start[rows], start[rows + 1] - start[rows])


def next_item(start: IntArray) -> IntArray:
    """For each item the position of its successor, (n_items,), in the same row, cyclic; rows must not be empty."""
    successor = np.arange(1, start[-1] + 1)
    successor[start[1:] - 1] = start[:-1]
    return successor


def row_sums(values: FloatArray, start: IntArray) -> FloatArray:
    """Sum of the items of each row, (n_rows, ...), along the first axis; rows must not be empty."""
    return np.add.reduceat(values, start[:-1], axis=0)


def row_means(values: FloatArray, start: IntArray) -> FloatArray:
    """Mean of the items of each row, (n_rows, k) from (n_items, k); rows must not be empty."""
    return row_sums(values, start) / np.diff(start)[:, None]


def row_maxima(values: FloatArray, start: IntArray) -> FloatArray:
    """Largest item of each row, (n_rows, ...), along the first axis; rows must not be empty."""
    return np.maximum.reduceat(values, start[:-1], axis=0)


def row_ranges(values: FloatArray, start: IntArray) -> tuple[FloatArray, FloatArray]:
    """Least and greatest items of each row, (n_rows, ...) each, along the first axis; rows must not be empty."""
    return -row_maxima(-values, start), row_maxima(values, start)


def chunks(counts: IntArray, limit: int) -> list[slice]:
    """Slices of consecutive rows that hold at most ``limit`` items each, or a single longer row.

    >>> chunks(np.array([2, 2, 9, 1]), 4)
    [slice(0, 2, None), slice(2, 3, None), slice(3, 4, None)]
    """
    ends = np.cumsum(counts)
    slices = []
    first = 0
    while first < len(counts):
        before = ends[first] - counts[first]
        last = max(int(np.searchsorted(ends, before + limit, side="right")), first + 1)
        slices.append(slice(first, last))
        first = last
    return slices


def rows_and_items(first: IntArray, counts: IntArray) -> tuple[IntArray, IntArray]:
    """Items first[i] ... first[i] + counts[i] - 1 of every row i, and the row of each.

    >>> rows_and_items(np.array([5, 0]), np.array([2, 3]))
    (array([0, 0, 1, 1, 1]), array([5, 6, 0, 1, 2]))
    """
    return np.repeat(np.arange(len(counts)), counts), ranges(first, counts)
