"""Random sparse matrices; scipy's own take their generator under another name from version to version."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.solution.linear_algebra import SymmetricPattern
from mbla.solution.linear_algebra.pattern import lower_triangle


def random_matrix(shape: tuple[int, int], density: float, rng: np.random.Generator) -> sp.csr_array:
    """Numbers within 0 and 1 at a share of the places."""
    return sp.csr_array(np.where(rng.random(shape) < density, rng.random(shape), 0.0))


def triangle_of(matrix: sp.sparray) -> tuple[SymmetricPattern, FloatArray]:
    """Pattern and values of the lower triangle of a symmetric matrix, its whole diagonal included."""
    held = sp.csc_array(matrix)
    n = held.shape[0]
    both = sp.coo_array(held + sp.eye_array(n))  # the sum stores every place of both
    row, column = both.coords
    return lower_triangle(sp.csc_array((held.toarray()[row, column], (row, column)), shape=(n, n)))
