"""Verification of one load case: each claim of a solution is recomputed by the file that knows it.

- ``verify_points``: residuals of forces and mechanism, bounds of the associative load factor, certificates;
- ``verify_convex``: the first with conditions on the resultants of interfaces;
- ``standing``, ``lock``, ``least``, ``tilting_table``: what is claimed in addition to the load factor.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.assembly.assembly import Assembly
from mbla.assembly.rigid_bodies import RigidBodies
from mbla.assembly.structure_at import StructureAt
from mbla.contacts.contacts import Contacts
from mbla.errors import Message
from mbla.model.model import LoadCase, Model
from mbla.process.stopwatch import stage
from mbla.questions.angle import Angle
from mbla.questions.load_factor import LOAD_FACTOR
from mbla.solution.full_model.lifted import model_of, rule_of, solution_on_bodies
from mbla.solution.modes.modes import NO_MODES
from mbla.solution.solution import Checks, Solution, Standing, Status
from mbla.solution.verification.case import LoadedModel
from mbla.solution.verification.elastic_law import elastic_residual
from mbla.solution.verification.in_time.history import history_failures
from mbla.solution.verification.least import least_check
from mbla.solution.verification.lock import lock_failures
from mbla.solution.verification.modes import checked_modes
from mbla.solution.verification.residuals import residuals_of
from mbla.solution.verification.standing import standing_failures
from mbla.solution.verification.strengths import point_strengths
from mbla.solution.verification.tilting_table import never_failures, tilt_failures
from mbla.solution.verification.verify_convex import (
    InterfaceCase,
    convex_lock_failures,
    point_limits,
    torsion_check,
    verify_convex,
)
from mbla.solution.verification.verify_points import verify_points

NOT_SHOWN = Message("standing-not-proved", "nothing is given that shows that it stands under the dead load alone")
SHOWN = Message(
    "standing-not-proved", "it is said not to stand under the dead load alone, and its forces show that it does"
)
FALL_NOT_SHOWN = Message(
    "standing-not-proved", "it is said to fall under the dead load alone, and no motion is given that shows it"
)
FALL_SHOWN = Message(
    "standing-not-proved", "a motion is given in which it falls under the dead load alone, and it is not said to"
)
NOTHING_ACTS = Message("standing-not-proved", "it is said not to stand under the dead load alone, and there is none")

APART = 1e-9
"""Motion of glued blocks against each other, over the largest motion: rounding of the map from bodies to blocks."""


@stage("verify")
def verify(assembly: Assembly, load_case: LoadCase, solution: Solution) -> Checks:
    """Recompute everything that a solution claims, from the assembly alone; NaN where there is nothing to check.

    No solver is called, and no matrix of the program stage is used for a verdict. Blocks that are glued to each other
    are judged as the rigid body they form.
    """
    bodies = assembly.of(load_case)
    of_bodies, apart = solution_on_bodies(solution, bodies)
    checks = _verify(*_claimed(bodies, load_case), of_bodies)
    if load_case.question.group == "modes" and solution.further.modes is not NO_MODES:
        _, wrong = checked_modes(StructureAt.as_built(assembly, load_case), solution.further.modes)
        failures = tuple(Message("modes-not-verified", words) for words in wrong)
        checks = replace(checks, verified=checks.verified and not wrong, failures=(*checks.failures, *failures))
    if not apart <= APART:
        words = f"blocks that are glued to each other move apart, by {apart:.2g} of the largest motion"
        failure = Message("glued-blocks-part", words)
        checks = replace(checks, verified=False, failures=(*checks.failures, failure))
    if failures := history_failures(assembly, load_case, solution.further.time_history)[1]:
        checks = replace(checks, verified=False, failures=(*checks.failures, *failures))
    return checks


def _claimed(bodies: RigidBodies, load_case: LoadCase) -> tuple[Model, Contacts, LoadCase]:
    """Model, contacts and loads that are judged."""
    return bodies.model, bodies.contacts, bodies.load_case(load_case)


def _verify(model: Model, contacts: Contacts, load_case: LoadCase, solution: Solution) -> Checks:
    """The same where every block is a body."""
    of_mechanics = verify_convex if solution.conditions_on_interfaces else verify_points
    checks = of_mechanics(model, contacts, load_case, solution)
    failures = (
        *_fall_failures(solution),
        *_standing_failures(model, contacts, load_case, solution),
        *tilt_failures(model, contacts, load_case, solution),
        *_soil_failures(model, load_case),
    )
    if failures:
        checks = replace(checks, verified=False, failures=(*checks.failures, *failures))
    if solution.status is Status.UNBOUNDED:
        match load_case.question:
            case Angle(tilt) if solution.mechanics is not None:
                failures = never_failures(tilt, load_case.live_load, checks)
            case _:
                failures = (*failures, *_lock_failures(model, contacts, load_case, solution))
        checks = replace(checks, verified=not failures, failures=failures)
    return replace(
        checks,
        least_load_factor=least_check(model, contacts, load_case, solution),
        torsion_load_factor=torsion_check(model, contacts, load_case, solution),
    )


def residual_of(assembly: Assembly, load_case: LoadCase, solution: Solution, part: str) -> float:
    """By how much forces and mechanism of a part of a solution violate the joint law at most, by the rule of that part.

    Of elastic joints their own law. NaN where nothing moves.
    """
    bodies = assembly.of(load_case)
    of_bodies, _ = solution_on_bodies(solution, bodies)
    mechanics = getattr(of_bodies, part)
    if part == "level":
        load_case = replace(load_case, live_load=load_case.question.pushed(load_case.live_load))
    rule = rule_of(part, solution)
    parts = _claimed(bodies, load_case)
    case = LoadedModel(*parts)
    if mechanics.interface_motions is not None:
        case = InterfaceCase(*parts, model_of(part, solution), rule)
    dilatancy = case.limits.dilatancy_by(rule)
    elastic = elastic_residual(case, mechanics, dilatancy)
    return residuals_of(case, mechanics, dilatancy).largest if np.isnan(elastic) else elastic


def locked_with_normality(assembly: Assembly, load_case: LoadCase, solution: Solution) -> bool:
    """Whether forces prove that every multiple of the live load is carried with associative flow."""
    if solution.lock is None:
        return False
    bodies = assembly.of(load_case)
    of_bodies, _ = solution_on_bodies(solution, bodies)
    return not _lock_failures(*_claimed(bodies, load_case), of_bodies)


def level_bound(assembly: Assembly, load_case: LoadCase, across: FloatArray, solution: Solution) -> float:
    """Multiple of the load across that a level table is proved to bear: inf for every one, nan for none."""
    locks = solution.level_lock is not None
    if solution.level is None and not locks:
        return np.nan
    claim = Solution(
        flow_rule="associative",
        status=Status.UNBOUNDED if locks else Status.SOLVED,
        mechanics=solution.level,
        associative=solution.level,
        certificate=None,
        reason="",
        programs=(),
        iterations=(),
        seconds=0.0,
        contact_model=solution.contact_model,
        stress_blocks=solution.stress_blocks,
        lock=solution.level_lock,
    )
    level = replace(load_case, live_load=across, question=LOAD_FACTOR)
    checks = verify(assembly, level, claim)
    return checks.static_bound if not locks else np.inf if checks.verified else np.nan


def _standing_failures(
    model: Model, contacts: Contacts, load_case: LoadCase, solution: Solution
) -> tuple[Message, ...]:
    """Why forces and displacements do not show the claim on the dead load alone: that it is carried needs them."""
    standing = solution.standing
    if standing is None:
        return ()
    stands, loaded = standing.verdict is Standing.YES, bool(np.any(load_case.dead_load[model.free]))
    if not stands and not loaded:
        return (NOTHING_ACTS,)
    if standing.forces is None or standing.settlement is None:
        return (NOT_SHOWN,) if stands and loaded else ()
    limits = point_limits(model, contacts) if solution.conditions_on_interfaces else point_strengths(model, contacts)
    failures = standing_failures(model, contacts, load_case, standing.forces, standing.settlement, limits)
    return failures if stands or failures else (SHOWN,)


def _soil_failures(model: Model, load_case: LoadCase) -> tuple[Message, ...]:
    """On a mesh whose corners were moved for nothing soil cannot slip where it would; what has no factor says so."""
    if not model.soils or load_case.soil or not load_case.question.multiplies:
        return ()
    words = (
        "soil slips along the edges of its cells alone, which were not moved to where it slips most easily: its load "
        "factor is an upper one, and may be far too high"
    )
    return (Message("soil-mesh-fixed", words),)


def _fall_failures(solution: Solution) -> tuple[Message, ...]:
    """Why it is not said to fall by status and standing where a motion is given that shows it, and nowhere else.

    The quality of the motion is judged where there are no forces that carry a load factor.
    """
    shown = solution.certificate is not None and solution.mechanics is None
    said = [solution.status is Status.NO_EQUILIBRIUM]
    said += [] if solution.standing is None else [solution.standing.verdict is Standing.NO]
    if all(claim == shown for claim in said):
        return ()
    return (FALL_SHOWN if shown else FALL_NOT_SHOWN,)


def _lock_failures(model: Model, contacts: Contacts, load_case: LoadCase, solution: Solution) -> tuple[Message, ...]:
    if solution.lock is None:
        return (Message("lock-not-proved", "no forces are given that carry every multiple of the live load"),)
    failures = lock_failures(model, contacts, load_case, solution.lock)
    if solution.conditions_on_interfaces:
        failures += convex_lock_failures(model, contacts, load_case, solution.lock, solution.contact_model)
    return failures
