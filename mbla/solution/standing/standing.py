"""Whether the structure stands under its dead load alone, before any live load.

That an equilibrium exists is weaker than that the structure stands. A bar between two fixed walls, touching both with
vertical faces, has an equilibrium for every friction above zero, since any thrust may be assumed; it falls unless the
walls are pressed together. Coupled rigid-block analysis rejects such states (Kao et al. 2022,
doi:10.1016/j.cad.2022.103216); limit analysis does not, and reports a load factor that means nothing. Here equilibrium
has to arise from the assembly without stress: by the gravity step of elastic joints
(:mod:`mbla.solution.flow.gravity_step`), at two ratios of their stiffness. Where the weak springs that hold the blocks
carry a share of the weight, the structure falls. The proof of standing are forces, and the displacements from which
these forces follow by the law of elastic joints without history.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from mbla.arrays import FloatArray, alike
from mbla.process.stopwatch import stage
from mbla.program.build import CaseProgram
from mbla.program.program import Program
from mbla.program.static import gravity_form
from mbla.program.stiffness_shares import shares_of
from mbla.solution.cone_solvers.choice import cone_solver
from mbla.solution.cone_solvers.cone_solution import ConeSolution, Log
from mbla.solution.flow.gravity_step import Gravity, gravity_step
from mbla.solution.flow.settings import RATIOS
from mbla.solution.full_model.mechanics import lifted, motion_of
from mbla.solution.law.elastic_joints import ElasticJoints
from mbla.solution.nonassociative.collapse_state import CollapseState, StepHistory
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import WITH_VALUE, ProgramRecord, Standing, StandingResult

YES = "the dead load is carried from the stress-free assembly"
NO_DEAD_LOAD = "there is no dead load to carry"
SELF_STRESS = "from the stress-free assembly it falls: it stands only in a self-stressed state"
DOUBTFUL = "whether it stands from the stress-free assembly is doubtful"
SLOWLY = "the gravity step of elastic joints was not solved"
BY_STIFFNESS = "it depends on how stiff the joints are in shear against compression"
NO = "no contact forces carry the dead load"
UNKNOWN = "from the stress-free assembly it falls; whether it could stand in a self-stressed state was not decided"

GRAVEST_FIRST = (Standing.NO, Standing.SELF_STRESS, Standing.DOUBTFUL, Standing.YES)


@dataclass(frozen=True)
class StressFree:
    """What the dead load does to the stress-free assembly.

    rest   : forces in balance with it, and the displacements that cause them by the history of joints that remember
             nothing; None where it is not carried with both ratios of stiffness
    motion : (n_rows,) displacements; of what falls mostly
    doubt  : why that is not decided; empty where it is
    gravity : the step with the first of both ratios; None without any
    """

    rest: CollapseState | None
    motion: FloatArray
    doubt: str = ""
    gravity: Gravity | None = None


MOST_STATES = 8
"""Of the last used: load cases differ in what symmetry they leave, and have a few parts."""


@dataclass
class StressFreeStates:
    """States that load cases, or decks, which are solved one after the other have in common, each with its program.

    Load cases of one dead load have the same but for what their live loads leave of reductions.
    """

    known: list[tuple[Program, StressFree]] = field(default_factory=list)

    def of(self, program: Program) -> StressFree:
        """That of a program as ``_stress_free`` takes it, found now or before."""
        found = next((each for each in self.known if alike(each[0], program)), None)
        self.known = [each for each in self.known if each is not found]
        self.known = [*self.known, found or (program, _stress_free(program))][-MOST_STATES:]
        return self.known[-1][1]


@stage("standing")
def stress_free_state(program: Program, states: StressFreeStates | None = None) -> StressFree:
    """State of the stress-free assembly under its dead load: the same whatever the live load and the flow rule.

    A support that settles later is held.

    states : those known, to which it is added
    """
    alone = replace(program, conditions=None)
    alone = alone if program.facts.settling_support else alone.without_live_load()
    return _stress_free(alone) if states is None else states.of(alone)


def _stress_free(program: Program) -> StressFree:
    """``stress_free_state`` of a program that has no live load, unless a support settles."""
    if not np.any(program.dead_load) or program.n_points == 0:  # nothing to carry, or guides alone to carry it
        none = np.zeros((program.n_points, program.components))
        still = np.zeros_like(program.dead_load)
        history = StepHistory(none, np.ones(program.n_points), np.ones(program.n_points))
        rest = None if np.any(program.dead_load) else CollapseState(none, still, 0.0, 0.0, history=history)
        return StressFree(rest, program.dead_load)
    first = ElasticJoints.of(program, shares_of(program), RATIOS[0])
    joints = [replace(first, shear=ratio * first.normal) for ratio in RATIOS]
    found = [gravity_step(one) for one in joints]
    motion = next((each.state.u for each in found if not each.carried), found[0].state.u)
    if all(gravity.carried for gravity in found):
        return StressFree(_at_rest(joints[0], found[0]), motion, gravity=found[0])
    doubt = BY_STIFFNESS if any(gravity.carried for gravity in found) else ""
    return StressFree(None, motion, doubt if all(gravity.settled for gravity in found) else SLOWLY)


def _at_rest(joints: ElasticJoints, gravity: Gravity) -> CollapseState:
    state = gravity.state
    history = StepHistory(np.zeros_like(state.forces), joints.normal, joints.shear)
    return CollapseState(state.forces, state.u, state.factor, 0.0, history=history)


def assess_dead_load(
    program: Program,
    carried: bool | None = True,
    known: StressFree | None = None,
    states: StressFreeStates | None = None,
) -> StandingResult:
    """Standing of a part, reduced or not, with forces and displacements of the model where it stands.

    carried : whether some contact forces within the yield conditions are known to carry the dead load; None where that
              was not decided
    known   : ``stress_free_state`` of the program where it was found before
    states  : as for that
    """
    found = known or stress_free_state(program, states)
    if found.rest is not None:
        shown = _on_model(program, found.rest)
        return shown if np.any(program.dead_load) else replace(shown, reason=NO_DEAD_LOAD)
    block = int(np.linalg.norm(motion_of(program, found.motion), axis=1).argmax())
    if found.doubt:
        return StandingResult(Standing.DOUBTFUL, block, f"{DOUBTFUL}: {found.doubt}")
    if carried is None:
        return StandingResult(Standing.DOUBTFUL, block, UNKNOWN)
    verdict, reason = (Standing.SELF_STRESS, SELF_STRESS) if carried else (Standing.NO, NO)
    return StandingResult(verdict, block, reason)


def _on_model(program: Program, rest: CollapseState) -> StandingResult:
    """Forces, and the displacements that cause them on joints the stiffest of which has a stiffness of 1.

    With a force of 1 per length of 1 in the deck's units; with joints k times as stiff everything moves 1/k as far.
    """
    program, rest = program.full, lifted(program, rest)
    assert rest.history is not None
    scaling = program.scaling
    units = scaling.force * np.broadcast_to(scaling.units, len(rest.history.normal))
    stiffest = float((np.maximum(rest.history.normal, rest.history.shear) * units**2).max(initial=0.0)) / scaling.live
    settlement = program.mechanism(rest.velocities) * stiffest
    return StandingResult(Standing.YES, None, YES, scaling.forces(rest.forces), settlement)


def standing_where_carried(program: CaseProgram) -> StandingResult:
    """Standing of a load case whose dead load some contact forces are known to carry."""
    return worst_standing([assess_dead_load(part) for part in program.reduced.parts])


def least_forces(
    program: Program, settings: SolverSettings, log: Log, records: list[ProgramRecord] | None = None
) -> FloatArray | ConeSolution:
    """The least forces that carry the dead load, (n_points, components), or the solver's verdict; a line of records."""
    form, number = gravity_form(program), 0 if records is None else len(records) + 1
    solution = cone_solver(form.cone_program, settings, log).solve(number, 0.0)
    if records is not None:
        records.append(solution.record(number, "gravity", np.nan))
    return form.forces(solution.x) if solution.status in WITH_VALUE else solution


def gravity_forces(program: Program, settings: SolverSettings, log: Log) -> FloatArray | ConeSolution:
    """Forces under the dead load, (n_points, components): those that arise from the stress-free assembly where it
    stands, else the least that carry the dead load, or the solver's verdict.

    The least forces may hold a thrust between walls that nothing has caused.
    """
    found = stress_free_state(program)
    return least_forces(program, settings, log) if found.rest is None else found.rest.forces


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
    """What a motion in which the dead load does more work than the joints dissipate implies for standing.

    certificate : velocities of the blocks, others behind. The block named is the one whose load does most of that work.
    """
    motion, program = motion_of(program, certificate[: len(program.dead_load)]), program.full
    load = (program.dead_load / program.scaling.row).reshape(-1, 6)
    work = (load * motion[program.facts.free]).sum(axis=1)
    return StandingResult(Standing.NO, int(program.facts.free[work.argmax()]), NO)
