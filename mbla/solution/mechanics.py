"""From the variables of a program to forces, velocities, mechanism and modes of the full model.

The mode says what a contact point does: stick, slide, open or crush. The joint law leaves one of two small at every
point: opening or normal force, sliding or reserve of shear. In numbers neither is zero, so that pairs of ratios are
compared, velocities over the largest contact speed v and forces over the largest of their kind::

    opens    (v_N − s tan ψ)/v > (N + f_t)/N_max          slides   s/v > (μN + c − ‖T‖)/(μN + c)_max
    crushes  −v_N/v > (f_c − N)/N_max

with s = ‖v_T‖ and ψ the dilatancy angle of the flow rule: a joint that slides by associative flow lifts by μ s, and
that is no opening. So the verdict does not depend on how far the solver went.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.program.program import Program
from mbla.program.yield_conditions import YieldLimits
from mbla.solution.nonassociative.law_state import LawState, StepHistory
from mbla.solution.solution import ContactMode, Mechanics

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


def mechanics_of(program: Program, state: LawState, flow_rule: str = "non_associative") -> Mechanics:
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


def lifted(program: Program, state: LawState) -> LawState:
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
