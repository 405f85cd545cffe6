"""Which method solves one part of a structure, whose blocks can interact: by flow rule, scheme and what is asked for.

Associative first; where another flow rule is asked for, the path of elastic joints or the scheme that the deck names;
then, in addition to the load factor, states of lower ones and the standing, neither of which changes it.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import Message
from mbla.program.program import Program
from mbla.solution.associative.certificate import steepest_fall
from mbla.solution.associative.heavy_loads import solved_under_heavy_loads
from mbla.solution.associative.solve_associative import AssociativeResult, solve_associative
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.law.interfaces import NONE, Interfaces
from mbla.solution.nonassociative.alternation import no_mechanism
from mbla.solution.nonassociative.least_found import least_found, looks_lower
from mbla.solution.nonassociative.locking import locks_at_dilatancy
from mbla.solution.nonassociative.schemes import slope_of, solve_nonassociative
from mbla.solution.nonassociative.torsion import solve_with_torsion
from mbla.solution.part_result import PartResult
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import WITH_VALUE, ProgramRecord, Status
from mbla.solution.standing.standing import StressFreeStates, assess_dead_load, standing_without_equilibrium

NO_MECHANISM_AT_DILATANCY = (
    "the solver finds no mechanism at the dilatancy angle either in which the live load does work"
)
LOCKED_BY_CONTACT = (
    "the live load only presses the blocks together: it does no work in any possible mechanism, whatever its multiple"
)
APART = Message("associative-bounds-apart", "with associative flow {}")
SEARCH_BROKE_DOWN = Message(
    "lower-not-searched", "states of lower load factors were not found: a system of equations broke down ({})"
)


def solve_part(
    program: Program,
    settings: SolverSettings,
    log: Log,
    interfaces: Interfaces = NONE,
    beside: Interfaces = NONE,
    states: StressFreeStates | None = None,
) -> PartResult:
    """The part by the flow rule of the analysis, with everything that is requested in addition to its load factor.

    interfaces : of the model that have a law of their own in the path of elastic joints
    beside     : those in a second path, with torsion
    states     : of stress-free assemblies that are known

    Raises
    ------
    numpy.linalg.LinAlgError where a system of equations on the way to the load factor is singular
    """
    result = _by_flow_rule(program, settings, log, interfaces, states)
    if result.associative.certificate is not None:  # of what does not stand, only that moves
        fall = steepest_fall(program, settings, log)
        if fall is not None:
            result = replace(result, associative=replace(result.associative, certificate=fall))
    if looks_lower(program, settings, interfaces):
        result = _with_least(result, settings, log)
    if result.sequence is not None and result.state is not None and result.status in WITH_VALUE:
        torsion = solve_with_torsion(program, result.associative, settings, log, beside)
        result = replace(result, torsion=torsion)
    return _with_standing(result, states) if settings.standing else result


def _by_flow_rule(
    program: Program, settings: SolverSettings, log: Log, interfaces: Interfaces, states: StressFreeStates | None
) -> PartResult:
    if not np.any(program.live_load):
        return _unloaded_part(program, settings, log, states)
    associative = solve_associative(program, settings, log, stress_free=settings.standing, states=states)
    associative = solved_under_heavy_loads(program, associative, interfaces, settings, log)
    result = PartResult(program, associative, None, loaded=True)
    flow_rule = settings.analysis.flow_rule
    if flow_rule == "associative" or not (associative.state or associative.status is Status.UNBOUNDED):
        return result
    if program.n_points == 0:  # blocks held by guides alone: no joint that could flow by another rule
        return result
    if associative.state is None:
        return _locked_by_dilatancy(result, settings, log, interfaces)
    remarks = (APART.format(associative.gap_words),) if associative.gap_words else ()
    sequence = solve_nonassociative(program, associative, settings, log, interfaces)
    return replace(result, sequence=sequence, remarks=remarks)


def _unloaded_part(program: Program, settings: SolverSettings, log: Log, states: StressFreeStates | None) -> PartResult:
    """A part without live load: whether it carries its dead load shows when that is taken away step by step."""
    result = AssociativeResult(Status.UNBOUNDED, None, None, "", ())
    if np.any(program.dead_load):
        relieved = replace(program, live_load=-program.dead_load)
        result = solve_associative(relieved, settings, log, stress_free=settings.standing, states=states)
    if result.status in WITH_VALUE:
        result = replace(
            result, status=Status.UNBOUNDED, state=None, reason="no live load acts on it", below=_at_zero(result)
        )
    return PartResult(program, result, None, loaded=False)


def _at_zero(result: AssociativeResult) -> tuple[FloatArray, float] | None:
    """Forces under the dead load alone, between those known below and at the load factor; None without."""
    state, below = result.state, result.below
    if state is None or below is None or not state.load_factor > below[1]:
        return None
    return state.forces_between(below, 0.0), 0.0


def _locked_by_dilatancy(result: PartResult, settings: SolverSettings, log: Log, interfaces: Interfaces) -> PartResult:
    """Associative flow locks: with less dilatancy joints may still give way, which is decided first."""
    program, associative, flow_rule = result.program, result.associative, settings.analysis.flow_rule
    if flow_rule == "livesley":
        return result
    if flow_rule == "dilatancy" and locks_at_dilatancy(program, settings, log):
        return replace(result, associative=replace(associative, reason=NO_MECHANISM_AT_DILATANCY))
    if flow_rule == "non_associative" and no_mechanism(program, settings, log):
        return replace(result, associative=replace(associative, reason=LOCKED_BY_CONTACT))
    sequence = solve_nonassociative(program, associative, settings, log, interfaces)
    if sequence.status is Status.UNBOUNDED:
        return replace(result, associative=replace(associative, reason=sequence.reason))
    return replace(result, associative=replace(associative, reason=""), sequence=sequence)


def _with_least(result: PartResult, settings: SolverSettings, log: Log) -> PartResult:
    """With the state of the least load factor that a search from the answer finds."""
    program, sequence, state = result.program, result.sequence, result.state
    if sequence is None or state is None or result.status not in WITH_VALUE:
        return result
    slope, records = slope_of(program, settings.analysis.flow_rule), list[ProgramRecord](result.programs)
    known = len(records)
    try:
        least = least_found(program, slope, state, result.associative, settings, log, records)
    except np.linalg.LinAlgError as error:
        return result.with_remark(SEARCH_BROKE_DOWN.format(str(error).lower()))
    return replace(result, least=least, more=(*result.more, *records[known:]))


def _with_standing(result: PartResult, states: StressFreeStates | None) -> PartResult:
    program, associative = result.program, result.associative
    if associative.certificate is not None:
        return replace(result, standing=standing_without_equilibrium(program, associative.certificate))
    decided = associative.state is not None or associative.status is Status.UNBOUNDED
    found = assess_dead_load(program, True if decided else None, associative.stress_free, states)
    return replace(result, standing=found)
