"""A load case without a load factor: whether it stands under its dead load, from where it vibrates or moves in time.

Its solution claims that, and no more: the verdict on standing with the forces that show it, or a motion in which it
falls. Modes of vibration are its answer where nothing else is asked.
"""

from __future__ import annotations

import time
from dataclasses import replace

from mbla.assembly.assembly import Assembly
from mbla.model.model import LoadCase
from mbla.program.build import CaseProgram, build_program
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.full_model.lifted import solution_on_blocks
from mbla.solution.further.further import Further
from mbla.solution.modes.checked import checked_modes_of
from mbla.solution.sequence.solved_case import SolvedCase
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Solution, Standing, Status
from mbla.solution.solve import solve
from mbla.solution.standing.standing import StressFreeStates, assess_dead_load, worst_standing
from mbla.solution.verification.verify import verify


def at_rest_alone(
    assembly: Assembly,
    load_case: LoadCase,
    settings: SolverSettings,
    log: Log | None = None,
    states: StressFreeStates | None = None,
) -> SolvedCase:
    """Whether it stands, and its modes where they are what is asked; verified."""
    program = build_program(assembly, load_case.dead_alone, settings.analysis)
    solution = _standing(program, settings, log, states)
    if load_case.modes and load_case.time_history is None and solution.status is Status.SOLVED:
        modes, remarks = checked_modes_of(assembly, load_case, load_case.modes)
        solution = solution.with_further(Further(modes=modes), remarks)
        if modes.reason:
            solution = replace(solution, status=Status.NOT_VERIFIED, reason=modes.reason)
    return SolvedCase(load_case, solution, verify(assembly, load_case, solution))


def _standing(
    program: CaseProgram, settings: SolverSettings, log: Log | None, states: StressFreeStates | None
) -> Solution:
    """Solved where it stands from the stress-free assembly; else with what shows that it does not, or why in doubt."""
    started = time.perf_counter()
    analysis, reduced = settings.analysis, program.reduced
    standing = worst_standing([assess_dead_load(part, states=states) for part in reduced.parts])
    solution = Solution(
        flow_rule=analysis.flow_rule,
        status=Status.SOLVED,
        contact_model=analysis.contact_model,
        stress_blocks=program.crushing is not None,
        standing=standing,
        size=reduced.size,
        reductions=reduced.steps,
        solver=settings.solver,
    )
    if standing.verdict is not Standing.YES:
        normality = analysis.model_copy(update={"flow_rule": "associative"})
        found = solve(program, replace(settings, standing=True, analysis=normality), log, states)
        falls = found.status is Status.NO_EQUILIBRIUM
        return replace(
            solution,
            status=Status.NO_EQUILIBRIUM if falls else Status.NOT_VERIFIED,
            reason=found.reason if falls or found.standing is None else found.standing.reason,
            standing=found.standing or standing,
            certificate=found.certificate,
            certificate_motions=found.certificate_motions,
            programs=found.programs,
            iterations=found.iterations,
            seconds=time.perf_counter() - started,
        )
    return replace(solution_on_blocks(solution, program.bodies), seconds=time.perf_counter() - started)
