"""How a load case is solved, in five lines.

1. Is the dead load carried?   One program, proved either way.
2. Associative flow            One method; unproved the other; unproved approximate, and said.
3. Another flow rule           The path of elastic joints, whose greatest load is the figure, with an exact state beside
                               it; or the scheme that the deck names.
4. What is asked besides       The least load factor by search, torsion, standing: none of it changes the figure.
5. Verification                Of what is told, by statics and laws of its own (:mod:`mbla.solution.verification`).

Parts, whose blocks cannot interact, take the first four one after the other; the first to collapse decides.
"""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np

from mbla.program.build import CaseProgram
from mbla.program.program import Program
from mbla.program.reductions import Reduced
from mbla.program.resultants.twisting_interfaces import TwistingInterfaces
from mbla.solution.associative.solve_associative import AssociativeResult
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.full_model.lifted import solution_on_blocks
from mbla.solution.full_model.of_interfaces import of_interfaces
from mbla.solution.law.interfaces import NONE, Interfaces
from mbla.solution.parts.deciding_part import SolvedParts, combined, renumbered
from mbla.solution.parts.part import associative_part, with_flow_rule, with_least, with_standing, with_torsion
from mbla.solution.parts.part_context import PartContext
from mbla.solution.parts.part_result import PartResult
from mbla.solution.proof.claim import with_proof
from mbla.solution.reach import stays_within, within_reach
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import IterationRecord, Mechanics, Solution, Status
from mbla.solution.standing.claim import as_it_stands
from mbla.solution.standing.standing import StressFreeStates, worst_standing

BROKE_DOWN = "a system of equations of the method broke down ({}): try another scheme or solver"


def solve(
    program: CaseProgram, settings: SolverSettings, log: Log | None = None, states: StressFreeStates | None = None
) -> Solution:
    """Load factor of one load case by the flow rule of the analysis, and what is requested in addition, on all blocks.

    log    : called once per iteration of a cone program, as it goes
    states : of stress-free assemblies that are known from other load cases, to which those of this one are added
    """
    interfaces = NONE
    if program.crushing is not None or program.twisting is not None:
        interfaces = Interfaces(program.crushing, program.twisting)
    solution = solve_parts(program.reduced, settings, log, interfaces, _with_torsion(program, settings), states)
    if interfaces is not NONE:
        crush = program.crushing is not None
        solution = replace(solution, contact_model=settings.analysis.contact_model, stress_blocks=crush)
    bodies = program.bodies
    solution = with_proof(bodies.model, bodies.contacts, program.load_case, solution)
    return solution_on_blocks(_of_interfaces(program, settings, solution), bodies)


def _of_interfaces(program: CaseProgram, settings: SolverSettings, solution: Solution) -> Solution:
    """With what the interfaces do, where there are conditions on them."""
    analysis, model, contacts = settings.analysis, program.bodies.model, program.bodies.contacts
    if solution.torsion is not None:
        beside = of_interfaces(model, contacts, "convex", solution.torsion, "non_associative")
        solution = replace(solution, torsion=beside)
    if program.crushing is None and program.twisting is None:
        return solution

    def of(mechanics: Mechanics | None, flow_rule: str) -> Mechanics | None:
        if mechanics is None:
            return None
        return of_interfaces(model, contacts, analysis.contact_model, mechanics, flow_rule)

    associative = of(solution.associative, "associative")
    by_path = solution.mechanics is not solution.associative
    return replace(
        solution,
        associative=associative,
        mechanics=of(solution.mechanics, solution.flow_rule) if by_path else associative,
    )


def _with_torsion(program: CaseProgram, settings: SolverSettings) -> Interfaces:
    """Interfaces whose torsion a second path limits, so that its load factor stands beside the answer."""
    turned = program.load_case.question.by_steps  # solved for many angles
    spatial = any(part.components == 3 for part in program.reduced.parts)
    model, contacts = program.bodies.model, program.bodies.contacts
    if turned or not spatial or not settings.by_torsion:
        return NONE
    return Interfaces(program.crushing, TwistingInterfaces.of(model, contacts))


def solve_parts(
    reduced: Reduced,
    settings: SolverSettings,
    log: Log | None = None,
    interfaces: Interfaces = NONE,
    beside: Interfaces = NONE,
    states: StressFreeStates | None = None,
) -> Solution:
    """The same of the contact points of rigid bodies: their parts one after the other, then the whole structure.

    log        : called once per iteration of a cone program, as it goes
    interfaces : of the model that have a law of their own in the path of elastic joints
    beside     : those in a second path, with torsion
    states     : as for ``solve``
    """
    started, (iterations, record) = time.perf_counter(), recorded(log)
    context = PartContext(settings, record, interfaces, beside, states)
    results = tuple(_result_of(program, context) for program in reduced.parts)
    solution = combined(SolvedParts(results, context))
    assessed = [result.standing for result in results if result.standing is not None]
    standing = worst_standing(assessed) if assessed else None
    if standing is not None:
        solution = as_it_stands(solution, standing.verdict)
    return replace(
        solution,
        standing=standing,
        programs=renumbered([record for result in results for record in result.programs]),
        iterations=tuple(iterations),
        seconds=time.perf_counter() - started,
        size=reduced.size,
        reductions=reduced.steps,
        solver=settings.solver,
    )


def recorded(log: Log | None) -> tuple[list[IterationRecord], Log]:
    """A list of the iterations to come, and the log that fills it as well as the one given."""
    iterations: list[IterationRecord] = []

    def record(iteration: IterationRecord) -> None:
        iterations.append(iteration)
        if log is not None:
            log(iteration)

    return iterations, record


def solve_part(program: Program, context: PartContext) -> PartResult:
    """One part by the flow rule of the analysis, with everything that is asked besides its load factor.

    Raises
    ------
    numpy.linalg.LinAlgError where a system of equations on the way to the load factor is singular
    """
    result = associative_part(program, context)
    result = with_flow_rule(result, context)
    result = with_least(result, context)
    result = with_torsion(result, context)
    return with_standing(result, context)


def _result_of(program: Program, context: PartContext) -> PartResult:
    """What was found for one part; a system of equations that nobody expected to be singular is a reported failure."""
    try:
        easier = within_reach(program)
        if easier is not None:
            result = solve_part(easier, context)
            states = [state for state in (result.associative.state, result.state) if state is not None]
            if states and all(stays_within(program, state.forces) for state in states):
                return replace(result, program=program)
        return solve_part(program, context)
    except np.linalg.LinAlgError as error:
        reason = BROKE_DOWN.format(str(error).lower())
        failure = AssociativeResult(Status.NUMERICAL_ERROR, None, None, reason, ())
        return PartResult(program, failure, None, loaded=bool(np.any(program.live_load)))
