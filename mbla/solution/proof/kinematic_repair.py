"""Mechanisms repaired so that they prove a load factor at or above the collapse value.

Velocities compatible with the yield conditions do. The solver's mechanism is moved, in the metric of the cones' own
barrier, towards contact velocities strictly inside them. Conditions on interfaces are further cones: cones @ ψ stand
beside the contact velocities (:mod:`mbla.program.conditions`).
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mbla.arrays import FloatArray
from mbla.process.stopwatch import stage
from mbla.program.program import Program
from mbla.solution.associative.condition_cones import ConditionCones
from mbla.solution.linear_algebra.block_products import block_diagonal
from mbla.solution.linear_algebra.bordered_system import PROGRESS, ROUNDS, bordered_solver
from mbla.solution.proof.metrics import velocity_hessian

OPENINGS = (1e-13, 1e-11, 1e-9)
"""Opening velocities, relative to the largest contact speed, that the mechanism is moved towards in turn until it is
compatible; the best one counts. Confined joints cannot open at all: there the smallest leaves least to be charged."""


def repaired_mechanisms(program: Program, velocities: FloatArray) -> Iterator[FloatArray]:
    """The given velocities, and versions of them moved towards compatibility.

    Each is found when it is asked for.

    velocities : (n_rows + n_unknowns,) of the blocks, then unknowns of the conditions on interfaces; non-dimensional
    """
    yield velocities
    further = ConditionCones.of(program)
    for opening in OPENINGS:
        u, lack = velocities, np.inf
        for _ in range(ROUNDS):
            moved = _kinematic_correction(further, u, opening)
            if moved is None:
                break
            yield moved
            u, before, lack = moved, lack, incompatibility(program, moved)
            if lack == 0.0:
                return
            if lack > PROGRESS * before:
                break


def incompatibility(program: Program, velocities: FloatArray) -> float:
    """Sum of μ s − v_N over points that cannot crush, where that is positive, and of what conditions lack.

    velocities : (n_rows + n_unknowns,)  non-dimensional
    """
    further = ConditionCones.of(program)
    v = further.moving.contact_velocities(velocities)
    lack = np.maximum(program.limits.friction * np.linalg.norm(v[:, 1:], axis=1) - v[:, 0], 0.0)
    of_conditions = further.lack(further.held.T @ velocities)
    return float(lack[np.isinf(program.limits.compression)].sum() + of_conditions.sum())


@stage("repair")
def _kinematic_correction(further: ConditionCones, u: FloatArray, opening: float) -> FloatArray | None:
    """Least change, in the barrier's metric, towards velocities that open by ``opening`` of the largest speed."""
    program = further.moving
    mu, matrix, held = program.limits.friction, program.equilibrium_matrix, further.held
    v = program.contact_velocities(u)
    speed = max(float(np.abs(v).max(initial=0.0)), 1e-9 * float(np.abs(u).max(initial=0.0)), 1e-150)
    target = v.copy()
    target[:, 0] = np.maximum(v[:, 0], mu * np.linalg.norm(v[:, 1:], axis=1) + opening * speed)
    wanted = further.inside_by(held.T @ u, opening)
    weights = velocity_hessian(mu, target)
    # joints that can crush need not open: they only keep the velocity from straying
    weak = 1.0 / (speed * speed)  # not **, which raises beyond numbers
    weights[np.isfinite(program.limits.compression)] = weak * np.eye(program.components)
    metric, of_conditions = block_diagonal(weights), further.hessian(wanted)
    moving, lacking = matrix.T, held.T
    normal = further.with_slacks(matrix @ metric @ moving, of_conditions)
    solve = bordered_solver(normal, program.live_load, np.inf)
    if solve is None:
        return None
    delta = np.zeros_like(u)
    for _ in range(3):
        misfit = matrix @ (metric @ (target.ravel() - moving @ (u + delta)))
        misfit += held @ (of_conditions @ (wanted - lacking @ (u + delta)))
        delta = delta + solve(misfit)[:-1]
    return u + delta if np.isfinite(delta).all() else None
