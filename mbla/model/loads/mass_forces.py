"""Forces of masses under an acceleration."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.loads.load_kind import LoadSite
from mbla.model.loads.pattern_factors import PatternFactors


def mass_forces(
    blocks: IntArray, acceleration: FloatArray, site: LoadSite, pattern: PatternFactors | None = None
) -> FloatArray:
    """F = m a about the centroids of the blocks; ``acceleration`` (3,) in length per s2; the result (n, 15).

    An added mass acts where it is, and so brings a moment. With a ``pattern`` the masses count with its factors, which
    are not the same all over a block: its own mass brings a moment, too.
    """
    bodies, unit = site.blocks, site.units.force_per_mass_acceleration
    own = (bodies.volumes * bodies.densities)[blocks]
    if pattern is None:
        added = bodies.added_masses[blocks]
        arms = bodies.added_mass_points[blocks] - bodies.centroids[blocks]
        mass, first_moments = own + added, added[:, None] * arms
    else:
        mass, first_moments = own * pattern.means + pattern.carried, own[:, None] * pattern.levers + pattern.moments
    force = acceleration * unit
    levers = (first_moments[:, :, None] * force).reshape(-1, 9)
    return np.hstack([mass[:, None] * force, np.cross(first_moments, force), levers])
