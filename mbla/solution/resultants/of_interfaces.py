"""What interfaces of a state do, from its forces and motions: resultants and modes of their points."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.program.build import CaseProgram
from mbla.program.resultants import ConvexProgram, assemble_convex
from mbla.program.resultants.crushing import crushing_violation
from mbla.program.resultants.friction_limit import torsion_reserve
from mbla.solution.mechanics import AT_REST, contact_modes, contact_velocities
from mbla.solution.nonassociative.law_state import LawState
from mbla.solution.solution import ContactMode, Mechanics


def of_interfaces(convex: ConvexProgram, mechanics: Mechanics, flow_rule: str) -> Mechanics:
    """With resultants of the interfaces and modes of their points; motions of nothing where none are given."""
    none = np.zeros((convex.n_interfaces, 2, 6))
    motions = none if mechanics.interface_motions is None else mechanics.interface_motions
    moved = replace(mechanics, interface_motions=motions)
    slope = convex.points.limits.dilatancy_by(flow_rule)
    resultants = convex.resultants_of(mechanics.contact_forces)
    return replace(moved, resultants=resultants, modes=modes_of(convex, moved, slope))


def torsion_of_interfaces(program: CaseProgram, mechanics: Mechanics) -> Mechanics:
    """The same of a state with torsion of uniform pressure beside an answer by contact points."""
    model, contacts = program.bodies.model, program.bodies.contacts
    convex = assemble_convex(model, contacts, program.load_case, "convex")
    return of_interfaces(convex, mechanics, "non_associative")


def convex_mechanics(convex: ConvexProgram, state: LawState, dilatancy: FloatArray) -> Mechanics:
    """Mechanics of the model from a state of the program.

    dilatancy : (n_points,) tangent of the dilatancy angle of the flow rule; a point is open where what torsion,
                crushing and dilatancy leave of its motion opens it
    """
    program, scaling = convex.points, convex.points.scaling
    assert state.motions is not None
    live_power = float(program.live_load @ state.velocities)
    velocities, motions = state.velocities / live_power, state.motions / live_power
    to_deck = scaling.live / scaling.force
    forces, moved = scaling.forces(state.forces), contact_velocities(program, velocities)
    return Mechanics(
        load_factor=scaling.load_factor(state.load_factor),
        contact_forces=forces,
        contact_velocities=moved,
        mechanism=program.mechanism(velocities),
        modes=_modes(convex, state, dilatancy),
        resultants=convex.resultants_of(forces),
        interface_motions=to_deck * motions,
    )


def modes_of(convex: ConvexProgram, mechanics: Mechanics, dilatancy: FloatArray) -> IntArray:
    """Modes of the contact points from forces and motions in the deck's units, as ``convex_mechanics`` has them.

    Returned are (n_points,) numbers of ``ContactMode``.

    dilatancy : (n_points,) tangent of the dilatancy angle of the flow rule
    """
    program, scaling = convex.points, convex.points.scaling
    assert mechanics.interface_motions is not None
    state = LawState(
        forces=mechanics.contact_forces / scaling.force,
        velocities=program.velocities(mechanics.mechanism),
        motions=mechanics.interface_motions * (scaling.force / scaling.live),
        load_factor=mechanics.load_factor / scaling.live,
        residual=0.0,
    )
    return _modes(convex, state, dilatancy)


def _modes(convex: ConvexProgram, state: LawState, dilatancy: FloatArray) -> IntArray:
    """Modes of the contact points: by their own motion, and sliding where their interface slips or twists.

    As for points, an interface slips where its speed, as a share of the largest, exceeds what torsion has in reserve.
    """
    program = convex.points
    assert state.motions is not None
    moved = (program.equilibrium_matrix.T @ state.velocities).reshape(-1, 3)
    by_torsion = (convex.resultants.T @ state.motions[:, 0].ravel()).reshape(-1, 3)
    by_crushing = (convex.resultants.T @ state.motions[:, 1].ravel()).reshape(-1, 3)
    speed = float(np.linalg.norm(moved, axis=1).max(initial=0.0))
    modes = contact_modes(state.forces, moved - by_torsion - by_crushing, program.limits, dilatancy, speed)
    reserve = torsion_reserve(convex.torsion, convex.resultants_of(state.forces))
    slips = (
        np.hypot(by_torsion[:, 1], by_torsion[:, 2]) > np.maximum(reserve, AT_REST)[convex.interface_of_point] * speed
    )
    modes = np.where(slips & (modes == ContactMode.STICK), ContactMode.SLIDE, modes)
    crushes = _crushes(convex, state, by_crushing, speed)[convex.interface_of_point]
    modes = np.where(crushes & (by_crushing[:, 0] > 0.0), ContactMode.OPEN, modes)
    return np.where(crushes & (by_crushing[:, 0] < 0.0), ContactMode.CRUSH, modes)


def _crushes(convex: ConvexProgram, state: LawState, by_crushing: FloatArray, speed: float) -> BoolArray:
    """Interfaces that crush, (n_interfaces,): their speed by crushing, as a share of the largest, exceeds what is left.

    What an interface has left counts as a share of the largest normal force.
    """
    limits, found = convex.crushing, np.zeros(convex.n_interfaces, dtype=bool)
    resultants = convex.resultants_of(state.forces)
    left = -crushing_violation(limits, resultants) / np.abs(resultants[:, 0]).max(initial=1e-300)
    own = np.zeros(len(found))
    np.maximum.at(own, convex.interface_of_point, np.abs(by_crushing).max(axis=1))
    found[limits.interfaces] = own[limits.interfaces] > np.maximum(left, AT_REST) * speed
    return found
