"""The direction across the plane of a planar problem: the width, along which forces stand for as many side by side."""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model

ROUNDING = 1e-6
"""sine of an angle, and share of a length or a load, that count as none"""
TINY = float(np.finfo(float).tiny)


def width_of(model: Model, contacts: Contacts, load_case: LoadCase) -> FloatArray | None:
    """Unit normal of the one plane that has the centroids of free blocks, joints edge-on and loads in it, (3,).

    None where there is no such plane, and where there are several.
    """
    free = model.free
    if not len(free) or not len(contacts):
        return None
    size = float(model.blocks.sizes[free].max())
    offsets = model.blocks.centroids[free] - model.blocks.centroids[free].mean(axis=0)
    joints = (contacts.centroids - model.blocks.centroids[free].mean(axis=0)).mean(axis=0, keepdims=True)
    rows = [contacts.normals, offsets / size, model.ties.pulls, joints / size]
    for load in (load_case.dead_load[free], load_case.live_load[free]):
        forces, moments = (float(np.linalg.norm(part, axis=1).max()) for part in (load[:, :3], load[:, 3:]))
        most = max(forces, moments / size, TINY)
        rows += [load[:, :3] / most, *(np.cross(axis, load[:, 3:] / (most * size)) for axis in np.eye(3))]
    in_plane = np.concatenate(rows)
    _, sizes, ways = np.linalg.svd(in_plane.T @ in_plane)
    one, normal = sizes[1] > ROUNDING * sizes[0], ways[2]
    return np.asarray(normal) if one and np.abs(in_plane @ normal).max() <= ROUNDING else None


def in_plane_axes(axes: FloatArray, width: FloatArray | None) -> BoolArray:
    """Which axes of blocks, (n_blocks, 3, 3), run across the width; (n_blocks, 3), all where there is none."""
    if width is None:
        return np.ones(axes.shape[:2], dtype=bool)
    return np.asarray(np.linalg.norm(np.cross(axes, width), axis=2) > ROUNDING)
