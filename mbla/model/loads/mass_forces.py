"""Forces in proportion to the mass of blocks, own and added, each at its own centroid."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.loads.height_pattern import PatternFactors
from mbla.model.loads.load_kind import LoadSite


def mass_forces(
    blocks: IntArray, acceleration: FloatArray, site: LoadSite, pattern: PatternFactors | None = None
) -> FloatArray:
    """F = m a about the centroids of the blocks; ``acceleration`` (3,) in length per s2; the result (n, 6).

    An added mass acts where it is, and so brings a moment. With a ``pattern`` the masses count with its factors, which
    are not the same all over a block: its own mass brings a moment, too.
    """
    bodies, unit = site.blocks, site.units.force_per_mass_acceleration
    own = (bodies.volumes * bodies.densities)[blocks]
    added = bodies.added_masses[blocks]
    arms = bodies.added_mass_points[blocks] - bodies.centroids[blocks]
    if pattern is None:
        mass, first_moments = own + added, added[:, None] * arms
    else:
        carried = added * pattern.at_mass
        mass, first_moments = own * pattern.means + carried, own[:, None] * pattern.levers + carried[:, None] * arms
    force = acceleration * unit
    return np.hstack([mass[:, None] * force, np.cross(first_moments, force)])
