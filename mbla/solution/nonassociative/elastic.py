"""Flow without dilatancy, or with a joint's own, by the path of elastic joints: the greatest load that is reached.

Forces, motion and history of the state are proved by statics and the law of elastic joints
(:mod:`mbla.solution.verification.elastic_law`); that the history is that of the loading is not.
"""

from __future__ import annotations

import time

import numpy as np

from mbla.errors import Message
from mbla.program.program import Program
from mbla.solution.associative.solve_associative import AssociativeResult
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.flow.path_of_part import PathOfPart, path_of_part
from mbla.solution.flow.path_record import RISES, Stop
from mbla.solution.flow.settings import PathSettings
from mbla.solution.flow.state_of_path import state_of_path
from mbla.solution.nonassociative.law_state import LawState, SequenceResult
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import ProgramRecord, Status
from mbla.solution.thresholds import APPROXIMATE_RESIDUAL, EXACT_RESIDUAL


def solve_by_elastic_path(
    program: Program, associative: AssociativeResult, settings: SolverSettings, log: Log, dilatancy: bool = False
) -> SequenceResult:
    """The state at the greatest load of the path.

    dilatancy : whether joints lift by their own angle as they slide
    """
    started = time.perf_counter()
    slope = program.limits.dilatancy if dilatancy else None
    found = path_of_part(program, associative, PathSettings(), slope)
    state = state_of_path(program, found, settings, log)
    status, reason = _claim(found, state, program.scaling.live)
    value = np.nan if state is None else program.scaling.load_factor(state.load_factor)
    record = ProgramRecord(
        len(associative.programs) + 1,
        "elastic path",
        status,
        value,
        np.nan,
        found.factorizations,
        time.perf_counter() - started,
    )
    remarks = (RISING.format(100.0 * found.gain),) if found.stop is Stop.FAR and found.gain > RISES else ()
    return SequenceResult(status, state, reason, (*associative.programs, record), remarks=remarks)


def _claim(found: PathOfPart, state: LawState | None, live: float) -> tuple[Status, str]:
    """Status and reason, in words, of what was found."""
    if found.stop in WITHOUT:
        status = Status.UNBOUNDED if found.stop is Stop.UNBOUNDED else Status.NOT_VERIFIED
        return status, WITHOUT[found.stop]
    if state is None:
        return Status.NOT_VERIFIED, NO_STATE
    if state.residual > APPROXIMATE_RESIDUAL:
        return Status.NOT_VERIFIED, MISSED.format(state.residual)
    if not found.is_answer:
        return Status.APPROXIMATE, NOT_SEEN.format(f"{state.load_factor * live:.6g}", found.stop)
    if state.residual > EXACT_RESIDUAL:
        return Status.APPROXIMATE, MISSED.format(state.residual)
    return Status.SOLVED, ""


WITHOUT = {
    Stop.DOES_NOT_STAND: "with elastic joints the structure does not carry its dead load from the stress-free assembly",
    Stop.UNDECIDED: "whether elastic joints carry the dead load from the stress-free assembly was not decided",
    Stop.UNBOUNDED: "with elastic joints nothing gives way, however large the live load",
    Stop.UNLOADED: "no live load acts on it",
    Stop.AT_ONCE: "with elastic joints it moves under any live load",
}
NO_STATE = "the path of elastic joints came to no state in balance"
MISSED = Message("elastic-law-missed", "the step of the greatest load fits the law of elastic joints to {:.2g} only")
NOT_SEEN = Message(
    "elastic-path-not-seen",
    "it stands at least to {}, where the path of elastic joints could not be followed further ({})",
)
RISING = Message(
    "elastic-path-rises",
    "the load still rises where the path of elastic joints ends: {:.2g} % of it were gained over its last half",
)
