"""Load `acceleration`: mass times an acceleration in units of standard gravity, at the centroids of the blocks.

With a `pattern` the acceleration is multiplied by a factor that depends on height (``height_pattern``).
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import IntArray
from mbla.deck.tree import KeyPath
from mbla.deck.types import Load
from mbla.model.loads.height_pattern import pattern_factors
from mbla.model.loads.load_kind import AppliedLoad, LoadSite
from mbla.model.loads.mass_forces import mass_forces
from mbla.model.wording import counted, vector


def acceleration_load(load: Load, blocks: IntArray | None, path: KeyPath, site: LoadSite) -> AppliedLoad | None:
    """Mass forces on the blocks selected, on all unless some are."""
    assert load.acceleration is not None  # what makes it this kind
    chosen = np.arange(len(site.blocks)) if blocks is None else blocks
    where = "" if len(chosen) == len(site.blocks) else f" on {counted(len(chosen), 'block')}"
    acceleration = np.array(load.acceleration) * site.units.standard_gravity
    words = f"acceleration {vector(load.acceleration)} g{where}"
    pattern = None
    if load.pattern is not None:
        pattern = pattern_factors(load.pattern, chosen, (*path, "pattern"), site)
        if pattern is None:
            return None
        least, most = pattern.means.min(), pattern.means.max()
        words += f" times {least:.6g} to {most:.6g}, by height along {vector(load.pattern.along)}"
    return AppliedLoad(chosen, mass_forces(chosen, acceleration, site, pattern), words)
