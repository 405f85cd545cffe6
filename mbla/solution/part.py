"""Which method solves one part of a structure, whose blocks can interact: by flow rule, scheme and what is asked for.

Associative first; where another flow rule is asked for, the scheme that the deck names; then, in addition to the
load factor, a peak of the load path, the range for the mechanism found and the standing, none of which changes it but
the path.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import Message
from mbla.program.program import Program
from mbla.solution.associative.certificate import steepest_fall
from mbla.solution.associative.solve_associative import AssociativeResult, solve_associative
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.nonassociative.alternation import no_mechanism
from mbla.solution.nonassociative.default_scheme import looks_lower
from mbla.solution.nonassociative.factor_range import FactorRange, factor_range
from mbla.solution.nonassociative.law_state import LawState
from mbla.solution.nonassociative.locking import Boundedness, locks_at_dilatancy, non_associative_bounded
from mbla.solution.nonassociative.refine_equilibrium import misfit, sharpened
from mbla.solution.nonassociative.schemes import solve_nonassociative
from mbla.solution.nonassociative.search import is_needless
from mbla.solution.part_result import PartResult
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import WITH_VALUE, Status
from mbla.solution.standing.standing import (
    assess_dead_load,
    standing_on_model,
    standing_without_equilibrium,
    stress_free_state,
)
from mbla.solution.standing.standing_path import StandingPath
from mbla.solution.standing.weak_spring_continuation import Outcome
from mbla.solution.thresholds import EXACT_RESIDUAL, SOLVED_RESIDUAL

NO_MECHANISM_AT_DILATANCY = (
    "the solver finds no mechanism at the dilatancy angle either in which the live load does work"
)
LOCKED_BY_CONTACT = (
    "the live load only presses the blocks together: it does no work in any possible mechanism, whatever its multiple"
)
APART = Message("associative-bounds-apart", "with associative flow {}")

RANGE_RESIDUAL = SOLVED_RESIDUAL
"""Residual of a state up to which its range is asked for, and whether more is carried on the way to it."""

SUSPECT = 0.85
"""Share of the associative load factor below which the load path is followed. Of 470 clamped and wedged planks the 58
with a peak lay below, of walls and rooms without one few do."""

LOWER = 1e-9
"""Share of the load factor by which the least for its mechanism must lie below it to take its place; pairs of programs
ended as much as 4e-8 above it."""

SEARCHED = 1e-4
"""Share by which a figure known before a search must lie below what the search came to, to take its place."""

SAME = 1e-3
"""Share of the associative load factor within which another one is next to it."""

BEFORE, FEW_POINTS = 0.99, 1000
"""Share of its load factor at which a structure above that is examined once, and contact points up to which it is:
of 120 small clamps, wedges, arches and confined stacks two fell there. On walls of 2,340 and 5,894 points a look takes
longer than the load factor itself, and all walls on record stand there. A load path is followed up to so many too
unless it is asked for: on a vault of 1,032 it took 90 s, its load factor 2."""

NO_PEAK = Message(
    "peak-not-examined",
    "the load factor lies far below the associative one, and whether the structure carries more on the way was not "
    "examined: {}",
)
TOO_ROUGH = "forces and velocities violate the joint law, residual {:.2g}, and it is followed up to 1e-4"
TOO_MANY = "of {} contact points, more than {}, the load path is followed only where the deck itself says peak: true"
NOT_ASKED = "peak is false, by the deck or its accuracy"
NO_RANGE = Message(
    "range-not-computed",
    "the admissible load factors for this mechanism are not computed: it violates the joint law, residual {:.2g}; "
    "they mean something up to 1e-4",
)
NEEDS_NOTHING = (
    "lower end of the range: none is given, as this mechanism needs no live load where all force of a joint lies at "
    "the point about which it twists"
)
RANGE_BROKE_DOWN = Message(
    "range-not-computed", "the range of the load factor is not known: a system of equations broke down ({})"
)


def solve_part(program: Program, settings: SolverSettings, log: Log) -> PartResult:
    """The part by the flow rule of the analysis, with everything that is requested in addition to its load factor.

    Raises
    ------
    numpy.linalg.LinAlgError where a system of equations on the way to the load factor is singular
    """
    if not (looks_lower(program, settings) and program.components == 3):
        return _solved_part(program, settings, log)
    unasked = replace(settings, analysis=settings.analysis.model_copy(update={"search": None}))
    slope = _slope_by(program, settings.analysis.flow_rule)
    return _lower_of(_solved_part(program, unasked, log), _solved_part(program, settings, log), slope)


def _slope_by(program: Program, flow_rule: str) -> FloatArray | float:
    """Tangent of the dilatancy angle, (n_points,), or 0 without."""
    return program.limits.dilatancy if flow_rule == "dilatancy" else 0.0


def _lower_of(plain: PartResult, searched: PartResult, slope: FloatArray | float) -> PartResult:
    """What a search in space came to, or what is found without one where that has the lower figure.

    The load path and the range of the state that it leads to may know a lower one than all descents.
    """
    known, found = _least(plain), _least(searched)
    if plain.status not in WITH_VALUE or not known < (1.0 - SEARCHED) * found:
        return searched
    lower = None if plain.range is None else plain.range.lower
    return replace(_at_lower_end(plain, lower, slope), more=(*plain.more, *searched.programs))


def _least(result: PartResult) -> float:
    """The least load factor of a part's answer and its range; inf where there is none."""
    if result.state is None or result.status not in WITH_VALUE:
        return np.inf
    lower = None if result.range is None else result.range.lower
    return min(result.state.load_factor, np.inf if lower is None else lower.load_factor)


