"""Parts that cannot interact: free blocks connected through contacts; what does not move connects nothing.

Each part gets the mean dead load of its own blocks as its unit of force, as if it were alone: with forces x = f y and
velocities u = q/f the power of the live load stays what it was, and the load factor too. In the unit of a part a
million times as heavy all its loads would pass for rounding.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from mbla.arrays import FloatArray
from mbla.program.reductions.restrict import chosen_limits, restricted, selection
from mbla.program.reductions.scene import Scene, part_of


def split_into_parts(scene: Scene) -> list[Scene]:
    """One scene a part, in the order of their first blocks; the same scene where all blocks are connected."""
    n = len(scene.centroids)
    both = (scene.bodies >= 0).all(axis=1)
    pairs = scene.bodies[both]
    if scene.allowed is not None:  # blocks of one guided body
        pairs = np.vstack([pairs, np.column_stack(scene.allowed.nonzero()) // 6])
    graph = sp.coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(n, n))
    count, label = connected_components(graph, directed=False)
    if count == 1:
        return [scene]
    part_of_point = label[scene.bodies.max(axis=1)]  # the greater body is free: contacts of fixed bodies are left out
    parts = []
    for part in range(count):
        blocks, points = np.flatnonzero(label == part), np.flatnonzero(part_of_point == part)
        unit = _unit_of_force(scene.loads()[0][blocks])
        program = restricted(
            scene.program,
            sp.csr_array(selection(blocks, n, 6) / unit),
            sp.csr_array(selection(points, scene.program.n_points, 3) * unit),
            chosen_limits(scene.program.limits, points).scaled(1.0 / unit),
        )
        parts.append(part_of(scene, program, blocks, points))
    return parts


def _unit_of_force(dead_load: FloatArray) -> float:
    """Mean dead load of the blocks that have one, (n_blocks, 6); the unit of the whole where none has."""
    sizes = np.linalg.norm(dead_load, axis=1)
    return float(sizes[sizes > 0].mean()) if np.any(sizes > 0) else 1.0
