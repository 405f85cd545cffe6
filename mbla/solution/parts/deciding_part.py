"""From what was found of the parts of a structure to its solution: the part that collapses first decides."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import Message
from mbla.program.program import Program
from mbla.solution.flow.path_record import Stop
from mbla.solution.full_model.mechanics import certificate_of, mechanics_of
from mbla.solution.law.interfaces import NONE, Interfaces
from mbla.solution.nonassociative.collapse_state import CollapseState
from mbla.solution.nonassociative.least_found import looks_lower
from mbla.solution.nonassociative.locking import locking_forces, locking_forces_of_part
from mbla.solution.parts.assemble_parts import assemble_parts
from mbla.solution.parts.part_context import PartContext
from mbla.solution.parts.part_result import PartResult
from mbla.solution.solution import Mechanics, PathByStiffness, ProgramRecord, Solution, Status

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


@dataclass(frozen=True)
class SolvedParts:
    """All parts of a structure with what was found for each."""

    results: tuple[PartResult, ...]
    context: PartContext

    @property
    def parts(self) -> tuple[Program, ...]:
        """Their programs."""
        return tuple(result.program for result in self.results)

    def mechanics(
        self,
        part: int,
        state: CollapseState | None,
        flow_rule: str,
        collapse: Sequence[CollapseState | None] = (),
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
        assembled = assemble_parts(
            self.parts, part, state, self.context.settings, self.context.log, collapse, interfaces, below
        )
        return None if assembled is None else mechanics_of(*assembled, flow_rule)


def combined(solved: SolvedParts) -> Solution:
    """The part that decides: one that cannot stand, one that could not be solved, or the first to collapse."""
    results = solved.results
    for status in FAILED:
        for part, result in enumerate(results):
            if result.associative.status is status:
                return _without_load_factor(solved, part)
    bounded = [part for part, result in enumerate(results) if _load_factor(result) < np.inf]
    if not bounded:
        loaded = [part for part, result in enumerate(results) if result.loaded]
        return _without_load_factor(solved, loaded[0])
    first = min(bounded, key=lambda part: _load_factor(results[part]))
    first_associative = min(range(len(results)), key=lambda part: _factor(results[part].associative.state))
    return _with_load_factor(solved, first, first_associative)


def _load_factor(result: PartResult) -> float:
    """By the flow rule of the analysis, or the associative one where that gave none."""
    return _factor(result.state if result.state is not None else result.associative.state)


def _factor(state: CollapseState | None) -> float:
    return np.inf if state is None else state.load_factor


def _known_lock(solved: SolvedParts) -> FloatArray | None:
    """Forces of all parts that balance the live load alone, (n_points, 3), with those that rays of programs prove.

    None where no ray does, or a loaded part has none.
    """
    each = zip(solved.parts, solved.results, strict=True)
    loaded = [(part, result.associative.lock) for part, result in each if result.loaded]
    if all(lock is None for _, lock in loaded):
        return None
    forces = list[FloatArray]()
    for program, known in loaded:
        lock = known
        if lock is None and program.conditions is None:
            lock = locking_forces_of_part(program, solved.context.settings, solved.context.log)
        if lock is None:
            return None
        forces.append(program.lift.contact_forces(lock))
    scaling = solved.parts[0].full.scaling
    return scaling.forces(np.sum(forces, axis=0)) / scaling.live


def _without_load_factor(solved: SolvedParts, part: int) -> Solution:
    result, lock = solved.results[part], None
    associative = result.associative
    status, reason = associative.status, associative.reason
    if status is Status.UNBOUNDED and result.flow is not None:  # nothing is known by the flow rule of the analysis
        status, reason = result.flow.status, result.flow.reason
    if status is Status.UNBOUNDED:
        lock = _known_lock(solved)
        lock = locking_forces(solved.parts, solved.context.settings, solved.context.log) if lock is None else lock
        if lock is None:
            status, reason = Status.NOT_VERIFIED, LOCK_NOT_PROVED
    motion, motions = None, None
    if associative.certificate is not None:
        motion, motions = certificate_of(solved.parts[part], associative.certificate)
    rule = solved.context.settings.analysis.flow_rule
    return Solution(rule, status, certificate=motion, reason=reason, certificate_motions=motions, lock=lock)


def _with_load_factor(solved: SolvedParts, first: int, first_associative: int) -> Solution:
    results, context = solved.results, solved.context
    result, analysis = results[first], context.settings.analysis
    at_collapse = [each.associative.state for each in results]
    remarks = [remark for each in results for remark in each.remarks]
    locked = all(state is None for state in at_collapse)  # with normality alone
    status, reason = _claim(results, first)
    solution = Solution(
        analysis.flow_rule,
        status,
        reason=reason,
        tolerance_requested=_tolerance_requested(results),
        associative=solved.mechanics(
            first_associative,
            at_collapse[first_associative],
            "associative",
            at_collapse,
            context.interfaces,
            [each.associative.below for each in results],
        ),
        lock=locking_forces(solved.parts, context.settings, context.log) if locked else None,
    )
    if result.flow is None:
        return replace(solution, mechanics=solution.associative, remarks=tuple(remarks))
    flow, rule = result.flow, analysis.flow_rule
    program = solved.parts[first]
    searched = looks_lower(program, context.settings, context.interfaces) or program.facts.settling_support
    words = [] if searched or not context.settings.by_elastic_path else [OTHER_HISTORIES]
    words = [OF_INTERFACES] if words and context.interfaces is not NONE else words
    return replace(
        _with_torsion_of_parts(solution, solved),
        mechanics=solved.mechanics(first, flow.state, rule, [each.state for each in results], context.interfaces),
        least=solved.mechanics(first, result.least, rule),
        scheme=analysis.scheme if rule == "non_associative" else "",
        remarks=(*flow.remarks, *words, *remarks),
        path=flow.path,
        path_end=flow.path_end,
        path_gain=flow.path_gain,
        path_last=flow.path_last,
        path_by_stiffness=least_by_stiffness(results, flow.by_stiffness),
    )


def least_by_stiffness(results: Sequence[PartResult], rows: Sequence[PathByStiffness]) -> tuple[PathByStiffness, ...]:
    """With joints of other stiffnesses the least load factor of all parts, by what is known of the one that decides."""
    known = [row for each in results if each.flow is not None for row in each.flow.by_stiffness]
    least = {row.ratio: np.min([own.load_factor for own in known if own.ratio == row.ratio]) for row in rows}
    return tuple(PathByStiffness(ratio, float(factor)) for ratio, factor in least.items())


def _with_torsion_of_parts(solution: Solution, solved: SolvedParts) -> Solution:
    """With the state of the part that starts to move first with torsion of uniform pressure.

    Without one where no part twists, or the first to move does not; with nothing but the end of its path where a part
    came to no state: it may be the first.
    """
    results = solved.results
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
    found = solved.mechanics(first, torsion.state, "non_associative", states, solved.context.beside)
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


def renumbered(records: Sequence[ProgramRecord]) -> tuple[ProgramRecord, ...]:
    """Programs of all parts, numbered in the order in which they were solved."""
    return tuple(replace(record, program=number) for number, record in enumerate(records, start=1))
