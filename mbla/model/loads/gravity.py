"""Loads `gravity` and `acceleration`: the mass m of blocks, own and added, times an acceleration there, F = m a.

Gravity acts in every load case: where its dead loads have none, as 9.81 m/s2 along -z. Accelerations are in units of
standard gravity; a `pattern` multiplies them by a factor that depends on height (``height_pattern``).
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.deck.sections.loads import Load
from mbla.deck.tree import KeyPath
from mbla.deck.units import Units
from mbla.model.loads.height_pattern import PatternFactors, pattern_factors
from mbla.model.loads.load_kind import AppliedLoad, Entry, LoadSite
from mbla.model.wording import counted, vector


def gravity_load(load: Load, blocks: IntArray | None, path: KeyPath, site: LoadSite) -> AppliedLoad:
    """Weights of all blocks, (n_blocks,)."""
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


def acceleration_load(load: Load, blocks: IntArray | None, path: KeyPath, site: LoadSite) -> AppliedLoad | None:
    """Mass forces on the blocks selected, (n,), on all unless some are."""
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
