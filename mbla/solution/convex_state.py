"""States of the program with the convex contact model, and how badly they fit the law of points and interfaces."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.program.convex import ConvexProgram
from mbla.program.convex.friction_limit import curve_size, curve_support, friction_limit
from mbla.program.program import Program
from mbla.solution.interface_laws import InterfaceLaws, crushing_excess, crushing_power
from mbla.solution.law_state import law_state


@dataclass(frozen=True)
class ConvexState:
    """A state, non-dimensional.

    forces     : (n_points, 3)
    velocities : (n_block_rows,)
    motions    : (n_interfaces, 2, 6) of the interfaces by torsion and by crushing
    residual   : how badly it fits the law
    """

    forces: FloatArray
    velocities: FloatArray
    motions: FloatArray
    load_factor: float
    residual: float


def laws_of(convex: ConvexProgram) -> InterfaceLaws:
    """Strengths of the interfaces in the program's units."""
    n, torsion = len(convex.shapes.radii), convex.torsion
    friction, cohesion, tension = np.zeros(n), np.zeros(n), np.zeros(n)
    friction[torsion.interfaces], cohesion[torsion.interfaces] = torsion.friction, torsion.cohesion
    strength = np.full(n, np.inf)
    for limits in (convex.rectangles, convex.others):
        strength[limits.interfaces], tension[limits.interfaces] = limits.strength, limits.tension
    shear = (friction > 0) | (cohesion > 0)
    return InterfaceLaws(convex.shapes, friction, cohesion, tension, strength, shear, np.isfinite(strength))


def with_motions(program: Program, motions: sp.csr_array) -> Program:
    """The program with motions of interfaces behind the velocities of the blocks: v = Aᵀu − motionsᵀ w."""
    none = np.zeros(motions.shape[0])
    return replace(
        program,
        equilibrium_matrix=sp.csr_array(sp.vstack([program.equilibrium_matrix, -motions])),
        dead_load=np.concatenate([program.dead_load, none]),
        live_load=np.concatenate([program.live_load, none]),
    )


def state_without_dilatancy(
    convex: ConvexProgram, forces: FloatArray, velocities: FloatArray, motions: FloatArray, load_factor: float
) -> ConvexState:
    """A state with its residual: that of the points (``law_state``), or what is worse of the interfaces' torsion.

    Excess over the conditions, in mean block loads; share of the power balance that motions of interfaces leave
    unexplained.
    """
    limits = convex.torsion
    moving = with_motions(convex.points, convex.resultants)
    own = law_state(moving, 0.0, forces, np.concatenate([velocities, motions.sum(axis=1).ravel()]), load_factor)
    resultants = (convex.resultants @ forces.ravel()).reshape(-1, 6)
    size = friction_limit(limits, resultants)
    r, motion = resultants[limits.interfaces], motions[limits.interfaces, 0]
    slip, twist = np.hypot(motion[:, 1], motion[:, 2]), np.abs(motion[:, 3]) * limits.radii
    rest = np.maximum(size.total - size.share, 0.0)
    dissipated = size.share * curve_support(slip, twist, limits.thetas) + rest * slip
    crushed = crushing_power(laws_of(convex), motions[:, 1])
    of_crushing = float(np.abs(crushed + (resultants * motions[:, 1]).sum(axis=1)).sum())
    crushing = float(crushing_excess(laws_of(convex), resultants).max(initial=0.0))
    beyond = np.maximum(np.hypot(r[:, 1], r[:, 2]) - rest, 0.0)
    excess = curve_size(beyond, np.abs(r[:, 3]) / limits.radii, limits.thetas) - size.share
    unexplained = float(np.abs(dissipated + (r * motion).sum(axis=1)).sum())
    dead_power = abs(float(convex.points.dead_load @ velocities))
    balance = max(abs(load_factor), dead_power, float(dissipated.sum()), 1e-300)
    worst = max(float(excess.max(initial=0.0)), crushing)
    residual = max(own.residual, worst, (unexplained + of_crushing) / balance)
    return ConvexState(forces, velocities, motions, load_factor, residual)
