"""Whether the structure stands under its dead load alone, before any live load.

That an equilibrium exists is weaker than that the structure stands. A bar between two fixed walls, touching both with
vertical faces, has an equilibrium for every friction above zero, since any thrust may be assumed; it falls unless the
walls are pressed together. Coupled rigid-block analysis rejects such states (Kao et al. 2022,
doi:10.1016/j.cad.2022.103216); limit analysis does not, and reports a load factor that means nothing. Here equilibrium
has to arise from the assembly without stress, by the exact law of the joints: see ``weak_spring_continuation``.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.process.sharing import shared
from mbla.process.stopwatch import stage
from mbla.program.build import CaseProgram
from mbla.program.program import Program
from mbla.program.static import gravity_form
from mbla.solution.cone_solvers.choice import cone_solver
from mbla.solution.cone_solvers.cone_solution import ConeSolution, Log
from mbla.solution.mechanics import forces_of, motion_of
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import WITH_VALUE, ProgramRecord, Standing, StandingResult, Status
from mbla.solution.standing.weak_spring_continuation import Outcome, Weakening, weaken_springs

YES = "the dead load is carried from the stress-free assembly"
NO_DEAD_LOAD = "there is no dead load to carry"
SELF_STRESS = "from the stress-free assembly it falls: it stands only in a self-stressed state"
DOUBTFUL = "whether it stands from the stress-free assembly is doubtful"
NO = "no contact forces carry the dead load"
UNKNOWN = "from the stress-free assembly it falls; whether it could stand in a self-stressed state was not decided"

GRAVEST_FIRST = (Standing.NO, Standing.SELF_STRESS, Standing.DOUBTFUL, Standing.YES)


@dataclass(frozen=True)
class DeadLoadState:
    """Standing, and the forces that arise from the stress-free assembly.

    forces        : (n_points, components), non-dimensional, in balance with the dead load up to 1e-6 of each block's;
                    None where they do not balance it
    displacements : (n_rows,) that cause them: what the verification needs in addition to the forces
    """

    standing: StandingResult
    forces: FloatArray | None
    displacements: FloatArray | None


@stage("standing")
def stress_free_state(program: Program, settings: SolverSettings) -> Weakening:
    """State of the stress-free assembly under its dead load: the same whatever the live load and the flow rule."""
    return _stress_free(program.without_live_load(), settings)


@shared("standing")
def _stress_free(program: Program, settings: SolverSettings) -> Weakening:
    """``stress_free_state`` of a program that has no live load."""
    if not np.any(program.dead_load):
        forces = np.zeros((program.n_points, program.components))
        displacements = np.zeros_like(program.dead_load)
        return Weakening(Outcome.CARRIED, None, 0.0, forces=forces, displacements=displacements)
    return weaken_springs(program, "dead_load", program.limits, settings)


def assess_dead_load(
    program: Program, settings: SolverSettings, carried: bool | None = True, known: Weakening | None = None
) -> DeadLoadState:
    """Assess the dead load of a program, reduced or not.

    carried : whether some contact forces within the yield conditions are known to carry the dead load; None where that
              was not decided. False needs no springs: see ``standing_without_equilibrium``
    known   : ``stress_free_state`` of the program where it was found before
    """
    weakening = known or stress_free_state(program, settings)
    if not np.any(program.dead_load):
        nothing = StandingResult(Standing.YES, None, NO_DEAD_LOAD)
        return DeadLoadState(nothing, weakening.forces, weakening.displacements)
    if weakening.outcome is Outcome.CARRIED:
        return DeadLoadState(StandingResult(Standing.YES, None, YES), weakening.forces, weakening.displacements)
    verdict, reason = (Standing.SELF_STRESS, SELF_STRESS) if carried else (Standing.NO, NO)
    if carried is None:
        verdict, reason = Standing.DOUBTFUL, UNKNOWN
    if weakening.outcome is Outcome.UNDECIDED:
        verdict, reason = Standing.DOUBTFUL, f"{DOUBTFUL}: {weakening.reason}"
    return DeadLoadState(StandingResult(verdict, weakening.block, reason), None, None)


def standing_where_carried(program: CaseProgram, settings: SolverSettings) -> StandingResult:
    """Standing of a load case whose dead load some contact forces are known to carry; without its forces."""
    parts = program.reduced.parts if program.convex is None else (program.convex.points,)
    return worst_standing([assess_dead_load(part, settings).standing for part in parts])


def standing_on_model(program: Program, state: DeadLoadState) -> StandingResult:
    """Standing of a part with its forces and displacements as those of the model, where they are known."""
    if state.forces is None or state.displacements is None:
        return state.standing
    forces = forces_of(program, state.forces)
    return replace(state.standing, forces=forces, settlement=settlement_of(program, state.displacements))


def settlement_of(program: Program, displacements: FloatArray) -> FloatArray:
    """Displacements and rotations of all blocks on joints of unit stiffness, (n_blocks, 6), zero where fixed.

    With a force of 1 per length of 1 in the deck's units, contact forces are those that these displacements cause; with
    joints k times as stiff everything moves 1/k as far. Those of parts add up. Where points are as stiff as their
    shares (:mod:`mbla.program.reductions.points`) 1 is the stiffest of them; joints of light blocks with units of their
    own are softer by the square of these.
    """
    stiffest = 1.0
    while program.reduction is not None:
        unit = float(program.reduction.velocities.power(2).sum(axis=0).max(initial=0.0)) or 1.0  # 1/f² of a part
        most = float(program.reduction.forces.power(2).sum(axis=1).max(initial=0.0)) * unit
        stiffest *= max(most, 1.0) / unit
        displacements, program = program.reduction.velocities @ displacements, program.reduction.full
    scaling = program.scaling
    return program.mechanism(displacements) * (stiffest * scaling.force**2 / scaling.live)


def least_forces(
    program: Program, settings: SolverSettings, log: Log, records: list[ProgramRecord] | None = None
) -> FloatArray | ConeSolution:
    """The least forces that carry the dead load, (n_points, components), or the solver's verdict; a line of records."""
    form, number = gravity_form(program), 0 if records is None else len(records) + 1
    solution = cone_solver(form.cone_program, settings, log).solve(number, 0.0)
    if records is not None:
        records.append(solution.record(number, "gravity", np.nan))
    return form.forces(solution.x) if solution.status in WITH_VALUE else solution


