"""Supernodes: columns of a Cholesky factor with like structure, taken together as dense blocks.

The order of elimination is that of approximate minimum degree. Of its elimination tree whole subtrees of few columns
become one supernode each, and a column and its parent are taken together where that stores few zeros (Ashcraft and
Grimes 1989, doi:10.1145/76909.76910). A supernode is a run of columns [a, b) of the tree in postorder; below them it
has the rows of its last column.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import depth_first_order

from mbla.arrays import IntArray
from mbla.solution.linear_algebra.pattern import SymmetricPattern
from mbla.solution.linear_algebra.qdldl_factors import structure_of_factor

SUBTREE = 40
"""Columns of a subtree that is one supernode: a dense block of that size takes less time than its parts would."""

ZEROS = ((16, 0.8), (48, 0.2), (10**9, 0.06))
"""Columns of a supernode up to which that share of its entries may be zeros."""


@dataclass(frozen=True)
class Supernodes:
    """Supernodes of a pattern in the order of elimination, children before parents.

    order  : (n,) unknown at each place of the postorder
    starts : (n_supernodes + 1,) first column of each
    below  : for each its rows below the diagonal block, ascending places
    parent : (n_supernodes,) −1 for roots
    height : (n_supernodes,) 0 for leaves, else one more than that of the highest child
    """

    order: IntArray
    starts: IntArray
    below: tuple[IntArray, ...]
    parent: IntArray
    height: IntArray


def supernodes(pattern: SymmetricPattern) -> Supernodes:
    """Order of elimination and supernodes of a pattern."""
    factor, permutation = structure_of_factor(pattern)
    n = pattern.n
    counts = np.diff(factor.indptr)
    parent = np.full(n, n, dtype=np.int64)
    parent[counts > 0] = factor.indices[factor.indptr[:-1][counts > 0]]
    post = _postorder(parent, n)
    place = np.empty(n + 1, dtype=np.int64)
    place[post], place[n] = np.arange(n), n
    parent, counts = place[parent[post]], counts[post]
    starts = _starts(parent, counts)
    below = tuple(
        np.sort(place[factor.indices[factor.indptr[last] : factor.indptr[last + 1]]]) for last in post[starts[1:] - 1]
    )
    owner = np.repeat(np.arange(len(below)), np.diff(starts))
    above = np.array([owner[rows[0]] if len(rows) else -1 for rows in below], dtype=np.int64)
    height = np.zeros(len(below), dtype=np.int64)
    for number, over in enumerate(above.tolist()):
        if over >= 0:
            height[over] = max(height[over], height[number] + 1)
    return Supernodes(permutation[post], starts, below, above, height)


def _postorder(parent: IntArray, n: int) -> IntArray:
    """Columns so that every subtree is a run that ends with its root: a walk from the root on, backwards."""
    children = sp.csr_array((np.ones(n), (parent, np.arange(n))), shape=(n + 1, n + 1))
    walk = depth_first_order(children, n, directed=True, return_predecessors=False)
    return np.asarray(walk[:0:-1], dtype=np.int64)


def _starts(parent: IntArray, counts: IntArray) -> IntArray:
    """First columns of the supernodes, and n; ``counts``: entries of each column below the diagonal."""
    n = len(parent)
    size = _subtree_sizes(parent)
    over = np.append(size, n + SUBTREE + 1)[parent]
    small = (size <= SUBTREE) & (over > SUBTREE)
    begins, ends = np.flatnonzero(small) - size[small] + 1, np.flatnonzero(small)
    inside = np.zeros(n + 1, dtype=np.int64)
    np.add.at(inside, begins, 1)
    np.add.at(inside, ends + 1, -1)
    in_subtree = np.cumsum(inside[:n]) > 0
    spans = [(int(a), int(b) + 1) for a, b in zip(begins, ends, strict=True)]
    spans = sorted(spans + [(int(j), int(j) + 1) for j in np.flatnonzero(~in_subtree)])
    kept: list[tuple[int, int, float]] = []  # first column, end, zeros stored
    up, height = parent.tolist(), counts.tolist()
    for a, b in spans:
        zeros = 0.0
        while kept and up[kept[-1][1] - 1] < b and up[kept[-1][1] - 1] >= a:
            first, middle, stored = kept[-1]
            wide, narrow = middle - first, b - a
            added = wide * (narrow + height[b - 1] - height[middle - 1])
            entries = (wide + narrow) * (wide + narrow + 1) / 2 + (wide + narrow) * height[b - 1]
            allowed = next(share for columns, share in ZEROS if wide + narrow <= columns)
            if zeros + stored + added > allowed * entries:
                break
            zeros, a = zeros + stored + added, first
            kept.pop()
        kept.append((a, b, zeros))
    return np.array([*(span[0] for span in kept), n], dtype=np.int64)


def _subtree_sizes(parent: IntArray) -> IntArray:
    """Columns of the subtree of each column of a postordered tree."""
    sizes, up = [1] * (len(parent) + 1), parent.tolist()
    for column, over in enumerate(up):
        sizes[over] += sizes[column]
    return np.array(sizes[:-1], dtype=np.int64)
