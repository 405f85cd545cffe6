"""K φ = ω² M φ: the least ω² above nothing, and the motions without stiffness.

In units in which every unknown has a mass of 1. Few unknowns are solved for whole; of more the least are found with
K + ε M factorised (Lanczos' method, from a start that is always the same), and made sharp in their own space.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.solution.linear_algebra.cholesky import factorization
from mbla.solution.linear_algebra.pattern import lower_triangle

DENSE = 400
"""Unknowns up to which all modes are found at once, in a tenth of a second."""

NOTHING = 1e-13
"""ω² over the greatest K/M of an unknown that is none: rounding leaves 1e-15 of it, a tower of n joints has 12/n⁴."""

SHIFT = 1e-12
"""ε over the same."""

BESIDES = 6
"""Modes that are sought beyond those wanted: so many may be motions without stiffness at first."""

SAME = 1e-6
"""Difference of ω², relative, up to which modes are of one frequency."""


@dataclass(frozen=True)
class Eigenpairs:
    """ω² ascending, (n,), φ with φᵀ M φ = 1, (n_unknowns, n), and motions without stiffness, (n_unknowns, k)."""

    squares: FloatArray
    vectors: FloatArray
    loose: FloatArray


def least_eigenpairs(stiffness: sp.csr_array, masses: sp.csr_array, count: int) -> Eigenpairs:
    """The least that are not nothing, so many and those of one frequency with the last.

    stiffness : (n, n) positive semidefinite; masses : (n, n) positive definite
    """
    n = stiffness.shape[0]
    unit = 1.0 / np.sqrt(masses.diagonal())
    k, m = (sp.csr_array(sp.diags_array(unit) @ each @ sp.diags_array(unit)) for each in (stiffness, masses))
    scale = float(k.diagonal().max(initial=0.0))
    wanted = min(count + BESIDES, n)
    while True:
        squares, vectors = _all(k, m) if n <= max(DENSE, 2 * wanted) else _least(k, m, wanted, scale)
        holds = squares > NOTHING * scale
        if int(holds.sum()) >= count or len(squares) == n:
            break
        wanted = min(2 * wanted, n)
    kept = np.flatnonzero(holds)
    kept = kept[: next((group.stop for group in apart(squares[kept]) if group.stop >= count), len(kept))]
    return Eigenpairs(squares[kept], unit[:, None] * vectors[:, kept], unit[:, None] * vectors[:, ~holds])


def _all(k: sp.csr_array, m: sp.csr_array) -> tuple[FloatArray, FloatArray]:
    import scipy.linalg  # late: few load cases ask

    squares, vectors = scipy.linalg.eigh(k.toarray(), m.toarray())
    return squares, vectors


def _least(k: sp.csr_array, m: sp.csr_array, count: int, scale: float) -> tuple[FloatArray, FloatArray]:
    """The ``count`` least."""
    import scipy.linalg
    import scipy.sparse.linalg as spla

    shift = SHIFT * scale
    shifted = sp.csc_array(k + shift * m)
    shifted.sum_duplicates()
    pattern, values = lower_triangle(shifted)
    factors = factorization(pattern)
    if not factors.factorize(values):
        return _all(k, m)
    inverse = spla.LinearOperator(k.shape, matvec=lambda rhs: factors.solve(np.asarray(rhs).ravel()), dtype=np.float64)
    start = np.random.default_rng(0).normal(size=k.shape[0])
    _, space = spla.eigsh(k, count, M=m, sigma=-shift, OPinv=inverse, v0=start, tol=0.0)
    squares, within = scipy.linalg.eigh(space.T @ (k @ space), space.T @ (m @ space))
    return squares, space @ within


def apart(squares: FloatArray) -> list[slice]:
    """Groups of modes of one frequency."""
    new = np.flatnonzero(np.diff(squares, prepend=-np.inf) > SAME * squares).tolist()
    return [slice(start, end) for start, end in zip(new, [*new[1:], len(squares)], strict=False)]
