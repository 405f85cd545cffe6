"""Mechanisms repaired so that they prove a kinematic bound of the associative load factor.

Velocities compatible with the yield conditions give a load factor at or above the collapse value. The solver's
mechanism is moved, in the metric of the cones' own barrier, towards contact velocities strictly inside their cones.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.process.stopwatch import timed
from mbla.program.program import Program
from mbla.solution.associative.barriers import velocity_hessian
from mbla.solution.linear_algebra.bordered_system import PROGRESS, ROUNDS, bordered_solver
from mbla.solution.linear_algebra.small_blocks import block_diagonal

OPENINGS = (1e-13, 1e-11, 1e-9)
"""Opening velocities, relative to the largest contact speed, that the mechanism is moved towards in turn until it is
compatible; the best one counts. Confined joints cannot open at all: there the smallest leaves least to be charged."""


def repaired_mechanisms(program: Program, velocities: FloatArray) -> Iterator[FloatArray]:
    """The given velocities, (n_rows,) non-dimensional, and versions of them moved towards compatibility.

    Each is found when it is asked for.
    """
    yield velocities
    for opening in OPENINGS:
        u, lack = velocities, np.inf
        for _ in range(ROUNDS):
            moved = _kinematic_correction(program, u, opening)
            if moved is None:
                break
            yield moved
            u, before, lack = moved, lack, incompatibility(program, moved)
            if lack == 0.0:
                return
            if lack > PROGRESS * before:
                break


def incompatibility(program: Program, velocities: FloatArray) -> float:
    """Sum of μ s − v_N over points that cannot crush, where that is positive."""
    v = (program.equilibrium_matrix.T @ velocities).reshape(-1, program.components)
    lack = np.maximum(program.limits.friction * np.linalg.norm(v[:, 1:], axis=1) - v[:, 0], 0.0)
    return float(lack[np.isinf(program.limits.compression)].sum())


@timed("repair")
def _kinematic_correction(program: Program, u: FloatArray, opening: float) -> FloatArray | None:
    """Least change, in the barrier's metric, towards velocities that open by ``opening`` of the largest speed."""
    mu, matrix = program.limits.friction, program.equilibrium_matrix
    v = (matrix.T @ u).reshape(-1, program.components)
    speed = max(float(np.abs(v).max(initial=0.0)), 1e-9 * float(np.abs(u).max(initial=0.0)), 1e-150)
    target = v.copy()
    target[:, 0] = np.maximum(v[:, 0], mu * np.linalg.norm(v[:, 1:], axis=1) + opening * speed)
    weights = velocity_hessian(mu, target)
    # joints that can crush need not open: they only keep the velocity from straying
    weak = 1.0 / (speed * speed)  # not **, which raises beyond numbers
    weights[np.isfinite(program.limits.compression)] = weak * np.eye(program.components)
    metric = block_diagonal(weights)
    solve = bordered_solver(sp.csc_array(matrix @ metric @ matrix.T), program.live_load, np.inf)
    if solve is None:
        return None
    delta = np.zeros_like(u)
    for _ in range(3):
        misfit = target.ravel() - matrix.T @ (u + delta)
        delta = delta + solve(matrix @ (metric @ misfit))[:-1]
    return u + delta if np.isfinite(delta).all() else None
