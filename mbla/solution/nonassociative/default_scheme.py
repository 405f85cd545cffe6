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
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import Message
from mbla.program.program import Program
from mbla.solution.associative.solve_associative import AssociativeResult
from mbla.solution.cone_solvers.cone_solution import ConeSolution, Log
from mbla.solution.linear_algebra.stiffness import stiffness_of
from mbla.solution.nonassociative.law_state import (
    LawState,
    SequenceResult,
    as_asked,
    broken_off,
    law_state,
    residual_with_closing,
)
from mbla.solution.nonassociative.moving_anchor import run_with_moving_anchor
from mbla.solution.nonassociative.refine_equilibrium import stepped
from mbla.solution.nonassociative.search import Search
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import IterationRecord, ProgramRecord, Status
from mbla.solution.standing.standing import gravity_forces
from mbla.solution.thresholds import APPROXIMATE_RESIDUAL, EXACT_RESIDUAL, SOLVED_RESIDUAL

MOST_RUN = 60
"""Factorisations of the interior-point run: most structures that it solves take fewer, and what it creeps along is left
to the programs."""

WITHIN = 1e-7
"""Residual at which the interior-point run ends, unless a rougher one is asked for."""

SEEDS = 4
"""Starts from normal forces under the dead load that are made uneven, where the others leave work."""

NOTHING = 1e-9
"""Associative load factor, non-dimensional, of a motion that may need no live load and change no force."""

STEPS, STEP_WORK = 3, 30
"""Steps of the exact law where the programs found nothing, and factorisations of each."""


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
    if start is not None and abs(start.load_factor) <= NOTHING:
        scheme.keep(law_state(program, slope, gravity, start.velocities, 0.0))
    others = [gravity] if start is None else [start.forces, gravity]
    normals = [forces[:, 0] for forces in (*scheme.interior_run(gravity), *others) if np.isfinite(forces).all()]
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
        scheme.known = scheme.answer
        scheme.lower([*normals[1:], *_uneven(gravity)])
    return replace(scheme.result(), before=scheme.known)


def looks_lower(program: Program, settings: SolverSettings) -> bool:
    """Whether states of lower load factors are looked for: in the plane, in space where the deck says how far.

    In space contact points let a joint carry all its force at the one point about which it twists, where friction does
    no work: of a block that is twisted alone the least load factor is nothing. That belongs to the points, not to the
    structure, and is not taken for its load factor unasked.
    """
    return settings.search > 0.0 and (program.components == 2 or settings.analysis.search is not None)


def state_near(
    program: Program,
    start: LawState,
    most: float,
    settings: SolverSettings,
    log: Log,
    records: list[ProgramRecord],
    *,
    neutral: bool = False,
) -> LawState | None:
    """The state that steps of the law from another one lead to, or pairs of programs from its normal forces.

    most    : load factor up to which it is one
    neutral : whether it may be one that needs no live load: the structure falls without
    """
    scheme = _Scheme(program, np.zeros(program.n_points), settings, log, records, 0.0 if neutral else np.inf)
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
class _Scheme(Search):
    """A search with what leads to its first states, and with its answer in words."""

    known: LawState | None = None
    """The answer before lower ones were looked for; None where none were."""

    def _no_higher_than_known(self, answer: LawState | None) -> LawState | None:
        """The answer, or the one before the search where that is lower: what a search finds may fit the law better."""
        known = self.known
        if known is None or answer is None:
            return answer
        sure = float(np.sqrt(known.residual)) * abs(known.load_factor)
        return known if known.load_factor < answer.load_factor - sure else answer

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

    def result(self) -> SequenceResult:
        """The answer, judged by its residual."""
        state, records = self._no_higher_than_known(self.answer), tuple(self.records)
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
NOT_SEARCHED = Message(
    "lower-not-searched",
    "states of lower load factors were not looked for, as in space unless analysis.search says how far: the least "
    "found is an upper limit of the least",
)
