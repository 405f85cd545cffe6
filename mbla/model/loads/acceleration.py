"""Load `acceleration`: the mass m of blocks, own and added, times an acceleration in standard gravities, F = m a.

A `pattern` multiplies it by a factor that depends on height (:mod:`mbla.model.loads.pattern_factors`).
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import IntArray
from mbla.deck.kinds.load_key import register_load
from mbla.deck.quantities import Vector
from mbla.model.applied_load import AppliedLoad
from mbla.model.loads.load_kind import Entry, LoadKind, LoadSite
from mbla.model.loads.mass_forces import mass_forces
from mbla.model.loads.pattern_factors import pattern_factors
from mbla.model.soil.names import counted_with_soil
from mbla.model.wording import vector


def acceleration_load(entry: Entry, blocks: IntArray | None, site: LoadSite) -> AppliedLoad | None:
    """Mass forces on the blocks selected, (n,), on all unless some are."""
    chosen = np.arange(len(site.blocks)) if blocks is None else blocks
    where = "" if len(chosen) == len(site.blocks) else f" on {counted_with_soil(chosen, site.blocks)}"
    acceleration = np.array(entry.value) * site.units.standard_gravity
    words = f"acceleration {vector(entry.value)} g{where}"
    by_height, pattern = entry.load.pattern, None
    if by_height is not None:
        pattern = pattern_factors(by_height, chosen, (*entry.path, "pattern"), site)
        if pattern is None:
            return None
        least, most = pattern.means.min(), pattern.means.max()
        words += f" times {least:.6g} to {most:.6g}, by height along {vector(by_height.along)}"
    wrenches = mass_forces(chosen, acceleration, site, pattern)
    return AppliedLoad(chosen, wrenches, words, on_masses=True, in_g=pattern is None)


register_load(
    LoadKind(
        name="acceleration",
        section=Vector,
        description="mass-proportional load in units of g = 9.81 m/s^2, pointing where it pushes",
        after="gravity",
        takes=("pattern",),
        build=acceleration_load,
        vector=lambda acceleration: acceleration,
    )
)
