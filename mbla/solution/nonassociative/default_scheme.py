"""Flow without normality by default: a state of the joint law, and then states of lower load factors.

1. Gravity: forces under the dead load alone (:func:`mbla.solution.standing.standing.gravity_forces`).
2. One interior-point run on the law (``moving_anchor``), of at most ``MOST_RUN`` factorisations.
3. Where it ends short of the law, pairs of convex programs from its normal forces (``alternation``), without tilt and
   with it, and where they come to no state within 1e-4, from the normal forces of associative flow and of gravity.
4. In the plane, and in space where it is asked for, lower load factors: pairs of programs with a tilt, which fit the
   law less, and then more again, and pairs from other normal forces, as long as their iterations are within
   ``analysis.search`` times those spent so far, or within some hundred. Nothing depends on a clock or on chance.

Of the states that fit the law the one of the least load factor is the answer. That is no proof: the least of all is a
problem that nobody solves with certainty (Ferris and Tin-Loi 2001, doi:10.1016/S0020-7403(99)00111-3). Found are, of
walls 1, 3 and 5 of theirs, 0.638982, 0.355817 and 0.207973, the least that are known.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import Message
from mbla.program.program import Program
from mbla.solution.associative.solve_associative import AssociativeResult
from mbla.solution.cone_solvers.cone_solution import ConeSolution, Log
from mbla.solution.linear_algebra.stiffness import stiffness_of
from mbla.solution.nonassociative.alternation import Alternation
from mbla.solution.nonassociative.law_state import (
    NEAR_ZERO,
    LawState,
    SequenceResult,
    as_asked,
    broken_off,
    law_state,
    residual_with_closing,
)
from mbla.solution.nonassociative.moving_anchor import run_with_moving_anchor
from mbla.solution.nonassociative.moving_part import moving_part
from mbla.solution.nonassociative.refine_equilibrium import imbalance, stepped
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import IterationRecord, ProgramRecord, Status
from mbla.solution.standing.standing import gravity_forces
from mbla.solution.thresholds import APPROXIMATE_RESIDUAL, EXACT_RESIDUAL, SOLVED_RESIDUAL

MOST_RUN = 60
"""Factorisations of the interior-point run: most structures that it solves take fewer, and what it creeps along is left
to the programs."""

WITHIN = 1e-7
"""Residual at which the interior-point run ends, unless a rougher one is asked for."""

MOST_PAIRS, PATIENCE, AT_REST, PROGRESS = 12, 4, 2, 0.7
"""Pairs of programs from one start at most; given up where so many in a row have not brought the residual to this share
of what it was, and joints that open under force emphasized after the number before it."""

TILTS = ((0.1, 2), (0.03, 2), (0.01, 3))
"""Tilts in turn, and pairs of programs with each. On walls the last is a state of the law; with 0.3 the states were too
far from it to come back lower."""

MOST_PARTS = 2
"""Times that the part that moves is solved alone before the whole structure is."""

NOTABLE = 1e-4
"""Relative fall of the load factor by a round of the search after which another one is made."""

LEAST_WORK, SMALL_WORK = 300, 2e5
"""Iterations that a search may always make, and iterations times contact points, whichever allows more: a fifth of a
second on 600 points, two on 5,000. On published walls and those of 10 to 25 courses more led no lower, a third less did
not reach the same states."""

FEWEST_PAIRS = 4
"""Pairs of programs for which there must be work left for a descent to begin: cut short it ends off the law."""

SEEDS = 4
"""Starts from normal forces under the dead load that are made uneven, where the others leave work."""

NEEDLESS = 1e-6
"""Load factor, over dead load over live load of the blocks that move, of a mechanism that needs no live load: in space
a block can turn about the one contact point that carries all its force. That fits the law and says nothing of a
collapse, unless the associative load factor, which is no less, is as small."""

UNBALANCED = 1e-3
"""Unbalanced force of a block, over what it carries, with which a state is none: beside blocks of 1e8 times its weight
the programs do not see a block."""

STEPS, STEP_WORK = 3, 30
"""Steps of the exact law where the programs found nothing, and factorisations of each."""

NEAR_BEST = 10.0
"""States within so many times the least residual count as fitting, where none fits the law exactly."""


def solve_by_default(
    program: Program, associative: AssociativeResult, slope: FloatArray, settings: SolverSettings, log: Log
) -> SequenceResult:
    """The state of the least load factor found, by a law of dilatancy ``slope``, (n_points,) tangents of its angles."""
    records = list(associative.programs)
    gravity = gravity_forces(program, settings, log, records, associative.stress_free)
    if isinstance(gravity, ConeSolution):
        return broken_off(gravity, records)
    start = associative.state
    scheme = _Scheme(program, slope, settings, log, records, np.inf if start is None else start.load_factor)
    others = [gravity] if start is None else [start.forces, gravity]
    normals = [forces[:, 0] for forces in (*scheme.interior_run(gravity), *others)]
    for normal in normals:
        if scheme.least_residual <= scheme.wanted or scheme.late:
            break
        near = scheme.approach(normal)
        if scheme.least_residual > SOLVED_RESIDUAL:
            scheme.descend(near)
        if scheme.least_residual <= SOLVED_RESIDUAL:
            break
    if scheme.least_residual > SOLVED_RESIDUAL and not scheme.late:
        live = program.live_load
        scheme.exact_steps(LawState(gravity, live / float(live @ live), 0.0, np.inf))
        if start is not None:
            scheme.keep(law_state(program, slope, start.forces, start.velocities, start.load_factor))
    elif looks_lower(program, settings) and scheme.answer is not None and scheme.answer.residual <= SOLVED_RESIDUAL:
        scheme.search([*normals[1:], *_uneven(gravity)])
    return scheme.result()


def looks_lower(program: Program, settings: SolverSettings) -> bool:
    """Whether states of lower load factors are looked for: in the plane, in space where the deck says how far.

    In space contact points let a joint carry all its force at the one point about which it twists, where friction does
    no work: of a block that is twisted alone the least load factor is nothing. That belongs to the points, not to the
    structure, and is not taken for its load factor unasked.
    """
    return settings.search > 0.0 and (program.components == 2 or settings.analysis.search is not None)


def state_near(
    program: Program, start: LawState, most: float, settings: SolverSettings, log: Log, records: list[ProgramRecord]
) -> LawState | None:
    """The state that steps of the law from another one lead to, or pairs of programs from its normal forces.

    most : load factor up to which it is one
    """
    scheme = _Scheme(program, np.zeros(program.n_points), settings, log, records)
    scheme.exact_steps(start)
    if scheme.least_residual > scheme.wanted:
        scheme.approach(start.forces[:, 0])
    if not any(state.load_factor <= most and state.residual <= SOLVED_RESIDUAL for state in scheme.found):
        scheme.descend(start.forces[:, 0])
    near = (state for state in scheme.found if state.load_factor <= most)
    return min(near, key=lambda state: state.residual, default=None)


def _uneven(gravity: FloatArray) -> Iterator[FloatArray]:
    for seed in range(SEEDS):
        yield gravity[:, 0] * np.exp(np.random.default_rng(seed).standard_normal(len(gravity)))


@dataclass
class _Scheme:
    """States found so far, and what was spent on them: factorisations of the run, iterations of programs.

    most : associative load factor, infinite where there is none
    """

    program: Program
    slope: FloatArray
    settings: SolverSettings
    log: Log
    records: list[ProgramRecord]
    most: float = np.inf
    found: list[LawState] = field(default_factory=list)
    spent: int = 0
    limit: float = np.inf
    alternation: Alternation = field(init=False)

    def __post_init__(self) -> None:
        self.alternation = Alternation(self.program, self.slope, self.settings, self.log, self.records)

    @property
    def wanted(self) -> float:
        """Residual that was asked for; a sharper one than that of an exact state is left to ``sharpened``."""
        return max(self.settings.residual, EXACT_RESIDUAL)

    @property
    def late(self) -> bool:
        """Whether the time limit has passed."""
        deadline = self.settings.deadline
        return self.alternation.late or (deadline is not None and time.monotonic() > deadline)

    @property
    def work(self) -> int:
        """Factorisations of the run and iterations of the programs so far."""
        return self.spent + self.alternation.work

    @property
    def over(self) -> bool:
        """Whether the time limit has passed, or the work of a search is done."""
        return self.late or self.work >= self.limit

    @property
    def has_work_left(self) -> bool:
        """Whether another descent of a search may begin."""
        pair = 2.0 * self.alternation.work / max(self.alternation.programs, 1)
        return not self.late and self.limit - self.work >= FEWEST_PAIRS * pair

    @property
    def least_residual(self) -> float:
        """Of the states found so far."""
        return min((state.residual for state in self.found), default=np.inf)

    @property
    def answer(self) -> LawState | None:
        """The state of the least load factor among those that fit the law, or do so nearly as well as the best.

        The residual is a power, of second order in how far a state is from one of the law, and the load factor is of
        first: of states that differ in it by less than the root of the residual the sharpest is taken.
        """
        if not self.found:
            return None
        least = self.least_residual
        limit = max(self.wanted, min(NEAR_BEST * least, SOLVED_RESIDUAL), least)
        fitting = [state for state in self.found if state.residual <= limit]
        lowest = min(fitting, key=lambda state: state.load_factor)
        same = lowest.load_factor + np.sqrt(lowest.residual) * abs(lowest.load_factor)
        return min((state for state in fitting if state.load_factor <= same), key=lambda state: state.residual)

    def keep(self, state: LawState) -> None:
        """Remember a state, unless its mechanism needs no live load or a light block is not in balance."""
        if not self.program.guided and imbalance(self.program, state) > UNBALANCED:
            return
        needless = NEEDLESS * self.program.moved_over_live(state.velocities)
        if state.load_factor > needless or self.most <= needless or self.program.settles:
            self.found.append(state)

    def interior_run(self, gravity: FloatArray) -> list[FloatArray]:
        """The interior-point run from forces under the dead load; the forces it ends with, if it came to any."""
        started, number = time.perf_counter(), len(self.records) + 1
        live = self.program.scaling.live

        def watch(count: int, state: LawState, gap: float, length: float) -> None:
            seconds, factor = time.perf_counter() - started, state.load_factor * live
            self.log(IterationRecord(number, count, factor, gap, state.residual, state.residual, length, seconds))

        enough = self.wanted if self.wanted > EXACT_RESIDUAL else WITHIN
        run = run_with_moving_anchor(stiffness_of(self.program), self.slope, gravity, MOST_RUN, enough, watch)
        self.spent += run.factorizations
        state, seconds = run.best, time.perf_counter() - started
        value = np.nan if state is None else state.load_factor * live
        exact = state is not None and state.residual <= self.wanted
        status = Status.SOLVED if exact else Status.APPROXIMATE
        self.records.append(ProgramRecord(number, "interior run", status, value, np.nan, run.factorizations, seconds))
        if state is None:
            return []
        self.keep(state)
        return [state.forces]

    def exact_steps(self, state: LawState) -> None:
        """Steps of the exact law to rounding from the forces and the motion of a state."""
        stiffness = stiffness_of(self.program)
        for _ in range(STEPS):
            state, work = stepped(stiffness, self.slope, state, STEP_WORK)
            self.spent += work
            self.keep(state)

    def approach(self, normal: FloatArray) -> FloatArray:
        """Pairs of programs from normal forces, (n_points,), until a state fits the law; the last normal forces.

        Where little moves they are those of the moving part, and one pair of the whole says whether the rest carries
        it, and rests.
        """
        self.alternation.emphasis[:] = 0.0
        for _ in range(MOST_PARTS):
            velocities = self.alternation.motion_for(normal)
            part = None if velocities is None else moving_part(self.program, velocities)
            if part is None:
                break
            inner = Alternation(part.program, self.slope[part.points], self.settings, self.log, self.records)
            states = self._pairs(inner, inner.states(normal[part.points]))
            self.spent += inner.work
            if not states:
                break
            velocities = part.lifted(min(states, key=lambda state: state.residual).velocities)
            found = self.alternation.forces_for(velocities, 0.0)
            if found is None:
                return normal
            self.keep(state := self.alternation.state(found[0], velocities, found[1]))
            normal = state.forces[:, 0]
            if state.residual <= self.wanted or self.over:
                return normal
        else:
            velocities = self.alternation.motion_for(normal)
        for state in self._pairs(self.alternation, self.alternation.states_from(velocities)):
            self.keep(state)
            normal = state.forces[:, 0]
        return normal

    def _pairs(self, alternation: Alternation, states: Iterator[LawState]) -> list[LawState]:
        """States of pairs of programs until one fits the law, or they stall."""
        found: list[LawState] = []
        for state in states:
            found.append(state)
            residuals = [each.residual for each in found]
            least, before, recent = min(residuals), *(min(residuals[:-n], default=np.inf) for n in (PATIENCE, AT_REST))
            if state.residual <= self.wanted or least > PROGRESS * before or len(found) >= MOST_PAIRS or self.over:
                break
            if least > PROGRESS * recent and self.program.components == 2:  # in space it led nowhere better
                alternation.emphasize(state)
        return found

    def descend(self, normal: FloatArray, tilts: Sequence[tuple[float, int]] = TILTS) -> None:
        """Pairs with tilts in turn from normal forces, (n_points,), until a state fits the law."""
        self.alternation.emphasis[:] = 0.0
        for tilt, pairs in tilts:
            factor = np.inf
            for state in self.alternation.states(normal, [tilt] * pairs):
                self.keep(state)
                normal, before, factor = state.forces[:, 0], factor, state.load_factor
                if self.over or (state.residual <= self.wanted and factor > (1.0 - NOTABLE) * before):
                    return
        self.approach(normal)

    def search(self, normals: list[FloatArray]) -> None:
        """Descents from the lowest state as long as they lead lower, then from normal forces, within the work."""
        always = max(LEAST_WORK, SMALL_WORK / self.program.n_points)
        self.limit = self.work + max(self.settings.search * self.work, always)
        if self.answer is not None:  # the lower end of its mechanism first: work may not be left for more
            self.descend(self.answer.forces[:, 0], TILTS[-1:])
        here, falls = self.answer, True
        while here is not None and falls and self.has_work_left:
            before = here.load_factor
            self.descend(here.forces[:, 0])
            here = self.answer
            size = max(abs(before), NEAR_ZERO * self.program.dead_over_live)  # next to zero it may have either sign
            falls = here is not None and here.load_factor < before - NOTABLE * size
        for normal in normals:
            if self.has_work_left:
                self.descend(normal)

    def result(self) -> SequenceResult:
        """The answer, judged by its residual."""
        state, records = self.answer, tuple(self.records)
        first = next((near.load_factor for near in self.found if near.residual <= APPROXIMATE_RESIDUAL), None)
        if state is None:
            status = Status.TIME_LIMIT if self.late else Status.NOT_VERIFIED
            return SequenceResult(status, None, "the time limit was reached" if self.late else NO_STATE, records)
        if state.residual <= EXACT_RESIDUAL:
            return SequenceResult(Status.SOLVED, state, "", records, first=first)
        if state.residual <= self.settings.residual:
            seen = residual_with_closing(self.program, self.slope, state)
            if seen <= self.settings.residual:
                return as_asked(state, seen, self.settings.residual, records, first)
        words = MISSED.format(state.residual)
        if self.late:
            return SequenceResult(
                Status.TIME_LIMIT, state, "the time limit was reached; " + words, records, first=first
            )
        if state.residual <= SOLVED_RESIDUAL:
            return SequenceResult(Status.SOLVED, state, "", records, remarks=(words,), first=first)
        status = Status.APPROXIMATE if state.residual <= APPROXIMATE_RESIDUAL else Status.NOT_VERIFIED
        return SequenceResult(status, state, words, records, first=first)


MISSED = Message("law-missed", "the iterations came no closer to the joint law than a residual of {:.2g}")
NO_STATE = "no forces and no mechanism that fit the joint law were found"
