"""How badly a state without dilatancy fits the law of points and interfaces of the convex contact model.

An interface that slips by η_1, η_2 and twists moves its points by that much; they slide and open by what remains. Its
friction and torsion resist as much as its normal forces allow, and its motion does not dilate; where it crushes, fields
of stress between nothing and the strength resist by normality.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.resultants import ConvexProgram
from mbla.program.resultants.conditions import RESULTANTS
from mbla.program.resultants.crushing import crushing_violation
from mbla.program.resultants.friction_limit import curve_size, curve_support, friction_limit
from mbla.program.yield_conditions import YieldLimits, yield_violation
from mbla.solution.nonassociative.law_state import LawState
from mbla.solution.resultants.stress_fields import StressFields


def state_without_dilatancy(
    convex: ConvexProgram, forces: FloatArray, velocities: FloatArray, motions: FloatArray, load_factor: float
) -> LawState:
    """A state with its residual, the largest of three.

    Excess over the conditions of points and interfaces, in mean block loads; closing velocity of points by their own
    motion over the largest contact speed; share of the power balance that the law leaves unexplained.

    forces     : (n_points, 3)  non-dimensional, compression positive
    velocities : (n_rows,) of the blocks, non-dimensional
    motions    : (n_interfaces, 2, 6) by torsion and by crushing, non-dimensional
    """
    program, limits = convex.points, convex.torsion
    moved = (program.equilibrium_matrix.T @ velocities).reshape(-1, 3)
    own = convex.own_velocities(moved, motions)
    speed = max(float(np.linalg.norm(moved, axis=1).max(initial=0.0)), 1e-300)
    closing = float(np.where(np.isfinite(program.limits.compression), 0.0, -own[:, 0]).max(initial=0.0)) / speed
    of_points, at_points = _unexplained_at_points(program.limits, forces, own)

    resultants = convex.resultants_of(forces)
    size = friction_limit(limits, resultants)
    r, motion = resultants[limits.interfaces], motions[limits.interfaces, 0]
    slip, twist = np.hypot(motion[:, 1], motion[:, 2]), np.abs(motion[:, 3]) * limits.radii
    of_torsion = size.share * curve_support(slip, twist, limits.thetas) + size.rest * slip
    beyond = np.maximum(np.hypot(r[:, 1], r[:, 2]) - size.rest, 0.0)
    twisting = curve_size(beyond, np.abs(r[:, 3]) / limits.radii, limits.thetas) - size.share
    rows, of_crushing = convex.crushing.interfaces, np.zeros(convex.n_interfaces)
    fields = StressFields.of(convex.shapes, rows, convex.crushing.strength)
    crushed = motions[rows[:, None], 1, RESULTANTS]
    of_crushing[rows] = fields.power(-crushed / fields.scale) + convex.crushing.tension * crushed[:, 0]

    unexplained = at_points + float(np.abs(of_torsion + (r * motion).sum(axis=1)).sum())
    unexplained += float(np.abs(of_crushing + (resultants * motions[:, 1]).sum(axis=1)).sum())
    dead_power = abs(float(program.dead_load @ velocities))
    balance = max(abs(load_factor), dead_power, of_points + float(of_torsion.sum()), 1e-300)
    excess = [yield_violation(forces, program.limits), twisting, crushing_violation(convex.crushing, resultants)]
    worst = max(float(part.max(initial=0.0)) for part in excess)
    return LawState(forces, velocities, load_factor, max(worst, closing, unexplained / balance), motions)


def _unexplained_at_points(limits: YieldLimits, forces: FloatArray, own: FloatArray) -> tuple[float, float]:
    """Power dissipated by sliding, and power that opening, sliding and crushing of points leave unexplained."""
    sliding = np.hypot(own[:, 1], own[:, 2])
    strength = limits.friction * forces[:, 0] + limits.cohesion
    capacity = np.where(np.isfinite(limits.compression), limits.compression, forces[:, 0])
    unexplained = np.abs(strength * sliding + (forces[:, 1:] * own[:, 1:]).sum(axis=1))
    unexplained += np.abs((forces[:, 0] + limits.tension) * np.maximum(own[:, 0], 0.0))
    unexplained += np.abs((capacity - forces[:, 0]) * np.maximum(-own[:, 0], 0.0))
    return float(np.abs(strength) @ sliding), float(unexplained.sum())
