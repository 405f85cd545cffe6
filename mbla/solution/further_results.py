"""What is found beside the load factor of a part: standing and range.

Each answers another question about one state, and none changes the load factor.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mbla.deck.sections.accuracy import knobs_of
from mbla.deck.sections.analysis import AnalysisSection
from mbla.errors import Message
from mbla.program.program import Program
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.mechanics import forces_of
from mbla.solution.nonassociative.factor_range import factor_range
from mbla.solution.part import RANGE_RESIDUAL, PartResult
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import StandingResult, Status
from mbla.solution.standing.standing import DeadLoadState, assess_dead_load, settlement_of, standing_without_equilibrium

NO_RANGE = Message(
    "range-not-computed",
    "the admissible load factors for this mechanism are not computed: it violates the joint law, residual {:.2g}; "
    "they mean something up to 1e-4",
)
BROKE_DOWN = Message(
    "range-not-computed", "the range of the load factor is not known: a system of equations broke down ({})"
)


@dataclass(frozen=True)
class RequestedResults:
    """What is asked, and what every answer needs."""

    analysis: AnalysisSection
    settings: SolverSettings
    log: Log


def with_further_results(result: PartResult, requested: RequestedResults) -> PartResult:
    """The part with everything that the analysis asks for beside its load factor."""
    analysis, settings, log = requested.analysis, requested.settings, requested.log
    knobs = knobs_of(analysis)
    if knobs.range:
        result = _unless_it_breaks_down(result, lambda found: _with_range(found, analysis, settings, log))
    return _with_standing(result, settings) if knobs.standing else result


def _unless_it_breaks_down(result: PartResult, answered: Callable[[PartResult], PartResult]) -> PartResult:
    """The part with an answer, or a remark where its equations are singular: the load factor stays."""
    try:
        return answered(result)
    except np.linalg.LinAlgError as error:
        return result.with_remark(BROKE_DOWN.format(str(error).lower()), ())


def _with_range(result: PartResult, analysis: AnalysisSection, settings: SolverSettings, log: Log) -> PartResult:
    """Only of a state that fits the law: the mechanism of another one belongs to nothing."""
    state = None if result.sequence is None else result.sequence.state
    if state is None:
        return result
    if state.residual > RANGE_RESIDUAL:
        return result.with_remark(NO_RANGE.format(state.residual), ())
    slope = result.program.limits.dilatancy if analysis.flow_rule == "dilatancy" else 0.0
    return replace(result, range=factor_range(result.program, state, settings, log, len(result.programs) + 1, slope))


def _with_standing(result: PartResult, settings: SolverSettings) -> PartResult:
    associative = result.associative
    if associative.certificate is not None:
        return replace(result, standing=standing_without_equilibrium(result.program, associative.certificate))
    decided = associative.state is not None or associative.status is Status.UNBOUNDED
    state = assess_dead_load(result.program, settings, True if decided else None, associative.stress_free)
    return replace(result, standing=standing_on_model(result.program, state))


def standing_on_model(program: Program, state: DeadLoadState) -> StandingResult:
    """Standing of a part with its forces and displacements as those of the model, where they are known."""
    if state.forces is None or state.displacements is None:
        return state.standing
    forces = forces_of(program, state.forces)
    return replace(state.standing, forces=forces, settlement=settlement_of(program, state.displacements))
