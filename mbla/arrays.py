"""Names for the array types that every stage passes on, and the one ragged-array idiom.

Ragged arrays (vertices of blocks, corners of faces, contact points of interfaces) are stored flat with
a ``start`` array of n + 1 offsets: the items of row i are ``flat[start[i]:start[i + 1]]``.
"""

from __future__ import annotations

from dataclasses import fields, is_dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

FloatArray: TypeAlias = NDArray[np.float64]
IntArray: TypeAlias = NDArray[np.int64]
BoolArray: TypeAlias = NDArray[np.bool_]
ByteArray: TypeAlias = NDArray[np.uint8]


def starts(counts: IntArray) -> IntArray:
    """Offsets of a ragged array, (n + 1,), from the number of items of each row, (n,)."""
    start = np.zeros(len(counts) + 1, dtype=np.int64)
    np.cumsum(counts, out=start[1:])
    return start


def summed(owner: IntArray, values: NDArray[Any], count: int) -> FloatArray:
    """Sum of the values of each owner, (count, ...) from (n_values, ...)."""
    total = np.zeros((count, *values.shape[1:]))
    np.add.at(total, owner, values)
    return total


def row_of_item(start: IntArray) -> IntArray:
    """Row to which each item of a ragged array belongs, (n_items,)."""
    return np.repeat(np.arange(len(start) - 1), np.diff(start))


def evenly(count: int, most: int) -> list[int]:
    """At most so many of the rows 0 to count - 1, evenly chosen, the first and the last among them."""
    chosen: list[int] = np.unique(np.linspace(0, count - 1, most).astype(int)).tolist()
    return chosen


def distinct(values: IntArray) -> IntArray:
    """The different values of an array of one dimension, ascending.

    By sorting: ``np.unique`` gathers integers in a hash table, which took sixteen times as long for the places of the
    entries of a stiffness matrix of 1,000 blocks (numpy 2.4).
    """
    ordered = np.sort(values)
    first = np.ones(len(ordered), dtype=bool)
    np.not_equal(ordered[1:], ordered[:-1], out=first[1:])
    return ordered[first]


def alike(one: Any, other: Any) -> bool:
    """Whether two records are the same in every number of their arrays, sparse matrices and records; nan never is.

    In which order the entries of a sparse matrix are stored does not count: scipy sorts them where it needs that.
    """
    if one is other:
        return True
    if type(one) is not type(other):
        return False
    if isinstance(one, np.ndarray):
        return one.dtype == other.dtype and np.array_equal(one, other)
    if hasattr(one, "sorted_indices"):
        one, other = one.sorted_indices(), other.sorted_indices()
        names: tuple[str, ...] = ("shape", "indptr", "indices", "data")
    elif is_dataclass(one):
        names = tuple(each.name for each in fields(one))
    else:
        return bool(one == other)
    return all(alike(getattr(one, name), getattr(other, name)) for name in names)
