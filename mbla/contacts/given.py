"""Interfaces that the deck gives, in the form of those that are found."""

from __future__ import annotations

import numpy as np

from mbla.arrays import row_of_item
from mbla.contacts.frames import frames_from_normals
from mbla.contacts.narrow_phase import Patches
from mbla.contacts.overlay import Overlays
from mbla.contacts.polygons import polygons_from_loops, widths
from mbla.model.model import GivenInterfaces, Model


def patches_of(model: Model, given: GivenInterfaces) -> Patches:
    """The interfaces as common surfaces without a gap."""
    n = len(given.bodies)
    row = row_of_item(given.corner_start)
    counts = np.diff(given.corner_start)[:, None]
    origins = np.add.reduceat(given.corners, given.corner_start[:-1], axis=0) / counts
    all_sizes = np.append(model.blocks.sizes, np.full(len(model.grounds), np.inf))
    sizes = all_sizes[given.bodies].min(axis=1)
    frames = frames_from_normals(given.normals)
    arms = (given.corners - origins[row]) / sizes[row, None]
    local = np.einsum("ki,kai->ka", arms, frames[row, 1:])
    polygons = polygons_from_loops(local, given.corner_start)
    nothing = np.full((n, 2), -1, dtype=np.int64)
    overlays = Overlays(given.bodies, nothing, origins, frames, sizes, np.zeros((n, 3)))
    return Patches(overlays, polygons, widths(polygons), np.zeros(n), np.zeros(n), np.ones(n))
