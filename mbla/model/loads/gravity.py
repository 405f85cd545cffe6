"""Load `gravity`: the mass m of every block times an acceleration g at its centroid, F = m g.

It acts in every load case: where its dead loads have none, as 9.81 m/s2 along -z.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from mbla.arrays import IntArray
from mbla.deck.tree import KeyPath
from mbla.deck.types import Load
from mbla.deck.units import Units
from mbla.model.loads.load_kind import AppliedLoad, LoadSite
from mbla.model.loads.mass_forces import mass_forces
from mbla.model.loads.named_loads import Entry
from mbla.model.wording import vector


def gravity_load(load: Load, blocks: IntArray | None, path: KeyPath, site: LoadSite) -> AppliedLoad:
    """Weights of all blocks."""
    everywhere = np.arange(len(site.blocks))
    words = "no gravity" if load.gravity == "none" else f"gravity {vector(vector_of(load))} {site.units.length}/s2"
    return AppliedLoad(everywhere, mass_forces(everywhere, np.array(vector_of(load)), site), words)


def vector_of(load: Load) -> tuple[float, float, float]:
    """The acceleration of a load `gravity`, in the deck's unit of length per s2."""
    assert load.gravity is not None  # what makes it this kind
    return (0.0, 0.0, 0.0) if load.gravity == "none" else load.gravity


def with_gravity(dead: Iterable[Entry], path: KeyPath, units: Units) -> list[Entry]:
    """The dead loads of a case, before them 9.81 m/s2 along -z where none of them is gravity."""
    entries = list(dead)
    if any(entry.load.gravity is not None for entry in entries):
        return entries
    usual = Load.model_construct(gravity=(0.0, 0.0, -units.standard_gravity))
    return [Entry(usual, path, 1.0), *entries]
