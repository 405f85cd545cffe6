"""From the variables of a program to forces, velocities, mechanism and modes of the whole model."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.solution.contact_modes import contact_modes
from mbla.solution.nonassociative.law_state import LawState
from mbla.solution.solution import Mechanics


def mechanics_of(program: Program, state: LawState, flow_rule: str = "non_associative") -> Mechanics:
    """Mechanics of the model from a state of a program, reduced or not, that was found by the given flow rule."""
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
        modes=contact_modes(
            state.forces.reshape(-1, 3), velocities_of_points, program.limits, program.limits.dilatancy_by(flow_rule)
        ),
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
    """Velocities at the contact points of a spatial program of the whole model in the deck's units, (n_points, 3)."""
    return (
        program.scaling.scaled_forces((program.equilibrium_matrix.T @ velocities).reshape(-1, 3)) * program.scaling.live
    )
