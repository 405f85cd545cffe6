"""Inverses of many small blocks, of which one that is singular spoils no other."""

from __future__ import annotations

import numpy as np

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
