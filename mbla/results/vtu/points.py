"""Points of the scene that belong to interfaces: how they move with the mechanism as drawn."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.results.collapse.motion import displacements_at
from mbla.results.vtu.scene import Scene


def interface_displacements(scene: Scene, interfaces: IntArray, points: FloatArray) -> FloatArray:
    """Mean displacement of the two bodies of each interface at a point of it, (n, 3) m; grounds do not move.

    interfaces : (n,)
    points     : (n, 3) m
    """
    total = np.zeros_like(points)
    for side in (0, 1):
        owners = scene.contacts.bodies[interfaces, side]
        block = owners < len(scene.model.blocks)
        total[block] += displacements_at(scene.model.blocks, scene.motion, owners[block], points[block])
    return total / 2
