"""What the axles of a travelling load put on the blocks under them, and what of a live load they do not."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.model import TravelPosition
from mbla.model.solids.blocks import Blocks

ROUNDING = 1e-12
"""share of the load of the axles on a block below which what is left of its load is none"""


def without_vehicle(blocks: Blocks, loads: FloatArray, travel: TravelPosition | None) -> FloatArray:
    """Loads on blocks about their centroids less those of the axles that act, (n_blocks, 6) N and N m."""
    if travel is None:
        return loads
    acting = travel.acting
    forces, under = travel.forces[acting], travel.blocks[acting]
    of_axles, sizes = np.zeros_like(loads), np.zeros_like(loads)
    wrenches = np.hstack([forces, np.cross(travel.points[acting] - blocks.centroids[under], forces)])
    np.add.at(of_axles, under, wrenches)
    np.add.at(sizes, under, np.abs(wrenches))
    rest = loads - of_axles
    return np.where(np.abs(rest) <= ROUNDING * sizes.max(axis=1, keepdims=True), 0.0, rest)
