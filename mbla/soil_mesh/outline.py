"""How corners of cells may move and leave the outline of the soil, and all that touches it, as they are.

Corners inside move freely. One between two edges of the outline that lie on one line, with the same things beyond,
slides along it. All others stay.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.soil_mesh.planar_scene import cross

STRAIGHT = 1e-6
"""sine of the angle of two edges up to which they are on one line"""


def outline_of(triangles: IntArray) -> IntArray:
    """Edges that one triangle has alone, (n, 2), in its sense."""
    edges = np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    _, which, count = np.unique(np.sort(edges, axis=1), axis=0, return_inverse=True, return_counts=True)
    return np.asarray(edges[count[which.ravel()] == 1])


def corner_motions(points: FloatArray, outline: IntArray, beyond: IntArray, held: BoolArray) -> sp.csr_array:
    """Displacements of points, (n_points, 2), that unknowns stand for, (2 n_points, n_unknowns).

    outline : (n, 2) edges, the soil on the left
    beyond  : (n,) number of what is beyond each edge
    held    : (n_points,) points that stay
    """
    n = len(points)
    times = np.bincount(outline.ravel(), minlength=n)
    before, after = (np.full(n, -1, dtype=np.int64) for _ in range(2))
    before[outline[:, 1]] = after[outline[:, 0]] = np.arange(len(outline))
    along = points[outline[:, 1]] - points[outline[:, 0]]
    along = along / np.linalg.norm(along, axis=1)[:, None]
    ends = np.flatnonzero((times == 2) & ~held & (before >= 0) & (after >= 0))
    first, second = before[ends], after[ends]
    straight = np.abs(cross(along[first], along[second])) < STRAIGHT
    slides = ends[straight & (beyond[first] == beyond[second])]
    free = np.flatnonzero((times == 0) & ~held)
    n_free, n_slides = 2 * len(free), len(slides)
    rows = np.concatenate([2 * free, 2 * free + 1, 2 * slides, 2 * slides + 1])
    columns = np.concatenate([np.arange(n_free), np.tile(n_free + np.arange(n_slides), 2)])
    values = np.concatenate([np.ones(n_free), along[before[slides]].T.ravel()])
    return sp.csr_array((values, (rows, columns)), shape=(2 * n, n_free + n_slides))
