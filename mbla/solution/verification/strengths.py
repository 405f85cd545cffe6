"""Strengths of contact points and what exceeds them, written a second time for verification.

A point carries the strength of its joint law times its share of the area, a tie its own forces::

    ‖T‖ ≤ c + μ N,      −f_t ≤ N ≤ f_c
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.program.yield_conditions.limits import YieldLimits


def point_strengths(model: Model, contacts: Contacts) -> YieldLimits:
    """Strengths of every contact point, (n_points,) [N]."""
    laws = [model.joints[name] for name in contacts.joint_names]
    friction, dilatancy, *per_area = (
        np.array(
            [
                (law.friction, law.dilatancy, law.cohesion, law.tensile_strength, law.compressive_strength)
                for law in laws
            ],
            dtype=np.float64,
        )
        .reshape(-1, 5)[contacts.joints[contacts.interface_of_point]]
        .T
    )
    cohesion, tension, compression = (
        np.multiply(strength, contacts.point_areas, out=np.full_like(strength, np.inf), where=np.isfinite(strength))
        for strength in per_area
    )
    if contacts.ties is not None:
        tension[contacts.tie_points] = contacts.ties.tension
        compression[contacts.tie_points] = contacts.ties.compression
    return YieldLimits(friction, dilatancy, cohesion, tension, compression)


def excess(forces: FloatArray, limits: YieldLimits) -> FloatArray:
    """Largest excess of a force over the strengths of its point, zero where there is none, (n_points,) [N].

    forces : (n_points, 3) N, T1, T2, compression positive
    """
    normal, shear = forces[:, 0], np.hypot(forces[:, 1], forces[:, 2])
    over = shear - (limits.cohesion + limits.friction * normal), -normal - limits.tension, normal - limits.compression
    return np.asarray(np.maximum(np.max(over, axis=0), 0.0))
