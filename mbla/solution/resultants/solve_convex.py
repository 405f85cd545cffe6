"""One load case with the convex contact model through the solver stage."""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.errors import Message
from mbla.program.resultants import ConvexProgram
from mbla.program.resultants.crushing import crushing_violation
from mbla.program.resultants.friction_limit import torsion_reserve
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.mechanics import AT_REST, contact_modes, contact_velocities
from mbla.solution.nonassociative.law_state import LawState, SequenceResult
from mbla.solution.resultants.convex_alternation import solve_by_alternation
from mbla.solution.resultants.convex_associative import ConvexAssociative, solve_convex_associative
from mbla.solution.resultants.convex_units import unit_at_collapse
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import ContactMode, Mechanics, Solution, Status
from mbla.solution.solve import recorded
from mbla.solution.standing.claim import as_it_stands
from mbla.solution.standing.standing import assess_dead_load, standing_without_equilibrium

LOCKED = (
    "with dilatancy friction locks the structure under any multiple of the live load; "
    "without dilatancy no state of collapse was found"
)
NOT_SEARCHED = Message(
    "lower-not-searched",
    "states of lower load factors were not looked for: the least found is an upper limit of the least",
)


def solve_convex(convex: ConvexProgram, settings: SolverSettings, log: Log | None = None) -> Solution:
    """Load factor of one load case by the flow rule of the analysis: associative, or non-associative.

    log : called once per iteration of a cone program, as it goes
    """
    started, (iterations, record) = time.perf_counter(), recorded(log)
    solution = _solved(convex, settings, record)
    if settings.standing:
        solution = _with_standing(convex, solution)
    return replace(solution, iterations=tuple(iterations), seconds=time.perf_counter() - started)


def _solved(convex: ConvexProgram, settings: SolverSettings, log: Log) -> Solution:
    analysis = settings.analysis
    associative = solve_convex_associative(convex, settings, log)
    sequence, unit = None, 1.0
    locked = associative.status is Status.UNBOUNDED
    if analysis.flow_rule != "associative" and (associative.state is not None or locked):
        if associative.state is not None:
            unit = unit_at_collapse(convex, associative.state.load_factor)
        sequence = solve_by_alternation(convex, associative, settings, log, unit)
        if locked and sequence.status is not Status.SOLVED:
            sequence = replace(sequence, status=Status.NOT_VERIFIED, state=None, reason=LOCKED)
    mechanics = of_associative = _mechanics(convex, associative.state, convex.points.limits.friction)
    status, reason, programs = associative.status, associative.reason, associative.programs
    if sequence is not None:
        own = convex.in_unit_of_force(unit)
        mechanics = _mechanics(own, sequence.state, np.zeros(convex.points.n_points))
        status, reason, programs = _status(associative, sequence), sequence.reason or reason, sequence.programs
    certificate, motions = _certificate(convex, associative)
    live = convex.points.scaling.live
    return Solution(
        flow_rule=analysis.flow_rule,
        status=status,
        mechanics=mechanics,
        associative=of_associative,
        certificate=certificate,
        reason=reason,
        programs=programs,
        iterations=(),
        seconds=0.0,
        scheme="" if sequence is None else "auto",
        remarks=() if sequence is None else (*sequence.remarks, NOT_SEARCHED),
        certificate_motions=motions,
        contact_model=convex.contact_model,
        stress_blocks=bool(len(convex.crushing.interfaces)),
        solver=settings.solver,
        tolerance_requested=None
        if sequence is None or associative.status is Status.APPROXIMATE
        else sequence.tolerance_requested,
        lock=None if associative.lock is None else convex.points.scaling.forces(associative.lock) / live,
    )


def _with_standing(convex: ConvexProgram, solution: Solution) -> Solution:
    """The standing of the blocks on their contact points; torsion of interfaces is left out."""
    if solution.certificate is not None:
        velocities = convex.points.velocities(solution.certificate)
        return replace(solution, standing=standing_without_equilibrium(convex.points, velocities))
    answered = solution.associative is not None or solution.mechanics is not None  # the latter where the former locks
    decided = answered or solution.status is Status.UNBOUNDED
    standing = assess_dead_load(convex.points, True if decided else None)
    return replace(as_it_stands(solution, standing.verdict), standing=standing)


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


def _mechanics(convex: ConvexProgram, state: LawState | None, dilatancy: FloatArray) -> Mechanics | None:
    return None if state is None else convex_mechanics(convex, state, dilatancy)


def _status(associative: ConvexAssociative, sequence: SequenceResult) -> Status:
    """Never better than that of an associative program with a load factor."""
    weak_start = associative.state is not None and sequence.status is Status.SOLVED
    return associative.status if weak_start else sequence.status


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


def _certificate(convex: ConvexProgram, result: ConvexAssociative) -> tuple[FloatArray | None, FloatArray | None]:
    """Motion of the blocks, largest entry 1, and the motions of the interfaces that belong to it."""
    if result.velocities is None or result.motions is None:
        return None, None
    scaling = convex.points.scaling
    motion = convex.points.mechanism(result.velocities)
    size = max(float(np.abs(motion).max(initial=0.0)), 1e-300)
    return motion / size, scaling.live / scaling.force * result.motions / size
