"""A settling support: the reaction of the structure at rest, from which its load factor counts, and one analysis.

A settlement starts from the reaction of a structure at rest on a support that has not given way yet. Any reaction R0
with which the structure is in equilibrium would do for bounds, since the answer R = R0 − λ U does not depend on it
(:mod:`mbla.model.settlement`). But where the structure is to stand with it, it must be one that arises by itself: from
the stress-free assembly while the support is held, else from the least contact forces, in the sense of ½ ‖x‖².
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.assembly.assembly import Assembly
from mbla.model.model import LoadCase
from mbla.model.settlement import with_reference
from mbla.program.assemble import assemble
from mbla.program.reductions import reduce_program
from mbla.program.reductions.steps import ReductionSwitches
from mbla.questions.load_factor import LOAD_FACTOR
from mbla.solution.cone_solvers.cone_solution import ConeSolution
from mbla.solution.full_model.mechanics import forces_of
from mbla.solution.proof.static_repair import repaired_forces
from mbla.solution.sequence.solved_case import AnalysisSequence
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import IterationRecord
from mbla.solution.standing.standing import gravity_forces, least_forces
from mbla.solution.verification.statics import contact_resultants

MARGIN = 1e-9
"""Added to a reaction at rest, over its unit: where statics alone gives it, rounding must not make it too small to
carry the loads."""

NO_REACTION = 1e-11
"""Reaction at rest over its unit that is rounding: it starts from nothing, for what hardly holds anything might not
carry the margin."""

HIGH = 10.0
"""Reaction over its unit, more than any structure is likely to need."""

EVERY_POINT = ReductionSwitches(mirror=False, points=False)
"""Least forces need every point by itself: without those inside the hull of others a middle support would carry
nothing, and points that stand for two would count by half."""


def _silent(_: IterationRecord) -> None:
    """Iterations of the state at rest are not recorded."""


def settled(assembly: Assembly, load_case: LoadCase, settings: SolverSettings) -> AnalysisSequence:
    """One analysis; where a support settles with the reaction that it starts from."""
    return (yield posed(assembly, load_case, settings))


def posed(assembly: Assembly, load_case: LoadCase, settings: SolverSettings) -> LoadCase:
    """A load case with its settlement posed; the same one where no support settles.

    Where no forces were found that carry the dead load while the support is held the reaction starts high: a lack of
    equilibrium in the programs that follow is then not due to the reaction.
    """
    question = load_case.question
    if question.multiplies:
        return load_case
    held = assembly.of(at_rest(load_case))
    total = forces_at_rest(assembly, load_case, settings, stress_free=settings.standing)
    if total is None:
        return with_reference(load_case, HIGH * question.scale)
    on_blocks = contact_resultants(held.model, held.contacts, total)[held.label[question.giving_way]]
    return started(load_case, float((question.ways * on_blocks).sum()))


def started(load_case: LoadCase, at_rest: float) -> LoadCase:
    """The load case of a settlement or objective with the reaction from which it starts, from one at rest."""
    unit = load_case.question.scale
    return with_reference(load_case, 0.0 if abs(at_rest) <= NO_REACTION * unit else at_rest + MARGIN * unit)


def at_rest(load_case: LoadCase) -> LoadCase:
    """The dead load alone, while nothing gives way."""
    return replace(load_case, live_load=load_case.dead_load, question=LOAD_FACTOR)


def forces_at_rest(
    assembly: Assembly, load_case: LoadCase, settings: SolverSettings, *, stress_free: bool = False
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
        forces = gravity_forces(part, settings, _silent) if stress_free else least_forces(part, settings, _silent)
        if isinstance(forces, ConeSolution):
            return None
        repaired = repaired_forces(part, forces, 0.0)
        total += forces_of(part, forces if repaired is None else repaired[0])
    return total
