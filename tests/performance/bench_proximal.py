"""Proximal programs of the non-associative scheme, and the scheme as a whole, by solver; to results/proximal.csv.

::

    python -m tests.performance.bench_proximal [NAME ...]

``lagged programs``: the first ten convex steps from the gravity state as cone programs in forces, one solver object
updated from one to the next, the anchor moving 0.7 of the way each time, at each of ``TOLERANCES``; clarabel with every
factorisation that it has here, named ones, as what it takes by itself need not be its best. ``gain`` is the time of the
fastest of clarabel's runs *at that tolerance* over this one's, ``difference`` that of the last load factor from the one
of this package at the sharpest tolerance, relative: compare times of like differences. ``statuses`` counts how the ten
programs ended. ``whole``: everything that a non-associative analysis takes with that ``analysis.solver``; that word
decides on the associative programs alone, as steps of the exact law are no cone programs. Seconds of the processor.
"""

from __future__ import annotations

import sys
import time
from collections import Counter
from dataclasses import dataclass, replace

from mbla.deck.sections.analysis import AnalysisSection
from mbla.program.program import Program
from mbla.program.reductions import reduce_program, unreduced
from mbla.program.reductions.steps import ReductionSwitches
from mbla.program.static import proximal_data, proximal_form
from mbla.solution.cone_solvers.clarabel_adapter import ClarabelProgram
from mbla.solution.cone_solvers.interior_point.program import CondensedProgram
from mbla.solution.linear_algebra import installed
from mbla.solution.nonassociative.gravity import gravity_forces
from mbla.solution.nonassociative.proximal import MOVE, step_size
from mbla.solution.part import solve_part
from mbla.solution.settings import SolverSettings, solver_settings
from mbla.solution.solution import IterationRecord, ProgramRecord
from tests.performance.bench_solver import SLAB, Case, wall
from tests.performance.recording import record

PROGRAMS = 10
TOLERANCES = 1e-9, 1e-8, 1e-7
WHOLE = "clarabel", "mbla", "auto"

CASES = {
    f"wall {m} x {n}{', spatial' if spatial else ''}": Case(SLAB, wall(m, n), spatial=spatial)
    for m, n in ((20, 20), (40, 25))
    for spatial in (False, True)
}


@dataclass(frozen=True)
class Run:
    """What a run took and where it ended."""

    seconds: float
    iterations: int
    load_factor: float
    residual: float | None = None
    status: str = ""


def program_of(case: Case) -> tuple[Program, AnalysisSection]:
    """The only part of a case, and its analysis without what comes after the load factor."""
    line = case.line()
    reduced = unreduced(line.program, line.contacts)
    if not case.spatial:
        reduced = reduce_program(line.model, line.contacts, line.program, ReductionSwitches(), associative=False)
    (program,) = reduced.parts
    return program, line.deck.analysis.model_copy(update={"standing": False, "range": False})


def lagged_programs(
    program: Program, kind: type[CondensedProgram] | type[ClarabelProgram], settings: SolverSettings
) -> Run:
    """Ten proximal programs from the gravity state."""
    records: list[ProgramRecord] = []
    anchor = gravity_forces(program, settings, silent, records)
    assert not hasattr(anchor, "status")
    limits = program.limits
    started, iterations, factor = time.process_time(), 0, 0.0
    form = proximal_form(program, rho := step_size(program, anchor))
    solver, statuses = kind(form.cone_program, settings, silent), Counter[str]()
    for number in range(PROGRAMS):
        cost, rhs = proximal_data(form, rho, anchor, limits.friction * anchor[:, 0].clip(0.0) + limits.cohesion)
        solver.update(cost=cost, rhs=rhs)
        solution = solver.solve(number + 1, 1.0)
        iterations += solution.iterations
        statuses[solution.solver_status] += 1
        factor = form.load_factor(solution.x)
        anchor = MOVE * form.forces(solution.x) + (1.0 - MOVE) * anchor
    seconds, words = time.process_time() - started, " ".join(f"{word}:{count}" for word, count in statuses.items())
    return Run(seconds, iterations, program.scaling.load_factor(factor), status=words)


def whole(program: Program, analysis: AnalysisSection, settings: SolverSettings) -> Run:
    """The associative programs and the default scheme."""
    started = time.process_time()
    result = solve_part(program, analysis, settings, silent)
    seconds = time.process_time() - started
    assert result.state is not None
    return Run(
        seconds,
        sum(step.iterations for step in result.programs),
        program.scaling.load_factor(result.state.load_factor),
        result.state.residual,
        str(result.status),
    )


def silent(iteration: IterationRecord) -> None:
    """No progress is shown."""


def lagged_runs(program: Program, settings: SolverSettings) -> dict[tuple[str, float], Run]:
    """The ten programs by every solver at every tolerance; this package's at the sharpest one first."""
    found = {}
    for tolerance in TOLERANCES:
        sharp = replace(settings, tolerance=tolerance)
        found["mbla", tolerance] = lagged_programs(program, CondensedProgram, sharp)
        found["clarabel qdldl", tolerance] = lagged_programs(program, ClarabelProgram, sharp)
    return found


def main(names: list[str]) -> None:
    """All cases, or those named."""
    for name in names or list(CASES):
        program, analysis = program_of(CASES[name])
        settings = solver_settings(analysis)
        lagged = lagged_runs(program, settings)
        reference = lagged["mbla", TOLERANCES[0]].load_factor
        for (solver, tolerance), run in lagged.items():
            best = min(r.seconds for (s, t), r in lagged.items() if t == tolerance and s.startswith("clarabel"))
            _record(name, "lagged programs", solver, tolerance, run, best, reference)
        wholes = {solver: whole(program, analysis, replace(settings, solver=solver)) for solver in WHOLE}
        for solver, run in wholes.items():
            theirs = wholes["clarabel"]
            _record(name, "whole", solver, settings.tolerance, run, theirs.seconds, theirs.load_factor)


def _record(name: str, what: str, solver: str, tolerance: float, run: Run, best: float, reference: float) -> None:
    record(
        "proximal",
        {
            "case": name,
            "what": what,
            "solver": solver,
            "tolerance": tolerance,
            "installed": " ".join(installed()),
            "seconds": run.seconds,
            "gain": best / run.seconds,
            "iterations": run.iterations,
            "load_factor": f"{run.load_factor:.9g}",
            "difference": abs(run.load_factor - reference) / abs(reference),
            "residual": "" if run.residual is None else run.residual,
            "statuses": run.status,
        },
    )


if __name__ == "__main__":
    main(sys.argv[1:])
