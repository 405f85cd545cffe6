"""The load cases that are solved for one of the deck: itself, or a tilting table at one angle after the other.

A settlement starts from the reaction of a structure at rest on a support that has not given way yet. Any reaction R0
with which the structure is in equilibrium would do for bounds, since the answer R = R0 − λ U does not depend on it
(:mod:`mbla.model.settlement`). But where the structure is to stand with it, it must be one that arises by itself: from
the stress-free assembly while the support is held, else from the least contact forces, in the sense of ½ ‖x‖².
"""

from __future__ import annotations

from collections.abc import Generator, Iterator
from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.assembly.assembly import Assembly
from mbla.model.model import LoadCase
from mbla.model.settlement import with_reference
from mbla.program.assemble import assemble
from mbla.program.reductions import reduce_program
from mbla.program.reductions.steps import ReductionSwitches
from mbla.solution.cone_solvers.cone_solution import ConeSolution, Log
from mbla.solution.mechanics import forces_of
from mbla.solution.objective import HIGH, ends_of_force, measured_force, started
from mbla.solution.proof.static_repair import repaired_forces
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import IterationRecord
from mbla.solution.standing.standing import gravity_forces, least_forces
from mbla.solution.tilt import Angles, Answer, tilt_angles
from mbla.solution.verification.statics import contact_resultants
from mbla.solution.verification.verify import verify


class Trials:
    """Load cases to solve and verify in a loop, whose body returns each answer; the last answer is that of the case.

    ::

        for case in trials:
            trials.answer = Answer(case, solution, checks)
    """

    answer: Answer

    def __init__(self, cases: Angles) -> None:
        self._cases = cases

    def __iter__(self) -> Iterator[LoadCase]:
        try:
            case = next(self._cases)
            while True:
                yield case
                case = self._cases.send(self.answer)
        except StopIteration as end:
            self.answer = end.value


def trials_of(assembly: Assembly, load_case: LoadCase, settings: SolverSettings) -> Trials:
    """What is solved for a load case of the deck; of a support that gives way with the reaction that it starts from."""
    if load_case.tilt is not None:
        return Trials(_verified(assembly, tilt_angles(assembly, load_case)))
    if load_case.objective is not None:
        return Trials(ends_of_force(load_case, force_at_rest(assembly, load_case, settings)))
    return Trials(_once(posed(assembly, load_case, settings)))


def _once(load_case: LoadCase) -> Generator[LoadCase, Answer, Answer]:
    return (yield load_case)


def _verified(assembly: Assembly, angles: Angles) -> Angles:
    """The angle found is verified with what was found of the level table, which proves what lies before it."""
    answer = yield from angles
    return replace(answer, checks=verify(assembly, answer.load_case, answer.solution))


EVERY_POINT = ReductionSwitches(mirror=False, points=False)
"""Least forces need every point by itself: without those inside the hull of others a middle support would carry
nothing, and points that stand for two would count by half."""


def _silent(_: IterationRecord) -> None:
    """Iterations of the state at rest are not recorded."""


def posed(assembly: Assembly, load_case: LoadCase, settings: SolverSettings, log: Log = _silent) -> LoadCase:
    """A load case with its settlement posed; the same one where no support gives way.

    Where no forces were found that carry the dead load while the support is held the reaction starts high: a lack of
    equilibrium in the programs that follow is then not due to the reaction.
    """
    settlement = load_case.settlement
    if settlement is None:
        return load_case
    held = assembly.of(at_rest(load_case))
    total = forces_at_rest(assembly, load_case, settings, log, stress_free=settings.standing)
    if total is None:
        return with_reference(load_case, HIGH * settlement.unit)
    on_blocks = contact_resultants(held.model, held.contacts, total)[held.label[settlement.blocks]]
    reaction = float((settlement.motions * on_blocks).sum())
    return started(load_case, reaction)


def force_at_rest(assembly: Assembly, load_case: LoadCase, settings: SolverSettings) -> float | None:
    """The force of an objective in the sense of its end, by the least forces that carry the loads; None without."""
    total = forces_at_rest(assembly, load_case, settings, _silent)
    return None if total is None else measured_force(assembly.of(load_case), total)


def at_rest(load_case: LoadCase) -> LoadCase:
    """The dead load alone, while nothing gives way."""
    return replace(load_case, live_load=load_case.dead_load, settlement=None, objective=None)


def forces_at_rest(
    assembly: Assembly, load_case: LoadCase, settings: SolverSettings, log: Log, *, stress_free: bool = False
) -> FloatArray | None:
    """Least contact forces that carry the dead load while nothing gives way, (n_points, 3); None without.

    stress_free : those that arise from the stress-free assembly, where they carry it
    """
    held = at_rest(load_case)
    bodies = assembly.of(held)
    model, contacts = replace(bodies.model, mirrors=()), bodies.contacts
    program = assemble(model, contacts, bodies.load_case(held))
    parts = reduce_program(model, contacts, program, EVERY_POINT, associative=True).parts
    total = np.zeros((len(contacts.points), 3))
    for part in parts:
        part = part.without_live_load()
        forces = gravity_forces(part, settings, log) if stress_free else least_forces(part, settings, log)
        if isinstance(forces, ConeSolution):
            return None
        repaired = repaired_forces(part, forces, 0.0)
        total += forces_of(part, forces if repaired is None else repaired[0])
    return total
