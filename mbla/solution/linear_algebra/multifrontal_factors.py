"""Cholesky by dense blocks: a multifrontal method on numpy and the LAPACK of scipy; always there.

Each supernode (:mod:`mbla.solution.linear_algebra.supernodes`) is a dense front, to which its children hand what is
left of theirs (Duff and Reid 1983, doi:10.1145/356044.356047; Liu 1992, doi:10.1137/1034004). With L the factor,
every front keeps

    G = [L₁₁⁻¹; −L₂₁ L₁₁⁻¹]

so that a solution is products alone. Fronts of one height in the tree make one sparse matrix each, whose entries they
share.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray
from scipy.linalg.blas import dsyrk, dtrmm
from scipy.linalg.lapack import dpotrf, dtrtri

from mbla.arrays import FloatArray, IntArray
from mbla.solution.linear_algebra.pattern import SymmetricPattern
from mbla.solution.linear_algebra.supernodes import Supernodes, supernodes

KEPT = 3
"""Layouts kept: programs, repair and springs of one structure have the same one or two."""

LONG_RUNS = 14
"""Rows of a run of neighbours, on average, from which fronts are added by runs, not by entries."""


@dataclass(frozen=True)
class _Front:
    """One supernode.

    columns, rows : of its panel [A₁₁; A₂₁]
    entries, panel_place : of the matrix, and where they go in the panel by columns
    level, start  : where the panel is stored
    parent        : front to which the rest is handed, −1 for none
    inside        : places of the rows of the rest in the front of the parent
    split         : how many of them are in the panel of the parent
    runs          : (first, end, place in the parent) of rows that are neighbours there too; empty where they are short
    """

    columns: int
    rows: int
    entries: IntArray
    panel_place: IntArray
    level: int
    start: int
    parent: int
    inside: IntArray
    split: int
    runs: tuple[tuple[int, int, int], ...]


@dataclass(frozen=True)
class _Level:
    """Fronts of one height: columns [begin, end), and where their sparse matrix has its entries, rows from begin on."""

    begin: int
    end: int
    indices: NDArray[np.int32]
    pointers: NDArray[np.int32]


@dataclass(frozen=True)
class _Layout:
    """All that follows from a pattern; unknowns in ``order`` stand by the heights of their fronts."""

    order: IntArray
    levels: tuple[_Level, ...]
    fronts: tuple[_Front, ...]


_LAYOUTS: dict[bytes, _Layout] = {}
"""By digest of the pattern, the oldest first."""


class MultifrontalFactors:
    """Factors of matrices of one pattern; see ``Factorization``."""

    library = "multifrontal"

    def __init__(self, pattern: SymmetricPattern) -> None:
        layout = _layout(pattern)
        self._n, self._order, self._fronts = pattern.n, layout.order, layout.fronts
        self._bounds = [(level.begin, level.end) for level in layout.levels]
        self._levels = [
            sp.csc_array(
                (np.zeros(len(level.indices)), level.indices, level.pointers),
                shape=(pattern.n - level.begin, level.end - level.begin),
            )
            for level in layout.levels
        ]
        self._transposed = [level.T for level in self._levels]
        self._good = False

    def factorize(self, values: FloatArray) -> bool:
        """Factorise; False where the matrix is not positive definite to working accuracy or not finite."""
        self._good = False
        if not np.isfinite(values).all():
            return False
        waiting: list[list[tuple[_Front, FloatArray]]] = [[] for _ in self._fronts]
        for number, front in enumerate(self._fronts):
            rest = self._eliminated(front, values, waiting[number])
            waiting[number] = []
            if rest is None:
                return False
            if front.parent >= 0:
                waiting[front.parent].append((front, rest))
        self._good = True
        return True

    def solve(self, rhs: FloatArray) -> FloatArray:
        """Solution for one right-hand side, (n,), or several, (n, k)."""
        if not self._good:
            raise ValueError("solve without a good factorisation")
        if len(rhs) != self._n:
            raise ValueError(f"a right-hand side of {len(rhs)} rows for a matrix of {self._n}")
        y = np.asarray(rhs, dtype=np.float64)[self._order]
        for level, (start, end) in zip(self._levels, self._bounds, strict=True):
            out = np.asarray(level @ y[start:end])
            y[start:end] = out[: end - start]
            y[end:] += out[end - start :]
        for back, (start, end) in zip(reversed(self._transposed), reversed(self._bounds), strict=True):
            y[start:end] = np.asarray(back @ y[start:])
        answer = np.empty_like(y)
        answer[self._order] = y
        return answer

    def _eliminated(
        self, front: _Front, values: FloatArray, children: list[tuple[_Front, FloatArray]]
    ) -> FloatArray | None:
        """Eliminate the columns of a front; what is left of it, lower triangle, None where it is not definite."""
        s, f = front.columns, front.rows
        flat = self._levels[front.level].data[front.start : front.start + s * f]
        flat[:] = 0.0
        flat[front.panel_place] = values[front.entries]
        panel = flat.reshape(s, f).T
        rest = np.zeros((f - s, f - s), order="F")
        for child, left in children:
            _add(panel, rest, child, left)
        factor, fault = dpotrf(panel[:s], lower=1, clean=1)
        if fault:
            return None
        inverse, fault = dtrtri(factor, lower=1, overwrite_c=1)
        if fault:
            return None
        panel[:s] = inverse
        if f > s:
            below = dtrmm(1.0, inverse, panel[s:], side=1, lower=1, trans_a=1)
            rest = dsyrk(-1.0, below, beta=1.0, c=rest, lower=1, overwrite_c=1)
            panel[s:] = dtrmm(-1.0, inverse, below, side=1, lower=1, overwrite_b=1)
        return rest


def _add(panel: FloatArray, rest: FloatArray, child: _Front, left: FloatArray) -> None:
    """Add what is left of a child, lower triangle, to the front of its parent: panel and rest."""
    s, split = panel.shape[1], child.split
    if not child.runs:
        inside = child.inside
        if split:
            panel[inside[:, None], inside[None, :split]] += left[:, :split]
        if split < len(inside):
            low = inside[split:] - s
            rest[low[:, None], low[None, :]] += left[split:, split:]
        return
    for number, (a, b, to) in enumerate(child.runs):
        target, column, above = (panel, to, 0) if to < s else (rest, to - s, s)
        for c, d, row in child.runs[number:]:
            target[row - above : row - above + d - c, column : column + b - a] += left[c:d, a:b]


def _runs(inside: IntArray, split: int) -> tuple[tuple[int, int, int], ...]:
    """Runs of neighbours, cut where the panel of the parent ends; empty where they are short."""
    cuts = np.flatnonzero(np.diff(inside) != 1) + 1
    if len(inside) < LONG_RUNS * (len(cuts) + 1):
        return ()
    edges = np.unique(np.concatenate([[0], cuts, [split, len(inside)]])).tolist()
    return tuple((a, b, int(inside[a])) for a, b in pairwise(edges))


def _layout(pattern: SymmetricPattern) -> _Layout:
    """The layout of a pattern; that of the last few patterns is kept."""
    digest = hashlib.sha256(pattern.pointers.tobytes() + pattern.indices.tobytes()).digest()
    if digest not in _LAYOUTS:
        while len(_LAYOUTS) >= KEPT:
            _LAYOUTS.pop(next(iter(_LAYOUTS)))
        _LAYOUTS[digest] = _new_layout(pattern, supernodes(pattern))
    return _LAYOUTS[digest]


def _new_layout(pattern: SymmetricPattern, tree: Supernodes) -> _Layout:
    n, widths = pattern.n, np.diff(tree.starts)
    by_height = np.argsort(tree.height, kind="stable")
    post_of_place = np.concatenate(
        [np.zeros(0, dtype=np.int64), *(np.arange(tree.starts[k], tree.starts[k + 1]) for k in by_height)]
    )
    place_of_post = np.empty(n, dtype=np.int64)
    place_of_post[post_of_place] = np.arange(n)
    levels: list[_Level] = []
    starts, begin = np.zeros(len(widths), dtype=np.int64), 0
    for height in range(int(tree.height.max(initial=-1)) + 1):
        indices, lengths, filled = [], [], 0
        for k in np.flatnonzero(tree.height == height).tolist():
            rows = np.concatenate([np.arange(tree.starts[k], tree.starts[k + 1]), tree.below[k]])
            indices.append(np.tile((place_of_post[rows] - begin).astype(np.int32), widths[k]))
            lengths.append(np.full(widths[k], len(rows)))
            starts[k], filled = filled, filled + len(rows) * widths[k]
        pointers = np.concatenate([[0], np.cumsum(np.concatenate(lengths))]).astype(np.int32)
        levels.append(_Level(begin, begin + len(pointers) - 1, np.concatenate(indices), pointers))
        begin += len(pointers) - 1
    return _Layout(tree.order[post_of_place], tuple(levels), tuple(_fronts(pattern, tree, starts)))


def _fronts(pattern: SymmetricPattern, tree: Supernodes, starts: IntArray) -> list[_Front]:
    n, widths = pattern.n, np.diff(tree.starts)
    post = np.empty(n, dtype=np.int64)
    post[tree.order] = np.arange(n)
    one, other = post[pattern.indices], post[pattern.columns()]
    column, row = np.minimum(one, other), np.maximum(one, other)
    owner = np.repeat(np.arange(len(widths)), widths)
    of_entry = owner[column]
    sequence = np.argsort(of_entry, kind="stable")
    cuts = np.searchsorted(of_entry[sequence], np.arange(len(widths) + 1))
    fronts = []
    for k in range(len(widths)):
        entries = sequence[cuts[k] : cuts[k + 1]]
        a, b, rows = int(tree.starts[k]), int(tree.starts[k + 1]), tree.below[k]
        height = b - a + len(rows)
        place = (column[entries] - a) * height + _within(row[entries], a, b, rows)
        over = int(tree.parent[k])
        inside, split = np.zeros(0, dtype=np.int64), 0
        if over >= 0:
            inside = _within(rows, int(tree.starts[over]), int(tree.starts[over + 1]), tree.below[over])
            split = int(np.searchsorted(inside, widths[over]))
        fronts.append(
            _Front(
                b - a,
                height,
                entries,
                place,
                int(tree.height[k]),
                int(starts[k]),
                over,
                inside,
                split,
                _runs(inside, split),
            )
        )
    return fronts


def _within(rows: IntArray, a: int, b: int, below: IntArray) -> IntArray:
    """Places of rows in the front with columns [a, b) and these rows below."""
    return np.where(rows < b, rows - a, b - a + np.searchsorted(below, rows))
