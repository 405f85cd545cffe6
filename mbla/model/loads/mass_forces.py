"""Forces in proportion to the mass of blocks, at their centroids."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.loads.load_kind import LoadSite


def mass_forces(blocks: IntArray, acceleration: FloatArray, site: LoadSite) -> FloatArray:
    """F = m a; ``acceleration`` (3,) or (n, 3) in length per s2; the result (n, 6), without moments."""
    masses = site.blocks.masses[blocks]
    forces = masses[:, None] * acceleration * site.units.force_per_mass_acceleration
    return np.hstack([forces, np.zeros_like(forces)])
