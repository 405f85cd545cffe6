"""Random sparse matrices; scipy's own take their generator under another name from version to version."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp


def random_matrix(shape: tuple[int, int], density: float, rng: np.random.Generator) -> sp.csr_array:
    """Numbers within 0 and 1 at a share of the places."""
    return sp.csr_array(np.where(rng.random(shape) < density, rng.random(shape), 0.0))