def _solved_part(program: Program, settings: SolverSettings, log: Log) -> PartResult:
    """The same with one search or without."""
    result = _by_flow_rule(program, settings, log)
    certificate = result.associative.certificate
    if certificate is not None:  # of what does not stand, only that moves
        fall = steepest_fall(program, settings, log)
        if fall is not None:
            result = replace(result, associative=replace(result.associative, certificate=fall))
    if settings.range or looks_lower(program, settings):
        result = _with_range(result, settings, log)
    return _with_standing(result, settings) if settings.standing else result


def _by_flow_rule(program: Program, settings: SolverSettings, log: Log) -> PartResult:
    analysis = settings.analysis
    if not np.any(program.live_load):
        return _unloaded_part(program, settings, log)
    result = _associative(program, settings, log)
    associative = result.associative
    if analysis.flow_rule == "associative" or not (associative.state or associative.status is Status.UNBOUNDED):
        return result
    if program.n_points == 0:  # blocks held by guides alone: no joint that could flow by another rule
        return result
    if associative.stress_free is None and settings.standing:  # most schemes start from it
        associative = replace(associative, stress_free=stress_free_state(program, settings))
        result = replace(result, associative=associative)
    if associative.state is None:
        return _locked_by_dilatancy(result, settings, log)
    remarks = (*result.remarks, APART.format(associative.gap_words)) if associative.gap_words else result.remarks
    result = replace(result, sequence=solve_nonassociative(program, associative, settings, log), remarks=remarks)
    return _judged(result, settings, log) if analysis.flow_rule == "non_associative" else result


def _associative(program: Program, settings: SolverSettings, log: Log) -> PartResult:
    """The associative answer."""
    answer = solve_associative(program, settings, log, stress_free=settings.standing)
    return PartResult(program, answer, None, loaded=True)


def _unloaded_part(program: Program, settings: SolverSettings, log: Log) -> PartResult:
    """A part without live load: whether it carries its dead load shows when that is taken away step by step."""
    result = AssociativeResult(Status.UNBOUNDED, None, None, "", ())
    if np.any(program.dead_load):
        relieved = replace(program, live_load=-program.dead_load)
        result = solve_associative(relieved, settings, log, stress_free=settings.standing)
    if result.status in WITH_VALUE:
        result = replace(result, status=Status.UNBOUNDED, state=None, reason="no live load acts on it")
    return PartResult(program, result, None, loaded=False)


