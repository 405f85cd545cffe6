"""From the variables of a program to forces, velocities, mechanism and modes of the whole model."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.program.program import Program
from mbla.solution.law_state import LawState
from mbla.solution.solution import ContactMode, Mechanics


def mechanics_of(program: Program, state: LawState) -> Mechanics:
    """Mechanics of the model from a state of a program, reduced or not."""
    while program.reduction is not None:
        state, program = lifted(program, state), program.reduction.full
    scaling = program.scaling
    velocities = state.velocities / (program.live_load @ state.velocities)
    contact_forces = scaling.forces(state.forces)
    velocities_of_points = contact_velocities(program, velocities)
    return Mechanics(
        load_factor=scaling.load_factor(state.load_factor),
        contact_forces=contact_forces,
        contact_velocities=velocities_of_points,
        mechanism=program.mechanism(velocities),
        modes=contact_modes(contact_forces, velocities_of_points),
    )


def motion_of(program: Program, velocities: FloatArray) -> FloatArray:
    """Motion of all blocks, (n_blocks, 6), largest entry 1, from the velocities of a program, reduced or not."""
    while program.reduction is not None:
        velocities, program = program.reduction.velocities @ velocities, program.reduction.full
    motion = program.mechanism(velocities)
    largest = np.abs(motion).max(initial=0.0)
    return motion / largest if largest > 0 else motion


def forces_of(program: Program, forces: FloatArray) -> FloatArray:
    """Contact forces of the model, (n_points, 3), from those of a program, reduced or not."""
    while program.reduction is not None:
        full = program.reduction.full
        forces = (program.reduction.forces @ forces.ravel()).reshape(-1, full.components)
        program = full
    return program.scaling.forces(forces)


def lifted(program: Program, state: LawState) -> LawState:
    """The same state in the program that was reduced to this one."""
    assert program.reduction is not None
    full = program.reduction.full
    forces = (program.reduction.forces @ state.forces.ravel()).reshape(-1, full.components)
    return LawState(forces, program.reduction.velocities @ state.velocities, state.load_factor, state.residual)


def contact_velocities(program: Program, velocities: FloatArray) -> FloatArray:
    """Velocities at the contact points of the whole model in the deck's units, (n_points, 3)."""
    # the rows of the matrix carry the program's units; undo them to get velocities in the deck's units
    scaling = program.scaling
    physical = scaling.velocities(velocities).ravel()
    return (program.equilibrium_matrix.T @ (physical / (scaling.row * scaling.force))).reshape(-1, 3)


def contact_modes(contact_forces: FloatArray, contact_velocities: FloatArray) -> IntArray:
    """Mode of every contact point, (n_points,).

    Complementarity leaves one of two small: a point is open where its opening velocity over the largest contact speed
    exceeds its normal force over the largest one, else it slides where its sliding speed is not negligible. Ratios, not
    a threshold on velocities, so that the verdict does not depend on how far the solver went.
    """
    normal_force, normal_velocity = contact_forces[:, 0], contact_velocities[:, 0]
    sliding = np.hypot(contact_velocities[:, 1], contact_velocities[:, 2])
    speed = np.linalg.norm(contact_velocities, axis=1).max(initial=0.0)
    force = np.abs(normal_force).max(initial=0.0)
    modes = np.full(len(normal_force), ContactMode.STICK, dtype=np.int64)
    if speed == 0.0 or force == 0.0:
        return modes
    modes[sliding > 1e-5 * speed] = ContactMode.SLIDE
    opens = (normal_velocity / speed > np.maximum(normal_force / force, 0.0)) & (normal_velocity > 1e-5 * speed)
    modes[opens] = ContactMode.OPEN
    return modes
