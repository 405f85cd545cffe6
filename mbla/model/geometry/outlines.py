"""Prisms over plane outlines."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.solids.polyhedra import Polyhedra, polyhedra_from_cells


def prism(outline: FloatArray) -> Polyhedra:
    """The prism from y = 0 to y = 1 over an outline (n, 2) given in x and z, in either sense."""
    n = len(outline)
    arms = outline - outline.mean(axis=0)
    ahead = np.roll(arms, -1, axis=0)
    if (arms[:, 0] * ahead[:, 1] - arms[:, 1] * ahead[:, 0]).sum() > 0:  # faces point outwards the other way round
        outline = outline[::-1]
    vertices = np.empty((2, n, 3))
    vertices[:, :, 0], vertices[:, :, 2] = outline[:, 0], outline[:, 1]
    vertices[0, :, 1], vertices[1, :, 1] = 0.0, 1.0
    sides = [(i, (i + 1) % n, (i + 1) % n + n, i + n) for i in range(n)]
    return polyhedra_from_cells(vertices.reshape(1, 2 * n, 3), [range(n)[::-1], range(n, 2 * n), *sides])
