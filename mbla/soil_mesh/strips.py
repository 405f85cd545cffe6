r"""Loads that press on strips of the top of soil: what cells carry of them follows from where their corners are.

A strip from :math:`x_0` to :math:`x_1` with the force t per length loads a cell whose top edge reaches from a to b by

.. math:: P = \int_{\max(a, x_0)}^{\min(b, x_1)} t · v(x) \, dx, \quad ∂P/∂b = t · v(b), \quad ∂P/∂a = −t · v(a)

where a or b lie within the strip.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.soil_mesh.planar_scene import PlanarScene, cross, turned


def strip_loads(scene: PlanarScene, points: FloatArray, strips: FloatArray) -> FloatArray:
    """Forces and moments of strips, (n, 4), on bodies about their centres, (n_bodies, 3)."""
    loads = np.zeros((len(scene.centres), 3))
    if not len(strips):
        return loads
    ends = points[scene.tops]
    begin = np.maximum(ends[:, 0, None, 0], strips[:, 0])
    lengths = np.maximum(np.minimum(ends[:, 1, None, 0], strips[:, 1]) - begin, 0.0)
    level = begin + lengths / 2.0
    slope = (ends[:, 1, 1] - ends[:, 0, 1]) / (ends[:, 1, 0] - ends[:, 0, 0])
    middle = np.stack([level, ends[:, 0, None, 1] + slope[:, None] * (level - ends[:, 0, None, 0])], axis=-1)
    forces = lengths[..., None] * strips[:, 2:]
    moments = cross(middle - scene.centres[scene.under][:, None], forces)
    np.add.at(loads, scene.under, np.concatenate([forces, moments[..., None]], axis=-1).sum(axis=1))
    return loads


def strip_power_gradient(scene: PlanarScene, points: FloatArray, strips: FloatArray, motions: FloatArray) -> FloatArray:
    """Derivatives of the power of strips, (n, 4), by coordinates of points, (n_points, 2), at motions (n_bodies, 3)."""
    gradient = np.zeros_like(points)
    if not len(strips):
        return gradient
    own, centres = motions[scene.under], scene.centres[scene.under]
    for end, sign in ((0, -1.0), (1, 1.0)):
        places = points[scene.tops[:, end]]
        within = (places[:, 0, None] > strips[:, 0]) & (places[:, 0, None] < strips[:, 1])
        velocities = own[:, :2] + own[:, 2:] * turned(places - centres)
        np.add.at(gradient[:, 0], scene.tops[:, end], sign * (velocities * (within @ strips[:, 2:])).sum(axis=1))
    return gradient
