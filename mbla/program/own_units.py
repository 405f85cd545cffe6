"""Units of force of light blocks: what hangs on one heavy block alone is measured by its own load.

A program in units of the mean load says nothing of a block that carries less of it than sixteen digits hold: a block of
1 m on a free one of 10 km is 2e-12 of it. But such a block, or a pile of them, that touches no more than one heavier
body cannot be pressed by anything but its own loads. Its rows of equilibrium, and the forces at its contacts, are then
measured by these; in the row of the heavy block the latter are as small as they are.

A light block between two heavy ones carries what they press through it, as does one between a heavy block and a guide,
and keeps their unit.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray

LIGHT = 1e-8
"""Load of a block over the mean load, below which it gets a unit of its own: above it the common one is sharp enough
(:mod:`mbla.results.magnitudes`)."""


def own_units(loads: FloatArray, bodies: IntArray) -> FloatArray:
    """Unit of each free block over the mean load, (n_free,); 1 but for light ones.

    loads  : (n_free,) over the mean load
    bodies : (n_interfaces, 2) free blocks by their number among these, −1 for everything that does not move
    """
    light = (loads > 0) & (loads < LIGHT)
    units = np.ones(len(loads))
    if not light.any():
        return units
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    is_light = np.append(light, False)[bodies]  # −1 takes the last entry
    inside, edge = bodies[is_light.all(axis=1)], bodies[is_light.sum(axis=1) == 1]
    shape = (len(loads), len(loads))
    pile = connected_components(coo_array((np.ones(len(inside)), inside.T), shape=shape), directed=False)[1]
    second = np.append(light, False)[edge[:, 1]]
    lighter, heavier = np.where(second, edge[:, ::-1].T, edge.T)
    touched = np.unique(np.stack([heavier, pile[lighter]], axis=1), axis=0)
    alone = np.bincount(touched[:, 1], minlength=len(loads)) <= 1
    largest = np.zeros(len(loads))
    np.maximum.at(largest, pile, loads)
    own = light & alone[pile]
    units[own] = largest[pile[own]]
    return units
