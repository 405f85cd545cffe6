"""Forces in proportion to the mass of blocks, own and added, each at its own centroid."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.loads.load_kind import LoadSite


def mass_forces(blocks: IntArray, acceleration: FloatArray, site: LoadSite) -> FloatArray:
    """F = m a about the centroids of the blocks; ``acceleration`` (3,) or (n, 3) in length per s2; the result (n, 6).

    An added mass acts where it is, and so brings a moment.
    """
    bodies, unit = site.blocks, site.units.force_per_mass_acceleration
    forces = bodies.masses[blocks, None] * acceleration * unit
    added = bodies.added_masses[blocks, None] * acceleration * unit
    arms = bodies.added_mass_points[blocks] - bodies.centroids[blocks]
    return np.hstack([forces, np.cross(arms, added)])
