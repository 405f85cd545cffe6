"""From the variables of a program to forces, velocities, mechanism and modes of the full model."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.solution.full_model.contact_modes import contact_modes
from mbla.solution.nonassociative.collapse_state import CollapseState, StepHistory
from mbla.solution.solution import Mechanics


def mechanics_of(program: Program, state: CollapseState, flow_rule: str = "non_associative") -> Mechanics:
    """Mechanics of the model from a state of a program, reduced or not, that was found by the given flow rule."""
    program, state = program.full, lifted(program, state)
    scaling = program.scaling
    live_power = float(program.live_load @ state.velocities)
    velocities = state.velocities / live_power
    contact_forces = scaling.forces(state.forces)
    velocities_of_points = contact_velocities(program, velocities)
    limits = program.limits.scaled(scaling.force * scaling.units)  # in the deck's units
    history = {} if state.history is None else _history(program, state.history)
    return Mechanics(
        load_factor=scaling.load_factor(state.load_factor),
        contact_forces=contact_forces,
        contact_velocities=velocities_of_points,
        mechanism=program.mechanism(velocities),
        modes=contact_modes(contact_forces, velocities_of_points, limits, limits.dilatancy_by(flow_rule)),
        interface_motions=None
        if state.motions is None
        else state.motions * (scaling.live / scaling.force / live_power),
        **history,
    )


def _history(program: Program, history: StepHistory) -> dict[str, FloatArray]:
    """The history of a state of the full model in the deck's units.

    A force is that of the program in units of its point, a velocity that of the program over the same: stiffness grows
    with the square of the unit.
    """
    scaling = program.scaling
    unit = scaling.force * np.broadcast_to(scaling.units, len(history.normal))
    own = {} if history.motions is None else {"crushed": history.motions * (scaling.live / scaling.force)}
    return own | {
        "remembered": scaling.forces(history.remembered),
        "stiffness": np.stack([history.normal, history.shear], axis=1) * (unit**2 / scaling.live)[:, None],
    }


def motion_of(program: Program, velocities: FloatArray) -> FloatArray:
    """Motion of all blocks, (n_blocks, 6), largest entry 1, from the velocities of a program, reduced or not."""
    motion = program.mechanism(velocities)
    largest = np.abs(motion).max(initial=0.0)
    return motion / largest if largest > 0 else motion


def certificate_of(program: Program, velocities: FloatArray) -> tuple[FloatArray, FloatArray | None]:
    """Motion of all blocks, (n_blocks, 6), largest entry 1, and that of the interfaces, (n_interfaces, 2, 6).

    velocities : of a program, reduced or not, unknowns of its conditions on interfaces behind; None without such
    """
    blocks, unknowns = np.split(velocities, [len(program.dead_load)])
    motion, conditions, scaling = program.mechanism(blocks), program.conditions, program.scaling
    largest = max(float(np.abs(motion).max(initial=0.0)), 1e-300)
    if conditions is None:
        return motion / largest, None
    return motion / largest, conditions.moved(unknowns) * (scaling.live / scaling.force / largest)


def forces_of(program: Program, forces: FloatArray) -> FloatArray:
    """Contact forces of the model, (n_points, 3), from those of a program, reduced or not."""
    return program.full.scaling.forces(program.lift.contact_forces(forces))


def lifted(program: Program, state: CollapseState) -> CollapseState:
    """The same state in the program of the full model."""
    lift, history = program.reduction, state.history
    if lift is None:
        return state
    if history is not None:
        normal, shear = lift.stiffness(history.normal), lift.stiffness(history.shear)
        history = StepHistory(lift.contact_forces(history.remembered), normal, shear, history.motions)
    forces, velocities = lift.contact_forces(state.forces), lift.motion(state.velocities)
    return replace(state, forces=forces, velocities=velocities, history=history)


def contact_velocities(program: Program, velocities: FloatArray) -> FloatArray:
    """Velocities at the contact points of a spatial program of the full model in the deck's units, (n_points, 3)."""
    return (
        program.scaling.scaled_forces((program.equilibrium_matrix.T @ velocities).reshape(-1, 3)) * program.scaling.live
    )
