"""Many small blocks: their inverses, of which one that is singular spoils no other, and the matrix that they are."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray


def inverses(blocks: FloatArray) -> FloatArray:
    """Inverse of each block, (n, k, k); not-a-number throughout a block that is exactly singular.

    Whoever asks sees by ``np.isfinite`` that there is no inverse, as where the entries have overflowed.
    """
    try:
        return np.asarray(np.linalg.inv(blocks), dtype=np.float64)
    except np.linalg.LinAlgError:
        found = np.full(blocks.shape, np.nan)
        for number, block in enumerate(blocks):
            try:
                found[number] = np.linalg.inv(block)
            except np.linalg.LinAlgError:
                continue
        return found


def block_diagonal(blocks: FloatArray) -> sp.csr_array:
    """The matrix, (n k, n k), with these blocks, (n, k, k), on its diagonal."""
    n, size = blocks.shape[:2]
    return sp.csr_array(sp.bsr_array((blocks, np.arange(n), np.arange(n + 1)), shape=(size * n, size * n)))
