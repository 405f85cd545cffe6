"""One load case through the solver stage: its parts one after the other, then the whole structure."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from mbla.deck.analysis import AnalysisSection
from mbla.program.program import Program
from mbla.program.reductions import Reduced
from mbla.solution.clarabel_adapter import Log
from mbla.solution.law_state import LawState
from mbla.solution.locking import locking_forces
from mbla.solution.mechanics import mechanics_of, motion_of
from mbla.solution.part import PartResult, solve_part
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import IterationRecord, Mechanics, ProgramRecord, Solution, Standing, Status
from mbla.solution.standing import worst_standing
from mbla.solution.whole import whole_state

WITH_VALUE = (Status.SOLVED, Status.APPROXIMATE)

FAILED = (
    Status.NO_EQUILIBRIUM,
    Status.TIME_LIMIT,
    Status.NUMERICAL_ERROR,
    Status.ITERATION_LIMIT,
    Status.NOT_VERIFIED,
)
"""what of one part decides for all, the gravest first"""

LOCK_NOT_PROVED = (
    "the solver finds no mechanism in which the live load does work, but no forces that carry every multiple of it "
    "were found to prove that"
)

ONLY_BY_SELF_STRESS = (
    "it stands only by forces locked in between the blocks beforehand: without knowing these there is no collapse load"
)


@dataclass(frozen=True)
class _Stage:
    """What every step of one load case needs."""

    parts: tuple[Program, ...]
    settings: SolverSettings
    log: Log

    def mechanics(self, part: int, state: LawState | None, flow_rule: str) -> Mechanics | None:
        """A state of one part as mechanics of the whole model; None where the other parts do not carry it."""
        whole = None if state is None else whole_state(self.parts, part, state, self.settings, self.log)
        return None if whole is None else mechanics_of(*whole, flow_rule)


def solve(reduced: Reduced, analysis: AnalysisSection, settings: SolverSettings, log: Log | None = None) -> Solution:
    """Load factor of one load case by the flow rule of ``analysis``.

    log : called once per iteration of a cone program, as it goes
    """
    started = time.perf_counter()
    iterations: list[IterationRecord] = []

    def record(iteration: IterationRecord) -> None:
        iterations.append(iteration)
        if log is not None:
            log(iteration)

    stage = _Stage(reduced.parts, settings, record)
    results = [solve_part(program, analysis, settings, record) for program in reduced.parts]
    solution = _combined(stage, analysis, results)
    assessed = [result.standing for result in results if result.standing is not None]
    standing = worst_standing(assessed) if assessed else None
    if standing is not None and standing.verdict is Standing.SELF_STRESS:
        solution = _without_claim(solution)
    return replace(
        solution,
        sides=0 if solution.outer is None else analysis.sides,
        standing=standing,
        programs=_renumbered(results),
        iterations=tuple(iterations),
        seconds=time.perf_counter() - started,
        size=reduced.size,
    )


def _combined(stage: _Stage, analysis: AnalysisSection, results: Sequence[PartResult]) -> Solution:
    """The part that decides: one that cannot stand, one that could not be solved, or the first to collapse."""
    for status in FAILED:
        for part, result in enumerate(results):
            if result.associative.status is status:
                return _without_load_factor(stage, analysis, part, result)
    bounded = [part for part, result in enumerate(results) if _load_factor(result) < np.inf]
    if not bounded:
        loaded = [part for part, result in enumerate(results) if result.loaded]
        return _without_load_factor(stage, analysis, loaded[0], results[loaded[0]])
    first = min(bounded, key=lambda part: _load_factor(results[part]))
    first_associative = min(range(len(results)), key=lambda part: _factor(results[part].associative.state))
    return _with_load_factor(stage, analysis, results, first, first_associative)


def _load_factor(result: PartResult) -> float:
    """By the flow rule of the analysis, the associative one where that gave none."""
    return _factor(result.state if result.state is not None else result.associative.state)


def _factor(state: LawState | None) -> float:
    return np.inf if state is None else state.load_factor


def _without_load_factor(stage: _Stage, analysis: AnalysisSection, part: int, result: PartResult) -> Solution:
    associative, lock = result.associative, None
    status, reason = associative.status, associative.reason
    if status is Status.UNBOUNDED:
        lock = locking_forces(stage.parts, stage.settings, stage.log)
        if lock is None:
            status, reason = Status.NOT_VERIFIED, LOCK_NOT_PROVED
    certificate = associative.certificate
    motion = None if certificate is None else motion_of(stage.parts[part], certificate)
    return replace(_solution(analysis, status, reason), certificate=motion, lock=lock)


def _with_load_factor(
    stage: _Stage, analysis: AnalysisSection, results: Sequence[PartResult], first: int, first_associative: int
) -> Solution:
    result = results[first]
    solution = _solution(analysis, result.status, result.reason)
    associative = stage.mechanics(first_associative, results[first_associative].associative.state, "associative")
    outer = _outer(stage, results)
    remarks = tuple(remark for result in results for remark in result.remarks)
    if result.sequence is None:
        return replace(solution, mechanics=associative, associative=associative, outer=outer, remarks=remarks)
    sequence, live = result.sequence, stage.parts[first].scaling.live
    ends = result.range
    return replace(
        solution,
        mechanics=stage.mechanics(first, sequence.state, analysis.flow_rule),
        lower=None if ends is None else stage.mechanics(first, ends.lower, analysis.flow_rule),
        upper=None if ends is None else stage.mechanics(first, ends.upper, analysis.flow_rule),
        associative=associative,
        scheme=analysis.scheme,
        outer=outer,
        remarks=(*remarks, *sequence.remarks),
        spread=None if sequence.spread is None else (sequence.spread[0] * live, sequence.spread[1] * live),
        path=sequence.path,
    )


def _outer(stage: _Stage, results: Sequence[PartResult]) -> Mechanics | None:
    """With circumscribed friction polyhedra: the part that collapses first; None where none were asked for."""
    states = [None if result.outer is None else result.outer.state for result in results]
    if all(state is None for state in states):
        return None
    first = min(range(len(states)), key=lambda part: _factor(states[part]))
    return stage.mechanics(first, states[first], "associative")


def _solution(analysis: AnalysisSection, status: Status, reason: str) -> Solution:
    """A solution without forces and mechanism."""
    return Solution(
        flow_rule=analysis.flow_rule,
        status=status,
        mechanics=None,
        associative=None,
        certificate=None,
        reason=reason,
        programs=(),
        iterations=(),
        seconds=0.0,
        sides=analysis.sides if analysis.friction_cone == "polyhedral" else 0,
    )


def _without_claim(solution: Solution) -> Solution:
    """What stands by forces locked in beforehand has no load factor without them, save the associative upper value."""
    if solution.flow_rule == "associative":
        return solution
    status = Status.NOT_VERIFIED if solution.status in WITH_VALUE else solution.status
    return replace(solution, status=status, reason=ONLY_BY_SELF_STRESS)


def _renumbered(results: Sequence[PartResult]) -> tuple[ProgramRecord, ...]:
    """Programs of all parts, numbered in the order in which they were solved."""
    records = [record for result in results for record in result.programs]
    return tuple(replace(record, program=number) for number, record in enumerate(records, start=1))
