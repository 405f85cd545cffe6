"""Load `gravity`: the mass m of every block times an acceleration g at its centroid, F = m g."""

from __future__ import annotations

import numpy as np

from mbla.arrays import IntArray
from mbla.deck.tree import KeyPath
from mbla.deck.types import Load
from mbla.model.loads.load_kind import AppliedLoad, LoadSite
from mbla.model.loads.mass_forces import mass_forces
from mbla.model.wording import vector


def gravity_load(load: Load, blocks: IntArray | None, path: KeyPath, site: LoadSite) -> AppliedLoad:
    """Weights of all blocks."""
    assert load.gravity is not None  # what makes it this kind
    everywhere = np.arange(len(site.blocks))
    words = f"gravity {vector(load.gravity)} {site.units.length}/s2"
    return AppliedLoad(everywhere, mass_forces(everywhere, np.array(load.gravity), site), words)
