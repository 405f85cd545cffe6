"""Modes of contact points: what each does in a state of forces and velocities.

The mode says what a contact point does: stick, slide, open or crush. The joint law leaves one of two small at every
point: opening or normal force, sliding or reserve of shear. In numbers neither is zero, so that pairs of ratios are
compared, velocities over the largest contact speed v and forces over the largest of their kind::

    opens    (v_N − s tan ψ)/v > (N + f_t)/N_max          slides   s/v > (μN + c − ‖T‖)/(μN + c)_max
    crushes  −v_N/v > (f_c − N)/N_max

with s = ‖v_T‖ and ψ the dilatancy angle of the flow rule: a joint that slides by associative flow lifts by μ s, and
that is no opening. So the verdict does not depend on how far the solver went.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.program.yield_conditions.limits import YieldLimits
from mbla.solution.solution import ContactMode

AT_REST = 1e-5
"""Share of the largest contact speed up to which a point that carries nothing, free to open or slide, counts as at
rest: velocities of resting points are noise of that size in programs solved to 1e-6."""


def contact_modes(
    forces: FloatArray,
    velocities: FloatArray,
    limits: YieldLimits,
    slope: FloatArray | float,
    largest_speed: float | None = None,
) -> IntArray:
    """Mode of every contact point, (n_points,).

    forces, velocities : (n_points, 3) normal and two tangents, in any units
    limits             : in the units of the forces
    slope              : tangent of the dilatancy angle of the flow rule, (n_points,) or one for all
    largest_speed      : at any contact point, where the velocities are a part of the motion only
    """
    modes = np.full(len(forces), ContactMode.STICK, dtype=np.int64)
    speed = largest_speed or float(np.linalg.norm(velocities, axis=1).max(initial=0.0))
    if speed == 0.0:
        return modes
    sliding = np.hypot(velocities[:, 1], velocities[:, 2])
    strength = np.maximum(limits.friction * forces[:, 0] + limits.cohesion, 0.0)
    reserve = np.maximum(strength - np.hypot(forces[:, 1], forces[:, 2]), 0.0)
    surplus = velocities[:, 0] - slope * sliding
    modes[sliding / speed > np.maximum(_ratio(reserve, strength), AT_REST)] = ContactMode.SLIDE
    pressed = _ratio(np.maximum(forces[:, 0] + limits.tension, 0.0), np.abs(forces[:, 0]))
    modes[surplus / speed > np.maximum(pressed, AT_REST)] = ContactMode.OPEN
    crushable = np.isfinite(limits.compression)
    room = np.where(crushable, limits.compression - forces[:, 0], np.inf) / max(
        float(np.abs(forces[:, 0]).max()), 1e-300
    )
    modes[-velocities[:, 0] / speed > np.maximum(room, AT_REST)] = ContactMode.CRUSH
    return modes


def _ratio(values: FloatArray, scale: FloatArray) -> FloatArray:
    """Values over the largest of their kind; zero where all of these are."""
    largest = float(scale.max(initial=0.0))
    return values / largest if largest > 0.0 else np.zeros_like(values)
