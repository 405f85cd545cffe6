"""The steps by which one part of a structure, whose blocks can interact, is solved (:mod:`mbla.solution.solve`)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import Message
from mbla.program.program import Program
from mbla.solution.associative.heavy_loads import solved_under_heavy_loads
from mbla.solution.associative.solve_associative import AssociativeResult, solve_associative
from mbla.solution.nonassociative.alternation import no_mechanism
from mbla.solution.nonassociative.least_found import least_found, looks_lower
from mbla.solution.nonassociative.locking import locks_at_dilatancy
from mbla.solution.nonassociative.schemes import slope_of, solve_nonassociative
from mbla.solution.nonassociative.torsion import solve_with_torsion
from mbla.solution.parts.part_context import PartContext
from mbla.solution.parts.part_result import PartResult
from mbla.solution.proof.certificate import steepest_fall
from mbla.solution.solution import WITH_VALUE, ProgramRecord, Status
from mbla.solution.standing.standing import assess_dead_load, standing_without_equilibrium

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


def associative_part(program: Program, context: PartContext) -> PartResult:
    """By associative flow, and whether the dead load is carried; of what does not stand the motion that falls most."""
    settings, log, loaded = context.settings, context.log, bool(np.any(program.live_load))
    if loaded:
        found = solve_associative(program, settings, log, stress_free=settings.standing, states=context.states)
        found = solved_under_heavy_loads(program, found, context.interfaces, settings, log)
    else:
        found = _unloaded(program, context)
    fall = None if found.certificate is None else steepest_fall(program, settings, log)
    return PartResult(program, found if fall is None else replace(found, certificate=fall), None, loaded=loaded)


def with_flow_rule(result: PartResult, context: PartContext) -> PartResult:
    """With the state by the flow rule of the analysis, where that is another one and associative flow has an answer."""
    program, associative = result.program, result.associative
    answered = associative.state is not None or associative.status is Status.UNBOUNDED
    if context.settings.analysis.flow_rule == "associative" or not result.loaded or not answered:
        return result
    if program.n_points == 0:  # blocks held by guides alone: no joint that could flow by another rule
        return result
    if associative.state is None:
        return _locked_by_dilatancy(result, context)
    remarks = (APART.format(associative.gap_words),) if associative.gap_words else ()
    flow = solve_nonassociative(program, associative, context.settings, context.log, context.interfaces)
    return replace(result, flow=flow, remarks=remarks)


def _unloaded(program: Program, context: PartContext) -> AssociativeResult:
    """A part without live load: whether it carries its dead load shows when that is taken away step by step."""
    result = AssociativeResult(Status.UNBOUNDED, None, None, "", ())
    if np.any(program.dead_load):
        relieved = replace(program, live_load=-program.dead_load)
        settings, states = context.settings, context.states
        result = solve_associative(relieved, settings, context.log, stress_free=settings.standing, states=states)
    if result.status in WITH_VALUE:
        result = replace(
            result, status=Status.UNBOUNDED, state=None, reason="no live load acts on it", below=_at_zero(result)
        )
    return result


def _at_zero(result: AssociativeResult) -> tuple[FloatArray, float] | None:
    """Forces under the dead load alone, between those known below and at the load factor; None without."""
    state, below = result.state, result.below
    if state is None or below is None or not state.load_factor > below[1]:
        return None
    return state.forces_between(below, 0.0), 0.0


def _locked_by_dilatancy(result: PartResult, context: PartContext) -> PartResult:
    """Associative flow locks: with less dilatancy joints may still give way, which is decided first."""
    program, associative, settings, log = result.program, result.associative, context.settings, context.log
    flow_rule = settings.analysis.flow_rule
    if flow_rule == "livesley":
        return result
    if flow_rule == "dilatancy" and locks_at_dilatancy(program, settings, log):
        return replace(result, associative=replace(associative, reason=NO_MECHANISM_AT_DILATANCY))
    if flow_rule == "non_associative" and no_mechanism(program, settings, log):
        return replace(result, associative=replace(associative, reason=LOCKED_BY_CONTACT))
    flow = solve_nonassociative(program, associative, settings, log, context.interfaces)
    if flow.status is Status.UNBOUNDED:
        return replace(result, associative=replace(associative, reason=flow.reason))
    return replace(result, associative=replace(associative, reason=""), flow=flow)


def with_least(result: PartResult, context: PartContext) -> PartResult:
    """With the state of the least load factor that a search from the answer finds, where one is asked for."""
    program, state, settings = result.program, result.state, context.settings
    if state is None or not _has_figure(result) or not looks_lower(program, settings, context.interfaces):
        return result
    slope, records = slope_of(program, settings.analysis.flow_rule), list[ProgramRecord](result.programs)
    known = len(records)
    try:
        least = least_found(program, slope, state, result.associative, settings, context.log, records)
    except np.linalg.LinAlgError as error:
        remark = SEARCH_BROKE_DOWN.format(str(error).lower())
        return replace(result, remarks=(*result.remarks, remark))
    return replace(result, least=least, more=(*result.more, *records[known:]))


def with_torsion(result: PartResult, context: PartContext) -> PartResult:
    """With the load at which it starts to move where interfaces twist as under uniform pressure."""
    if not _has_figure(result):
        return result
    program, associative = result.program, result.associative
    found = solve_with_torsion(program, associative, context.settings, context.log, context.beside)
    return replace(result, torsion=found)


def with_standing(result: PartResult, context: PartContext) -> PartResult:
    """With the assessment of the dead load alone, where that is asked for."""
    if not context.settings.standing:
        return result
    program, associative = result.program, result.associative
    if associative.certificate is not None:
        return replace(result, standing=standing_without_equilibrium(program, associative.certificate))
    decided = associative.state is not None or associative.status is Status.UNBOUNDED
    found = assess_dead_load(program, True if decided else None, associative.stress_free, context.states)
    return replace(result, standing=found)


def _has_figure(result: PartResult) -> bool:
    """Whether another flow rule than the associative one gave a load factor."""
    return result.flow is not None and result.state is not None and result.status in WITH_VALUE