def _locked_by_dilatancy(result: PartResult, settings: SolverSettings, log: Log) -> PartResult:
    """Associative flow locks: without dilatancy joints may still give way, which is decided first."""
    program, associative, flow_rule = result.program, result.associative, settings.analysis.flow_rule
    if flow_rule == "livesley":
        return result
    if flow_rule == "dilatancy":
        if locks_at_dilatancy(program, settings, log):
            return replace(result, associative=replace(associative, reason=NO_MECHANISM_AT_DILATANCY))
        sequence = solve_nonassociative(program, associative, settings, log)
        return replace(result, sequence=sequence) if sequence.status is Status.SOLVED else result
    if no_mechanism(program, settings, log):
        return replace(result, associative=replace(associative, reason=LOCKED_BY_CONTACT))
    if settings.by_elastic_path:
        sequence = solve_nonassociative(program, associative, settings, log)
        if sequence.status is Status.UNBOUNDED:
            return replace(result, associative=replace(associative, reason=sequence.reason))
        return replace(result, associative=replace(associative, reason=""), sequence=sequence)
    path = StandingPath.from_dead_load(program, settings, associative.stress_free)
    decision = non_associative_bounded(path)
    if decision.verdict is Boundedness.UNBOUNDED:
        return replace(result, associative=replace(associative, reason=decision.reason))
    sequence = solve_nonassociative(program, associative, settings, log)
    if decision.verdict is Boundedness.DOUBTFUL and sequence.status is not Status.SOLVED:
        return replace(result, associative=replace(associative, status=Status.NOT_VERIFIED, reason=decision.reason))
    sequence = replace(sequence, remarks=(decision.reason, *sequence.remarks))
    result = replace(result, associative=replace(associative, reason=""), sequence=sequence)
    return _judged(result, settings, log, path)


def _judged(result: PartResult, settings: SolverSettings, log: Log, path: StandingPath | None = None) -> PartResult:
    """Without dilatancy: the load factor and the peak that the load path leaves, where that is followed.

    Where a support gives way there is no path: it starts with a reaction that is chosen. The published procedure is
    there to be compared with the literature, and is not changed.

    path : as far as it was followed before
    """
    state, above = result.state, result.associative.state
    most = np.inf if above is None else above.load_factor
    other = settings.by_elastic_path or (settings.analysis.scheme == "published" and above is not None)
    if state is None or result.status not in WITH_VALUE or result.program.settles or other:
        return result
    first = result.sequence.first if result.sequence is not None else None
    reached = state.load_factor if first is None else max(first, state.load_factor)
    start = result.associative.stress_free
    stands = start is None or start.outcome is not Outcome.UNDECIDED
    if stands and 0.0 < SUSPECT * most < reached and not _falls_before(result, state, most, settings):
        return result
    rough = state.residual > RANGE_RESIDUAL
    unasked = result.program.n_points > FEW_POINTS and not settings.analysis.peak
    points = result.program.n_points
    why = TOO_ROUGH.format(state.residual) if rough else TOO_MANY.format(points, FEW_POINTS) if unasked else NOT_ASKED
    if (rough or unasked) and above is not None and state.load_factor > 0.0:
        return result.with_remark(NO_PEAK.format(why))
    from mbla.solution.nonassociative.first_fall import judged_by_path  # late: the load path is followed rarely

    assert result.sequence is not None  # its state is that of the flow rule
    path = path or StandingPath.from_dead_load(result.program, settings, result.associative.stress_free)
    number, further = len(result.programs) + 1, settings.peak and not rough
    verdict = judged_by_path(path, result.sequence, most, log, number, peak=further)
    judged = replace(result, sequence=verdict.sequence, peak=verdict.peak)
    judged = judged.with_remark(verdict.remark, verdict.programs)
    low = judged.status in WITH_VALUE and judged.state is not None and judged.state.load_factor <= SUSPECT * most
    return judged.with_remark(NO_PEAK.format(why)) if low and not further and verdict.peak is None else judged


