"""States of a non-associative sequence, and how badly they fit the joint law."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.program.yield_conditions import yield_violation
from mbla.solution.mechanics import mechanics_of
from mbla.solution.solution import Mechanics, ProgramRecord, Status


@dataclass(frozen=True)
class LawState:
    """Forces (n_points, 3), velocities (6 n_free,) and load factor of the program, and how badly they fit the law."""

    forces: FloatArray
    velocities: FloatArray
    load_factor: float
    residual: float


@dataclass(frozen=True)
class SequenceResult:
    """Best pair of forces and mechanism of a sequence; status SOLVED where it converged, APPROXIMATE where not."""

    status: Status
    mechanics: Mechanics | None
    reason: str
    programs: tuple[ProgramRecord, ...]


def law_state(
    program: Program, slope: FloatArray | float, forces: FloatArray, velocities: FloatArray, load_factor: float
) -> LawState:
    """A state with its residual, the largest of three.

    Excess over the yield conditions, in mean block loads; closing velocity over the largest contact speed, where the
    joint cannot crush; share of the power balance that the law (dilatancy ``slope``, a tangent) does not explain.
    """
    limits = program.limits
    v = (program.equilibrium_matrix.T @ velocities).reshape(-1, 3)
    sliding = np.hypot(v[:, 1], v[:, 2])
    strength = limits.friction * forces[:, 0] + limits.cohesion
    surplus = v[:, 0] - slope * sliding
    crushable = np.isfinite(limits.compression)
    capacity = np.where(crushable, limits.compression, forces[:, 0])
    unexplained = np.abs(strength * sliding + (forces[:, 1:] * v[:, 1:]).sum(axis=1))
    unexplained += np.abs((forces[:, 0] + limits.tension) * np.maximum(surplus, 0.0))
    unexplained += np.abs((capacity - forces[:, 0]) * np.maximum(-surplus, 0.0))
    dead_power = abs(float(program.dead_load @ velocities))
    balance = max(abs(load_factor), float(np.abs(strength) @ sliding), dead_power, 1e-300)
    speed = max(float(np.linalg.norm(v, axis=1).max(initial=0.0)), 1e-300)
    closing = float(np.where(crushable, 0.0, np.maximum(-v[:, 0], 0.0)).max(initial=0.0)) / speed
    excess = float(yield_violation(forces, limits).max(initial=0.0))
    return LawState(forces, velocities, load_factor, max(excess, closing, float(unexplained.sum()) / balance))


def sequence_mechanics(program: Program, state: LawState) -> Mechanics:
    """Forces, velocities and mechanism of the model that belong to a state."""
    return mechanics_of(program, state.load_factor, state.forces.ravel(), state.velocities)