def gravity_forces(
    program: Program, settings: SolverSettings, log: Log, records: list[ProgramRecord], known: Weakening | None = None
) -> FloatArray | ConeSolution:
    """Forces under the dead load that flow without normality starts from, (n_points, components), or a verdict.

    They are those that arise from the stress-free assembly, where it stands. Where it does not, or that is doubtful,
    they are the least that carry the dead load. The least forces may hold a thrust between walls that nothing has
    caused: a bar lying on the ground between two walls and pushed along them, friction 0.5, then moves at 0.786
    instead of 0.5.

    records : gets a line
    known   : ``stress_free_state`` of the program where it was found before
    """
    started, number = time.perf_counter(), len(records) + 1
    stress_free = assess_dead_load(program, settings, known=known).forces
    if stress_free is not None:
        seconds = time.perf_counter() - started
        records.append(ProgramRecord(number, "gravity", Status.SOLVED, np.nan, np.nan, 0, seconds))
        return stress_free
    return least_forces(program, settings, log, records)


def worst_standing(results: Sequence[StandingResult]) -> StandingResult:
    """Standing of a structure from that of its parts: the most severe, the first of several; forces of all together."""
    worst = min(results, key=lambda result: GRAVEST_FIRST.index(result.verdict))
    if worst.verdict is not Standing.YES:
        return replace(worst, forces=None, settlement=None)
    forces = [result.forces for result in results if result.forces is not None]
    settlements = [result.settlement for result in results if result.settlement is not None]
    if len(forces) < len(results) or len(settlements) < len(results):
        return replace(worst, forces=None, settlement=None)
    return replace(worst, forces=np.sum(forces, axis=0), settlement=np.sum(settlements, axis=0))


def standing_without_equilibrium(program: Program, certificate: FloatArray) -> StandingResult:
    """What a motion, (n_rows,), in which the dead load does more work than the joints dissipate implies for standing.

    The block named is the one whose load does most of that work.
    """
    motion = motion_of(program, certificate)
    while program.reduction is not None:
        program = program.reduction.full
    load = (program.dead_load / program.scaling.row).reshape(-1, 6)
    work = (load * motion[program.free]).sum(axis=1)
    return StandingResult(Standing.NO, int(program.free[work.argmax()]), NO)
