"""The law of elastic joints at a pose, as it is: forces, and how they change with the offsets."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.law.elastic_joints import Memory, lengths, within
from mbla.solution.pushover.moved_joints import JointsAt


def law(at: JointsAt, memory: Memory, length: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Normal forces, (n_points,), shear, (components − 1, n_points), and C = −∂forces/∂offsets, (n_points, c, c).

    A joint that dilates by δ opens by δ times its slip; C has that too.
    """
    joints, limits = at.joints, at.joints.program.limits
    k_n, k_t = joints.normal * length, joints.shear * length
    size = lengths(memory.shear)
    lifts = joints.dilatancy * k_n / k_t
    slides = size > joints.limit(np.clip(memory.normal, -limits.tension, limits.compression))
    share = np.where(slides, 1.0 / (1.0 + lifts * joints.friction), 1.0)
    trial = np.where(slides, (memory.normal + lifts * (size - limits.cohesion)) * share, memory.normal)
    normal = np.clip(trial, -limits.tension, limits.compression)
    elastic = (trial > -limits.tension) & (trial < limits.compression)
    limit = joints.limit(normal)
    shear, slides = within(memory.shear, limit), size > limit
    way = memory.shear / np.maximum(size, 1e-300)
    n, c = len(normal), joints.program.components
    tangent = np.zeros((n, c, c))
    tangent[:, 0, 0] = np.where(elastic, k_n * share, 0.0)
    sticks = np.where(slides, np.where(limit > 1e-8, limit, 0.0) / np.maximum(size, 1e-300), 1.0) * k_t
    for i in range(c - 1):
        tangent[:, 0, 1 + i] = np.where(elastic & slides, lifts * share * k_t * way[i], 0.0)
        tangent[:, 1 + i, 0] = np.where(slides, joints.friction * way[i] * tangent[:, 0, 0], 0.0)
    for i in range(c - 1):
        for j in range(c - 1):
            along = np.where(slides, way[i] * way[j], 0.0)
            tangent[:, 1 + i, 1 + j] = sticks * ((i == j) - along)
            tangent[:, 1 + i, 1 + j] += np.where(slides, joints.friction * way[i] * tangent[:, 0, 1 + j], 0.0)
    return normal, shear, tangent
