"""One load case with the convex contact model through the solver stage."""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.deck.analysis import AnalysisSection
from mbla.program.convex import ConvexProgram, convex_form
from mbla.solution.associative import AssociativeResult, solve_associative_form
from mbla.solution.clarabel_adapter import FALLBACK_REGULARIZATION, Log
from mbla.solution.law_state import LawState
from mbla.solution.mechanics import contact_modes, contact_velocities
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import IterationRecord, Mechanics, ProgramRecord, Solution, Status


def solve_convex(
    convex: ConvexProgram, analysis: AnalysisSection, settings: SolverSettings, log: Log | None = None
) -> Solution:
    """Load factor of one load case by the flow rule of ``analysis``.

    log : called once per iteration of a cone program, as it goes
    """
    started = time.perf_counter()
    iterations: list[IterationRecord] = []

    def record(iteration: IterationRecord) -> None:
        iterations.append(iteration)
        if log is not None:
            log(iteration)

    associative = _associative(convex, settings, record)
    solution = _associative_solution(convex, associative, analysis.flow_rule)
    return replace(solution, iterations=tuple(iterations), seconds=time.perf_counter() - started)


def _associative(convex: ConvexProgram, settings: SolverSettings, log: Log) -> AssociativeResult:
    """The stabilised program, and where that finds no load factor the plain one, whose rays are certificates."""
    settings = replace(settings, regularization=FALLBACK_REGULARIZATION)
    result = solve_associative_form(convex_form(convex, stabilised=True), convex.points, settings, log)
    if result.status is Status.SOLVED:
        return result
    plain = solve_associative_form(convex_form(convex), convex.points, settings, log)
    keeps = result.state is not None and plain.status not in (Status.SOLVED, Status.NO_EQUILIBRIUM, Status.UNBOUNDED)
    best = result if keeps else plain
    return replace(best, programs=_renumbered((*result.programs, *plain.programs)))


def _renumbered(records: tuple[ProgramRecord, ...]) -> tuple[ProgramRecord, ...]:
    return tuple(replace(record, program=number) for number, record in enumerate(records, start=1))


def convex_mechanics(convex: ConvexProgram, state: LawState, dilatancy: FloatArray) -> Mechanics:
    """Mechanics of the model from a state of the program.

    dilatancy : (n_points,) tangent of the dilatancy angle of the flow rule; a point is open where what torsion,
                crushing and dilatancy leave of its motion opens it
    """
    program, scaling = convex.points, convex.points.scaling
    live_power = float(convex.program.live_load @ state.velocities)
    velocities = state.velocities / live_power
    blocks = velocities[: convex.n_block_rows]
    forces = scaling.forces(state.forces)
    moved = contact_velocities(program, blocks)
    to_deck = scaling.live / scaling.force
    own = to_deck * (convex.program.equilibrium_matrix.T @ velocities).reshape(-1, 3)
    return Mechanics(
        load_factor=scaling.load_factor(state.load_factor),
        contact_forces=forces,
        contact_velocities=moved,
        mechanism=program.mechanism(blocks),
        modes=_modes(forces, moved, own, dilatancy),
        resultants=(convex.resultants @ forces.ravel()).reshape(-1, 6),
        interface_motions=to_deck * convex.flows(velocities),
    )


def _modes(forces: FloatArray, moved: FloatArray, own: FloatArray, dilatancy: FloatArray) -> IntArray:
    """Modes of the contact points: open by their own motion without its dilatancy, sliding by the whole of it."""
    opening = np.maximum(own[:, 0] - dilatancy * np.hypot(own[:, 1], own[:, 2]), 0.0)
    return contact_modes(forces, np.column_stack([opening, moved[:, 1:]]))


def _associative_solution(convex: ConvexProgram, result: AssociativeResult, flow_rule: str) -> Solution:
    mechanics = None if result.state is None else convex_mechanics(convex, result.state, convex.points.limits.friction)
    reason = result.reason
    if result.status is Status.UNBOUNDED and flow_rule != "associative":
        reason += (
            "; this holds for associative flow, and does not decide whether there is a load factor without dilatancy"
        )
    certificate = motions = None
    if result.certificate is not None:
        certificate, motions = _certificate(convex, result.certificate)
    return Solution(
        flow_rule=flow_rule,
        status=result.status,
        mechanics=mechanics,
        associative=mechanics,
        certificate=certificate,
        reason=reason,
        programs=result.programs,
        iterations=(),
        seconds=0.0,
        certificate_motions=motions,
    )


def _certificate(convex: ConvexProgram, velocities: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Motion of the blocks, largest entry 1, and the motions of the interfaces that belong to it."""
    scaling = convex.points.scaling
    motion = convex.points.mechanism(velocities[: convex.n_block_rows])
    largest = float(np.abs(motion).max(initial=0.0))
    flows = scaling.live / scaling.force * convex.flows(velocities)
    return (motion / largest, flows / largest) if largest > 0 else (motion, flows)
