"""One load case through the solver stage: by contact points, part after part, or by resultants of interfaces."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.errors import Message
from mbla.program.build import CaseProgram, crushable_interfaces
from mbla.program.program import Program
from mbla.program.reductions import Reduced
from mbla.program.resultants.twisting_interfaces import TwistingInterfaces
from mbla.solution.associative.force_ranges import force_ranges
from mbla.solution.associative.solve_associative import AssociativeResult
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.flow.path_record import Stop
from mbla.solution.law.interfaces import NONE, Interfaces
from mbla.solution.lifted import solution_on_blocks
from mbla.solution.mechanics import certificate_of, mechanics_of
from mbla.solution.nonassociative.law_state import LawState
from mbla.solution.nonassociative.least_found import looks_lower
from mbla.solution.nonassociative.locking import locking_forces
from mbla.solution.of_interfaces import of_interfaces
from mbla.solution.part import solve_part
from mbla.solution.part_result import PartResult
from mbla.solution.parts import assemble_parts, at_rest
from mbla.solution.reach import stays_within, within_reach
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import IterationRecord, Mechanics, PathByStiffness, ProgramRecord, Solution, Status
from mbla.solution.standing.claim import as_it_stands
from mbla.solution.standing.standing import StressFreeStates, worst_standing

FAILED = (
    Status.NO_EQUILIBRIUM,
    Status.TIME_LIMIT,
    Status.NUMERICAL_ERROR,
    Status.ITERATION_LIMIT,
    Status.NOT_VERIFIED,
)
"""statuses of one part that decide for all, the most severe first"""

DECIDED = (Status.SOLVED, Status.UNBOUNDED)

LOCK_NOT_PROVED = (
    "the solver finds no mechanism in which the live load does work, but no forces that carry every multiple of it "
    "were found to prove that"
)


OTHER_HISTORIES = Message(
    "lower-not-searched",
    "states of lower load factors, to which only other histories lead, were not looked for, as in space unless "
    "analysis.search says how far",
)

OF_INTERFACES = Message(
    "lower-not-searched",
    "states of lower load factors, to which only other histories lead, were not looked for: interfaces have a law of "
    "their own beside that of their points",
)

BROKE_DOWN = "a system of equations of the method broke down ({}): try another scheme or solver"


@dataclass(frozen=True)
class _Stage:
    """What every step of one load case needs."""

    parts: tuple[Program, ...]
    interface_of_point: IntArray
    settings: SolverSettings
    log: Log
    interfaces: Interfaces = NONE
    beside: Interfaces = NONE
    more: list[ProgramRecord] = field(default_factory=list)

    def mechanics(
        self,
        part: int,
        state: LawState | None,
        flow_rule: str,
        collapse: Sequence[LawState | None] = (),
        interfaces: Interfaces = NONE,
        below: Sequence[tuple[FloatArray, float] | None] = (),
    ) -> Mechanics | None:
        """A state of one part as mechanics of the full model; None where the other parts do not carry it.

        collapse   : of each part its own state at collapse
        below      : of each part forces at a load factor of zero or below
        interfaces : that have a law of their own in these states
        """
        if state is None:
            return None
        assembled = assemble_parts(self.parts, part, state, self.settings, self.log, collapse, interfaces, below)
        return None if assembled is None else mechanics_of(*assembled, flow_rule)


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
    return solution_on_blocks(_of_interfaces(program, settings, solution), program.bodies)


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
        contact_model=analysis.contact_model,
        stress_blocks=program.crushing is not None,
    )


def _with_torsion(program: CaseProgram, settings: SolverSettings) -> Interfaces:
    """Interfaces whose torsion a second path limits, so that its load factor stands beside the answer."""
    turned = program.load_case.tilt is not None and not program.load_case.tilt.tangent  # solved for many angles
    spatial = any(part.components == 3 for part in program.reduced.parts)
    model, contacts = program.bodies.model, program.bodies.contacts
    # points that crush by themselves have no such law
    at_points = program.crushing is None and crushable_interfaces(model, contacts).any()
    if turned or not spatial or at_points or not settings.by_torsion:
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
    stage = _Stage(reduced.parts, reduced.interface_of_point, settings, record, interfaces, beside)
    results = [_result_of(program, settings, record, interfaces, beside, states) for program in reduced.parts]
    solution = _combined(stage, results)
    assessed = [result.standing for result in results if result.standing is not None]
    standing = worst_standing(assessed) if assessed else None
    if standing is not None:
        solution = as_it_stands(solution, standing.verdict)
    return replace(
        solution,
        standing=standing,
        programs=_renumbered([*(record for result in results for record in result.programs), *stage.more]),
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


def _result_of(
    program: Program,
    settings: SolverSettings,
    log: Log,
    interfaces: Interfaces,
    beside: Interfaces,
    states: StressFreeStates | None,
) -> PartResult:
    """What was found for one part; a system of equations that nobody expected to be singular is a reported failure."""
    try:
        easier = within_reach(program)
        if easier is not None:
            result = solve_part(easier, settings, log, interfaces, beside, states)
            reached = [state for state in (result.associative.state, result.state) if state is not None]
            if reached and all(stays_within(program, state.forces) for state in reached):
                return replace(result, program=program)
        return solve_part(program, settings, log, interfaces, beside, states)
    except np.linalg.LinAlgError as error:
        reason = BROKE_DOWN.format(str(error).lower())
        failure = AssociativeResult(Status.NUMERICAL_ERROR, None, None, reason, ())
        return PartResult(program, failure, None, loaded=bool(np.any(program.live_load)))


def _combined(stage: _Stage, results: Sequence[PartResult]) -> Solution:
    """The part that decides: one that cannot stand, one that could not be solved, or the first to collapse."""
    for status in FAILED:
        for part, result in enumerate(results):
            if result.associative.status is status:
                return _without_load_factor(stage, results, part)
    bounded = [part for part, result in enumerate(results) if _load_factor(result) < np.inf]
    if not bounded:
        loaded = [part for part, result in enumerate(results) if result.loaded]
        return _without_load_factor(stage, results, loaded[0])
    first = min(bounded, key=lambda part: _load_factor(results[part]))
    first_associative = min(range(len(results)), key=lambda part: _factor(results[part].associative.state))
    return _with_load_factor(stage, results, first, first_associative)


def _load_factor(result: PartResult) -> float:
    """By the flow rule of the analysis, or the associative one where that gave none."""
    return _factor(result.state if result.state is not None else result.associative.state)


def _factor(state: LawState | None) -> float:
    return np.inf if state is None else state.load_factor


def _known_lock(stage: _Stage, results: Sequence[PartResult]) -> FloatArray | None:
    """Forces of all parts that balance the live load alone, (n_points, 3), where every loaded part has such."""
    loaded = [(stage.parts[part], result.associative.lock) for part, result in enumerate(results) if result.loaded]
    forces = [program.lift.contact_forces(lock) for program, lock in loaded if lock is not None]
    if not forces or len(forces) < len(loaded):
        return None
    scaling = stage.parts[0].full.scaling
    return scaling.forces(np.sum(forces, axis=0)) / scaling.live


def _without_load_factor(stage: _Stage, results: Sequence[PartResult], part: int) -> Solution:
    result, lock = results[part], None
    associative = result.associative
    status, reason = associative.status, associative.reason
    if status is Status.UNBOUNDED and result.sequence is not None:  # nothing is known by the flow rule of the analysis
        status, reason = result.sequence.status, result.sequence.reason
    if status is Status.UNBOUNDED:
        lock = _known_lock(stage, results)
        lock = locking_forces(stage.parts, stage.settings, stage.log) if lock is None else lock
        if lock is None:
            status, reason = Status.NOT_VERIFIED, LOCK_NOT_PROVED
    motion, motions = None, None
    if associative.certificate is not None:
        motion, motions = certificate_of(stage.parts[part], associative.certificate)
    solution = _solution(stage.settings, status, reason)
    return replace(solution, certificate=motion, certificate_motions=motions, lock=lock)


def _with_load_factor(stage: _Stage, results: Sequence[PartResult], first: int, first_associative: int) -> Solution:
    result, analysis = results[first], stage.settings.analysis
    solved = [each.associative.state for each in results]
    remarks = [remark for each in results for remark in each.remarks]
    locked = all(state is None for state in solved)  # with normality alone
    solution = replace(
        _solution(stage.settings, *_claim(results, first)),
        tolerance_requested=_tolerance_requested(results),
        associative=stage.mechanics(
            first_associative,
            solved[first_associative],
            "associative",
            solved,
            stage.interfaces,
            [each.associative.below for each in results],
        ),
        lock=locking_forces(stage.parts, stage.settings, stage.log) if locked else None,
    )
    if analysis.force_ranges and result.state is not None:
        ranges, words = _force_ranges(stage, first, result.state)
        solution, remarks = replace(solution, force_ranges=ranges), [*remarks, *words]
    if result.sequence is None:
        return replace(solution, mechanics=solution.associative, remarks=tuple(remarks))
    sequence, rule = result.sequence, analysis.flow_rule
    searched = looks_lower(stage.parts[first], stage.settings, stage.interfaces) or stage.parts[first].facts.settles
    words = [] if searched or not stage.settings.by_elastic_path else [OTHER_HISTORIES]
    words = [OF_INTERFACES] if words and stage.interfaces is not NONE else words
    return replace(
        _with_torsion_of_parts(solution, stage, results),
        mechanics=stage.mechanics(first, sequence.state, rule, [each.state for each in results], stage.interfaces),
        least=stage.mechanics(first, result.least, rule),
        scheme=analysis.scheme if rule == "non_associative" else "",
        remarks=(*sequence.remarks, *words, *remarks),
        path=sequence.path,
        path_end=sequence.path_end,
        path_gain=sequence.path_gain,
        path_last=sequence.path_last,
        path_by_stiffness=least_by_stiffness(results, sequence.by_stiffness),
    )


def least_by_stiffness(results: Sequence[PartResult], rows: Sequence[PathByStiffness]) -> tuple[PathByStiffness, ...]:
    """With joints of other stiffnesses the least load factor of all parts, by what is known of the one that decides."""
    known = [row for each in results if each.sequence is not None for row in each.sequence.by_stiffness]
    least = {row.ratio: np.min([own.load_factor for own in known if own.ratio == row.ratio]) for row in rows}
    return tuple(PathByStiffness(ratio, float(factor)) for ratio, factor in least.items())


def _with_torsion_of_parts(solution: Solution, stage: _Stage, results: Sequence[PartResult]) -> Solution:
    """With the state of the part that starts to move first with torsion of uniform pressure.

    Without one where no part twists, or the first to move does not; with nothing but the end of its path where a part
    came to no state: it may be the first.
    """
    twisting = [part for part, result in enumerate(results) if result.torsion is not None]
    for part in twisting:
        torsion = results[part].torsion
        if torsion is not None and torsion.state is None and torsion.stop is not Stop.UNBOUNDED:
            return replace(solution, torsion_end=torsion.stop.value)
    known = {part: _factor(torsion.state) for part in twisting if (torsion := results[part].torsion) is not None}
    first = min(known, key=known.__getitem__, default=None)
    others = [_load_factor(result) for part, result in enumerate(results) if part not in known]
    if first is None or known[first] >= min(others, default=np.inf):
        return solution
    torsion = results[first].torsion
    assert torsion is not None
    states = [result.state if result.torsion is None else result.torsion.state for result in results]
    found = stage.mechanics(first, torsion.state, "non_associative", states, stage.beside)
    return replace(solution, torsion=found, torsion_end=torsion.stop.value)


def _claim(results: Sequence[PartResult], first: int) -> tuple[Status, str]:
    """Status and reason of the part that collapses first; a part that is not solved might collapse before it."""
    open_parts = [result for result in results if result.loaded and result.status not in DECIDED]
    result = results[first] if results[first].status not in DECIDED or not open_parts else open_parts[0]
    return result.status, result.reason


def _tolerance_requested(results: Sequence[PartResult]) -> float | None:
    """Gap or residual asked for where every part that is not solved is approximate because of it; else None."""
    open_parts = [result for result in results if result.loaded and result.status not in DECIDED]
    requested = [result.tolerance_requested for result in open_parts if result.status is Status.APPROXIMATE]
    known = [value for value in requested if value is not None]
    return max(known) if known and len(known) == len(open_parts) else None


def _force_ranges(stage: _Stage, first: int, state: LawState) -> tuple[FloatArray, list[Message]]:
    """Least and greatest normal force of every interface at the load factor, (n_interfaces, 2), and remarks."""
    interfaces, first_point = np.unique(stage.interface_of_point, return_index=True)
    ranges, words = np.full((len(interfaces), 2), np.nan), list[Message]()
    scaling = stage.parts[0].scaling
    units = scaling.force * np.broadcast_to(scaling.units, len(stage.interface_of_point))[first_point]
    for part, program in enumerate(stage.parts):
        own = state if part == first else at_rest(program, state.load_factor, stage.settings, stage.log)
        if own is None:
            continue
        found = force_ranges(program, own, stage.interface_of_point, stage.settings, stage.log)
        ranges = np.where(np.isnan(found.ranges), ranges, found.ranges * units[:, None])
        stage.more.extend(found.programs)
        words += [found.remark] if found.remark else []
    return ranges, words


def _solution(settings: SolverSettings, status: Status, reason: str) -> Solution:
    """A solution without forces and mechanism."""
    analysis = settings.analysis
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
    )


def _renumbered(records: Sequence[ProgramRecord]) -> tuple[ProgramRecord, ...]:
    """Programs of all parts, numbered in the order in which they were solved."""
    return tuple(replace(record, program=number) for number, record in enumerate(records, start=1))
