"""Run one deck under one setting, load case by load case, and tell what each took: the part of the child process."""

from __future__ import annotations

import io
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mbla.contacts.glue import held_model
from mbla.model import build_model
from mbla.model.model import LoadCase, Model
from mbla.results.diff.cases import accuracy_of
from mbla.results.outcome import law_residual, range_of
from mbla.results.results import CaseResult
from mbla.results.sta import StatusFile
from mbla.run import contacts_of, select_cases, solve_case, with_settlements
from mbla.solution.settings import solver_settings
from mbla.sweeps.measure.answer import answer_of, is_verified, verdict_of
from mbla.sweeps.measure.measurement import NAN, Measurement
from mbla.sweeps.measure.peak_memory import forget_peak, of_files, peak, resident
from mbla.sweeps.measure.setting import Setting, read_setting

REPEATS = 3
"""runs of a load case at most, of which the shortest is told"""
SHORT = 1.0
"""seconds of all of them after which no further one is begun: what takes as long is measured well enough"""


@dataclass(frozen=True)
class Task:
    """One run that a child is asked for; fields as of ``read_setting`` and ``RunOptions``."""

    deck: str
    fixed: tuple[str, ...] = ()
    overrides: tuple[str, ...] = ()
    freed: tuple[str, ...] = ()
    cases: tuple[str, ...] = ()


def measure(task: Task) -> Iterator[Measurement]:
    """Run the load cases of a task one after the other; raises as ``solve_deck`` does."""
    forget_peak()
    base, started = resident() - of_files(), time.perf_counter()
    deck = read_setting(Path(task.deck), task.fixed, Setting(task.overrides, task.freed))
    model = build_model(deck)
    load_cases = select_cases(model, task.cases)
    contacts = contacts_of(deck, model)
    model = held_model(model, contacts)
    preparation = time.perf_counter() - started
    settings = solver_settings(deck.analysis)

    def solve(load_case: LoadCase, first: bool) -> tuple[Model, CaseResult]:
        own = settings if first else solver_settings(deck.analysis)
        posed, (ready,) = with_settlements(model, contacts, (load_case,), own)
        status_file = StatusFile(io.StringIO(), "")
        return posed, solve_case(deck, posed, contacts, ready, own, status_file, None)

    for load_case in load_cases:
        yield _measured(load_case, solve, base, preparation)


def _measured(
    load_case: LoadCase, solve: Callable[[LoadCase, bool], tuple[Model, CaseResult]], base: float, preparation: float
) -> Measurement:
    """Shortest of a few runs; memory is that of the first, in which nothing is left of one before."""
    forget_peak()
    walls: list[float] = []
    told: tuple[Model, CaseResult, float] | None = None
    memory = NAN
    while len(walls) < REPEATS and sum(walls) < SHORT:
        clock, processor = time.perf_counter(), time.process_time()
        model, case = solve(load_case, not walls)
        wall, cpu = time.perf_counter() - clock, time.process_time() - processor
        if told is None:
            memory = max(peak() - of_files() - base, 0.0)
        if not walls or wall < min(walls):
            told = model, case, cpu
        walls.append(wall)
    assert told is not None
    model, case, cpu = told
    effort = {"wall": min(walls), "cpu": cpu, "memory": memory, "preparation": preparation, "repeats": len(walls)}
    return measurement_of(model, case, effort)


def measurement_of(model: Model, case: CaseResult, effort: dict[str, Any]) -> Measurement:
    """Figures of a case that was solved, with what it took."""
    solution, travel, ends = case.solution, case.load_case.travel, range_of(case) or (NAN, NAN)
    answer, verdict = answer_of(model, case), verdict_of(case)
    return Measurement(
        case=case.load_case.name,
        status=case.status.value,
        verdict=verdict,
        verified=is_verified(case),
        series="" if travel is None else travel.series,
        reason=solution.reason or "; ".join(case.checks.failures),
        kind=answer.kind,
        unit=answer.unit,
        answer=answer.value,
        least=answer.least,
        accuracy=accuracy_of(case) if verdict == "answer" else NAN,
        lower_bound=answer.lower,
        upper_bound=answer.upper,
        residual=law_residual(case.checks),
        range_lower=ends[0],
        range_upper=ends[1],
        dimension=0 if solution.size is None else solution.size.dimension,
        programs=len(solution.programs),
        iterations=sum(program.iterations for program in solution.programs),
        solvers=" ".join(dict.fromkeys(program.solver for program in solution.programs if program.solver)),
        solver=float(sum(program.seconds for program in solution.programs)),
        **effort,
    )