def _falls_before(result: PartResult, state: LawState, most: float, settings: SolverSettings) -> bool:
    """Whether a small structure is seen to fall a little below a load factor that is not the associative one."""
    program, below = result.program, BEFORE * state.load_factor
    if program.n_points > FEW_POINTS or most - state.load_factor <= SAME * most:
        return False
    return StandingPath.from_dead_load(program, settings, result.associative.stress_free).look(below).falls


def _with_range(result: PartResult, settings: SolverSettings, log: Log) -> PartResult:
    """The range where it is asked for; where lower states are searched its lower end is the answer, asked for or not.

    Only of a state that is claimed and fits the law: the mechanism of another one is meaningless.
    """
    state = None if result.sequence is None else result.sequence.state
    if state is None or result.status not in WITH_VALUE or state.history is not None:
        return result
    if state.residual > RANGE_RESIDUAL:
        return result.with_remark(NO_RANGE.format(state.residual)) if settings.range else result
    slope = _slope_by(result.program, settings.analysis.flow_rule)
    try:
        found = factor_range(result.program, state, settings, log, len(result.programs) + 1, slope)
    except np.linalg.LinAlgError as error:
        return result.with_remark(RANGE_BROKE_DOWN.format(str(error).lower()))
    found = _without_needless(result, found)
    if looks_lower(result.program, settings):
        result, found = _no_higher_than_before(result, found, settings, log, slope)
        result = _at_lower_end(result, found.lower, slope)
    return replace(result, range=found) if settings.range else replace(result, more=(*result.more, *found.programs))


def _without_needless(result: PartResult, found: FactorRange) -> FactorRange:
    """A range without a lower end that needs no live load."""
    above = result.associative.state
    if found.lower is None or not is_needless(result.program, found.lower, above.load_factor if above else np.inf):
        return found
    return replace(found, lower=None, reason=Message("range-not-found", NEEDS_NOTHING))


def _no_higher_than_before(
    result: PartResult, found: FactorRange, settings: SolverSettings, log: Log, slope: FloatArray | float
) -> tuple[PartResult, FactorRange]:
    """The state from which lower ones were looked for, where its mechanism has a lower end than what that came to.

    found : range of the state that was found
    """
    program, sequence, state = result.program, result.sequence, result.state
    before = None if sequence is None else sequence.before
    if before is None or before is state or state is None or sequence is None or before.residual > RANGE_RESIDUAL:
        return result, found
    number = len(result.programs) + len(found.programs) + 1
    other = _without_needless(result, factor_range(program, before, settings, log, number, slope))
    programs, least = (*found.programs, *other.programs), (found.lower or state).load_factor
    lower = other.lower
    if lower is None or lower.load_factor > (1.0 - SEARCHED) * least or misfit(program, lower) > EXACT_RESIDUAL:
        return result, replace(found, programs=programs)
    return replace(result, sequence=replace(sequence, state=before)), replace(other, programs=programs)


def _at_lower_end(result: PartResult, lower: LawState | None, slope: FloatArray | float) -> PartResult:
    """The least load factor for the mechanism is the answer, where its state fits the law and is in balance.

    slope : (n_points,) tangent of the dilatancy angle, or 0
    """
    program, sequence, state = result.program, result.sequence, result.state
    if lower is None or sequence is None or state is None or result.peak is not None:
        return result
    if lower.load_factor > (1.0 - LOWER) * state.load_factor or misfit(program, lower) > EXACT_RESIDUAL:
        return result
    return replace(result, sequence=sharpened(program, result.associative, slope, replace(sequence, state=lower)))


def _with_standing(result: PartResult, settings: SolverSettings) -> PartResult:
    program, associative = result.program, result.associative
    if associative.certificate is not None:
        return replace(result, standing=standing_without_equilibrium(program, associative.certificate))
    decided = associative.state is not None or associative.status is Status.UNBOUNDED
    if settings.by_elastic_path:
        from mbla.solution.standing.gravity_standing import standing_by_gravity  # late: it asks for the engine of paths

        return replace(result, standing=standing_by_gravity(program, True if decided else None))
    state = assess_dead_load(program, settings, True if decided else None, associative.stress_free)
    return replace(result, standing=standing_on_model(program, state))
