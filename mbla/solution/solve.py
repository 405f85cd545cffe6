"""One load case through the solver stage: associative first, then the sequence that the flow rule asks for."""

from __future__ import annotations

import time

import numpy as np

from mbla.deck.types import AnalysisSection
from mbla.program.program import Program
from mbla.solution.associative import AssociativeResult, solve_associative
from mbla.solution.clarabel_adapter import Log
from mbla.solution.law_state import SequenceResult
from mbla.solution.mechanics import mechanics_of, motion_of
from mbla.solution.proximal import solve_proximal
from mbla.solution.published import solve_published
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import IterationRecord, Solution, Status


def solve(program: Program, analysis: AnalysisSection, settings: SolverSettings, log: Log | None = None) -> Solution:
    """Load factor of one load case by the flow rule of ``analysis``.

    log : called once per iteration of a cone program, as it goes
    """
    started = time.perf_counter()
    iterations: list[IterationRecord] = []

    def record(iteration: IterationRecord) -> None:
        iterations.append(iteration)
        if log is not None:
            log(iteration)

    associative = solve_associative(program, settings, record)
    if analysis.flow_rule == "associative" or associative.state is None:
        return _associative_solution(
            program, analysis.flow_rule, associative, iterations, time.perf_counter() - started
        )
    if analysis.flow_rule == "non_associative" and analysis.scheme != "published":
        sequence = solve_proximal(program, associative, analysis.proximal.max_programs, settings, record)
    else:
        dilatancy = program.limits.dilatancy if analysis.flow_rule == "dilatancy" else np.zeros(program.n_points)
        sequence = solve_published(program, associative, analysis.published, dilatancy, settings, record)
    return _sequence_solution(program, analysis, associative, sequence, iterations, time.perf_counter() - started)


def _associative_solution(
    program: Program, flow_rule: str, result: AssociativeResult, iterations: list[IterationRecord], seconds: float
) -> Solution:
    reason = result.reason
    if result.status is Status.UNBOUNDED and flow_rule != "associative":
        reason += (
            "; this holds for associative flow, and does not decide whether there is a load factor without dilatancy"
        )
    mechanics = None if result.state is None else mechanics_of(program, result.state)
    return Solution(
        flow_rule=flow_rule,
        status=result.status,
        mechanics=mechanics,
        associative=mechanics,
        certificate=None if result.certificate is None else motion_of(program, result.certificate),
        reason=reason,
        programs=result.programs,
        iterations=tuple(iterations),
        seconds=seconds,
    )


def _sequence_solution(
    program: Program,
    analysis: AnalysisSection,
    associative: AssociativeResult,
    sequence: SequenceResult,
    iterations: list[IterationRecord],
    seconds: float,
) -> Solution:
    assert associative.state is not None
    live = program.scaling.live
    return Solution(
        flow_rule=analysis.flow_rule,
        status=associative.status if sequence.status is Status.SOLVED else sequence.status,
        mechanics=None if sequence.state is None else mechanics_of(program, sequence.state),
        associative=mechanics_of(program, associative.state),
        certificate=None,
        reason=sequence.reason or associative.reason,
        programs=sequence.programs,
        iterations=tuple(iterations),
        seconds=seconds,
        remarks=sequence.remarks,
        spread=None if sequence.spread is None else (sequence.spread[0] * live, sequence.spread[1] * live),
        path=sequence.path,
    )
