"""One part of a structure, whose blocks can interact, through the flow rule and the scheme of the analysis."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.deck.sections.accuracy import knobs_of
from mbla.deck.sections.analysis import AnalysisSection
from mbla.errors import Message
from mbla.program.program import Program
from mbla.solution.associative.certificate import cleaned_certificate
from mbla.solution.associative.polyhedral import solve_polyhedral
from mbla.solution.associative.solve_associative import AssociativeResult, solve_associative
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.nonassociative.factor_range import FactorRange
from mbla.solution.nonassociative.law_state import LawState, SequenceResult
from mbla.solution.nonassociative.locking import Boundedness, locks_at_dilatancy, non_associative_bounded
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import ProgramRecord, StandingResult, Status
from mbla.solution.standing.standing import stress_free_state
from mbla.solution.standing.standing_path import StandingPath
from mbla.solution.thresholds import SOLVED_RESIDUAL

NO_MECHANISM_AT_DILATANCY = (
    "the solver finds no mechanism at the dilatancy angle either in which the live load does work"
)
APART = Message("associative-bounds-apart", "with associative flow {}")

WITH_VALUE = (Status.SOLVED, Status.APPROXIMATE)

RANGE_RESIDUAL = SOLVED_RESIDUAL
"""Residual of a state up to which its range is asked for, and whether more is carried on the way to it."""

SUSPECT = 0.85
"""Share of the associative load factor below which the load path is followed. Of 470 clamped and wedged planks the 58
with a peak lay below, of walls and rooms without one few do."""

SAME = 1e-3
"""Share of the associative load factor within which another one is next to it."""

BEFORE, FEW_POINTS = 0.99, 1000
"""Share of its load factor at which a structure above that is looked at once, and contact points up to which it is:
of 120 small clamps, wedges, arches and confined stacks two fell there. On walls of 2,340 and 5,894 points a look takes
longer than the load factor itself, and all walls on record stand there."""

NO_PEAK = Message(
    "peak-not-examined",
    "the load factor lies far below the associative one, and whether the structure carries more on the way was not "
    "examined",
)


@dataclass(frozen=True)
class PartResult:
    """What was found for one part.

    associative : by the associative flow rule
    sequence    : by the flow rule of the analysis where that is another one, None where it did not come to it
    loaded      : false where no live load acts on the part; then it only has to carry its dead load
    standing    : assessment of the dead load alone, None where it was not asked for
    range       : of the load factor without normality, for the mechanism found
    outer       : with the circumscribed friction polyhedron, ``associative`` having the inscribed one
    remarks     : on the figure, besides those of the sequence
    peak        : last state of the load path that stands, where that lies above the load factor
    more        : programs solved for what is found beside the load factor
    """

    program: Program
    associative: AssociativeResult
    sequence: SequenceResult | None
    loaded: bool
    standing: StandingResult | None = None
    range: FactorRange | None = None
    outer: AssociativeResult | None = None
    remarks: tuple[Message, ...] = ()
    peak: LawState | None = None
    more: tuple[ProgramRecord, ...] = ()

    def with_remark(self, remark: Message | None, programs: tuple[ProgramRecord, ...]) -> PartResult:
        """The same with one more remark, unless there is none, and more programs."""
        remarks = (*self.remarks, remark) if remark else self.remarks
        return replace(self, remarks=remarks, more=(*self.more, *programs))

    @property
    def state(self) -> LawState | None:
        """Of the flow rule of the analysis."""
        return self.associative.state if self.sequence is None else self.sequence.state

    @property
    def status(self) -> Status:
        """Of the flow rule of the analysis.

        Residuals speak for a state of another flow rule than the associative one, whose proved kinematic bound holds
        however far the static one is from it; what another solver contradicts stays that.
        """
        if self.sequence is None or (self._doubted and self.sequence.status is Status.SOLVED):
            return self.associative.status
        return self.sequence.status

    @property
    def _doubted(self) -> bool:
        """Whether more is open about the associative load factor than how far its bounds are apart."""
        associative = self.associative
        return associative.state is not None and associative.status is not Status.SOLVED and not associative.apart

    @property
    def reason(self) -> str:
        """Why the part is not plainly solved."""
        if self.sequence is None:
            return self.associative.reason
        return self.sequence.reason or ("" if self.associative.apart else self.associative.reason)

    @property
    def asked(self) -> float | None:
        """Gap or residual that was asked for, and reached, where the part is approximate for no other reason."""
        if self.sequence is None:
            return self.associative.asked
        return None if self._doubted else self.sequence.asked

    @property
    def programs(self) -> tuple[ProgramRecord, ...]:
        """All cone programs that were solved for it."""
        own = self.associative.programs if self.sequence is None else self.sequence.programs
        ends = () if self.range is None else self.range.programs
        return (*own, *ends, *self.more)


def solve_part(program: Program, analysis: AnalysisSection, settings: SolverSettings, log: Log) -> PartResult:
    """Associative first, then the sequence that the flow rule asks for."""
    return _with_clean_certificate(_by_flow_rule(program, analysis, settings, log), settings, log)


def _with_clean_certificate(result: PartResult, settings: SolverSettings, log: Log) -> PartResult:
    """Of what does not stand, only that moves."""
    certificate = result.associative.certificate
    if certificate is None:
        return result
    clean = cleaned_certificate(result.program, certificate, settings, log)
    return replace(result, associative=replace(result.associative, certificate=clean))


def _by_flow_rule(program: Program, analysis: AnalysisSection, settings: SolverSettings, log: Log) -> PartResult:
    if not np.any(program.live_load):
        return _unloaded_part(program, analysis, settings, log)
    result = _associative(program, analysis, settings, log)
    associative = result.associative
    if analysis.flow_rule == "associative" or not (associative.state or associative.status is Status.UNBOUNDED):
        return result
    if program.n_points == 0:  # blocks held by guides alone: no joint that could flow by another rule
        return result
    if associative.stress_free is None and knobs_of(analysis).standing:  # most schemes start from it
        associative = replace(associative, stress_free=stress_free_state(program, settings))
        result = replace(result, associative=associative)
    if associative.state is None:
        return _locked_by_dilatancy(result, analysis, settings, log)
    remarks = (*result.remarks, APART.format(associative.apart)) if associative.apart else result.remarks
    result = replace(
        result, sequence=solve_nonassociative(program, associative, analysis, settings, log), remarks=remarks
    )
    return _judged(result, analysis, settings, log) if analysis.flow_rule == "non_associative" else result


def _judged(
    result: PartResult, analysis: AnalysisSection, settings: SolverSettings, log: Log, path: StandingPath | None = None
) -> PartResult:
    """Without dilatancy: the load factor and the peak that the load path leaves, where there is reason to follow it.

    Where a support gives way there is no path: it starts with a reaction that is chosen. The published procedure is
    there to be compared with the literature, and stays what it is.

    path : as far as it was followed before
    """
    state, above = result.state, result.associative.state
    most = np.inf if above is None else above.load_factor
    published = analysis.scheme == "published" and above is not None
    if state is None or result.status not in WITH_VALUE or result.program.settles or published:
        return result
    if 0.0 < SUSPECT * most < state.load_factor and not _falls_before(result, state, most, settings):
        return result
    rough, wanted = state.residual > RANGE_RESIDUAL, knobs_of(analysis).peak
    if rough and above is not None and state.load_factor > 0.0:
        return result.with_remark(NO_PEAK, ())
    from mbla.solution.nonassociative.first_fall import judged_by_path  # late: the load path is followed rarely

    assert result.sequence is not None  # its state is that of the flow rule
    path = path or StandingPath.from_dead_load(result.program, settings, result.associative.stress_free)
    number, further = len(result.programs) + 1, wanted and not rough
    verdict = judged_by_path(path, result.sequence, most, log, number, peak=further)
    judged = replace(result, sequence=verdict.sequence, peak=verdict.peak)
    judged = judged.with_remark(verdict.remark, verdict.programs)
    low = judged.status in WITH_VALUE and judged.state is not None and judged.state.load_factor <= SUSPECT * most
    return judged.with_remark(NO_PEAK, ()) if low and not further and verdict.peak is None else judged


def _falls_before(result: PartResult, state: LawState, most: float, settings: SolverSettings) -> bool:
    """Whether a small structure is seen to fall a little below a load factor that is not the associative one."""
    program, below = result.program, BEFORE * state.load_factor
    if program.n_points > FEW_POINTS or most - state.load_factor <= SAME * most:
        return False
    return StandingPath.from_dead_load(program, settings, result.associative.stress_free).look(below).falls


def solve_nonassociative(
    program: Program, associative: AssociativeResult, analysis: AnalysisSection, settings: SolverSettings, log: Log
) -> SequenceResult:
    """The sequence by the flow rule of the analysis; its schemes are imported where one is asked for."""
    from mbla.solution.flow_rules import Flow, solve_flow

    return solve_flow(Flow(program, associative, analysis, settings, log))


def _associative(program: Program, analysis: AnalysisSection, settings: SolverSettings, log: Log) -> PartResult:
    """The associative answer, by polyhedra where they approximate the friction cone: in space."""
    if analysis.friction_cone == "polyhedral" and program.components == 3:
        both = solve_polyhedral(program, analysis.sides, settings, log)
        inner = replace(both.inner, programs=both.programs)
        remarks = (both.bracket,) if both.bracket else ()
        return PartResult(program, inner, None, loaded=True, outer=both.outer, remarks=remarks)
    answer = solve_associative(program, settings, log, stress_free=knobs_of(analysis).standing)
    return PartResult(program, answer, None, loaded=True)


def _locked_by_dilatancy(
    result: PartResult, analysis: AnalysisSection, settings: SolverSettings, log: Log
) -> PartResult:
    """Associative flow locks: without dilatancy joints may still give way, which is decided first."""
    program, associative = result.program, result.associative
    if analysis.flow_rule == "livesley":
        return result
    if analysis.flow_rule == "dilatancy":
        if locks_at_dilatancy(program, settings, log):
            return replace(result, associative=replace(associative, reason=NO_MECHANISM_AT_DILATANCY))
        sequence = solve_nonassociative(program, associative, analysis, settings, log)
        return replace(result, sequence=sequence) if sequence.status is Status.SOLVED else result
    path = StandingPath.from_dead_load(program, settings, associative.stress_free)
    decision = non_associative_bounded(path)
    if decision.verdict is Boundedness.UNBOUNDED:
        return replace(result, associative=replace(associative, reason=decision.reason))
    if decision.verdict is Boundedness.DOUBTFUL:
        return replace(result, associative=replace(associative, status=Status.NOT_VERIFIED, reason=decision.reason))
    sequence = solve_nonassociative(program, associative, analysis, settings, log)
    sequence = replace(sequence, remarks=(decision.reason, *sequence.remarks))
    result = replace(result, associative=replace(associative, reason=""), sequence=sequence)
    return _judged(result, analysis, settings, log, path)


def _unloaded_part(program: Program, analysis: AnalysisSection, settings: SolverSettings, log: Log) -> PartResult:
    """A part without live load: whether it carries its dead load shows when that is taken away step by step."""
    relieved = replace(program, live_load=-program.dead_load)
    if np.any(program.dead_load):
        result = solve_associative(relieved, settings, log, stress_free=knobs_of(analysis).standing)
    else:
        result = AssociativeResult(Status.UNBOUNDED, None, None, "", ())
    carried = result.status in (Status.SOLVED, Status.APPROXIMATE)
    if carried:
        result = replace(result, status=Status.UNBOUNDED, state=None, reason="no live load acts on it")
    return PartResult(program, result, None, loaded=False)
