"""A search for lower load factors without dilatancy: forces and mechanism are changed in turn.

The load factor is not unique: every pair of forces and mechanism that fits the joint law belongs to one, and the least
of these is a problem with complementarity constraints that nobody solves with certainty (Ferris and Tin-Loi 2001,
doi:10.1016/S0020-7403(99)00111-3). This search goes down from a solution:

1. Forces of the lower end of the range for the mechanism, or, so that more mechanisms fit, extreme forces that carry
   nearly the same load factor with it: random positive weights on the normal forces, one cone program.
2. A sparse mechanism that fits these forces (``sparse_mechanism``), by random weights; half of the
   time points are slowed down in proportion to what the load factor would gain if they came to rest, which the dual
   variables of the last lower end tell.
3. The lower end of the range for that mechanism, exact again. It is kept if it is not above the last one.

As long as steps succeed forces count as at their limits within a growing distance, and slide in directions that turn
further, which leads beyond the mechanisms that fit the forces exactly; after a failure it shrinks. What is found is an
upper bound of the least load factor, nothing more: on a wall of five units by eight courses with friction 0.84 the
search ends at 0.603575 from a solution of 0.6302, and finds nothing below another of 0.6349. In the plane, wall 5 of
Ferris and Tin-Loi goes from 0.2159 to 0.207973 and a wall of 10 by 10 from 0.5765 to 0.569281.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, field, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.sections.analysis import LowestScheme
from mbla.errors import Message
from mbla.program.kinematic import ConeProgram
from mbla.program.program import Program
from mbla.program.static import PointMotion, StaticForm, fixed_mechanism_form
from mbla.solution.cone_solvers.choice import interior_point_solver
from mbla.solution.cone_solvers.cone_solution import ConeSolution, Log
from mbla.solution.nonassociative.factor_range import (
    END_RESIDUAL,
    REGULARIZATION,
    TOLERANCE,
    factor_range,
    unbalanced,
)
from mbla.solution.nonassociative.law_state import LawState, SequenceResult, law_state
from mbla.solution.nonassociative.point_motion import Nearness, motion_of, point_motion, sparse_mechanism
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import WITH_VALUE, IterationRecord, ProgramRecord, Status

NEARNESS = (
    Nearness(1e-7, 1e-4),
    Nearness(1e-5, 1e-3),
    Nearness(1e-3, 1e-2),
    Nearness(3e-3, 3e-2),
    Nearness(1e-2, 1e-1),
    Nearness(5e-2, 3e-1),
    Nearness(2e-1, 5e-1),
)
"""Steps of daring. At the first the shear keeps its direction, which misses the law by half the square of the turn."""

PLATEAU = 2e-6
"""Rise over the lowest load factor, relative, that is no rise: steps of that size are needed to get across."""

AT_REST = 1e-6
"""Velocity over the largest below which a point of a sparse mechanism is at rest; vertices are exact to 1e-9."""

NOTABLE = 1e-4
"""Relative fall of the load factor that gets a line among the programs."""

STALE = 300
"""Tries in a row without a lower load factor after which the search ends before its time."""

NEEDLESS = 1e-6
"""Load factor, over dead load over live load, of a mechanism that needs no live load: in space a block can turn about
the one contact point that carries all its force. That fits the law and says nothing of a collapse."""

SOLVER = SolverSettings(tolerance=TOLERANCE, regularization=REGULARIZATION)


def search_lower_factor(
    program: Program, sequence: SequenceResult, scheme: LowestScheme, settings: SolverSettings, log: Log
) -> SequenceResult:
    """Lowest load factor found from a solution within ``scheme.seconds``; never above that of the solution."""
    start = sequence.state
    if start is None or sequence.status is not Status.SOLVED or start.residual > END_RESIDUAL:
        words = "the search for lower load factors did not begin: it needs a solution that fits the joint law to 1e-6"
        remark = Message("lowest-search-not-begun", words)
        return replace(sequence, remarks=(*sequence.remarks, remark))
    deadline = time.monotonic() + scheme.seconds
    if settings.deadline is not None:
        deadline = min(deadline, settings.deadline)
    ends = factor_range(program, start, settings, log, len(sequence.programs) + 1)
    records = [*sequence.programs, *ends.programs]
    search = _Search(program, ends.lower or start, np.random.default_rng(scheme.seed), records, log)
    while search.goes_on and time.monotonic() < deadline:
        search.step(replace(SOLVER, deadline=deadline))
    return replace(
        sequence,
        state=search.best,
        programs=tuple(search.records),
        remarks=(*sequence.remarks, *search.words(start, scheme)),
    )


@dataclass
class _Search:
    """Where the search stands: the state it goes on from, the lowest so far, how daring it is."""

    program: Program
    best: LawState
    rng: np.random.Generator
    records: list[ProgramRecord]
    log: Log
    here: LawState = field(init=False)
    gain: FloatArray = field(init=False)
    tries: int = 0
    needless: int = 0
    stale: int = 0
    daring: int = 0
    noted: float = field(init=False)
    since: float = field(init=False)
    unlogged: list[IterationRecord] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.here, self.noted, self.since = self.best, self.best.load_factor, time.perf_counter()
        self.gain = np.zeros(self.program.n_points)

    @property
    def goes_on(self) -> bool:
        """Whether there is anything left to look for."""
        return self.stale < STALE and self.best.load_factor > NEEDLESS * self.program.dead_over_live

    @property
    def size(self) -> float:
        """What differences of load factors are relative to."""
        return max(abs(self.best.load_factor), 1e-3 * self.program.dead_over_live)

    def step(self, settings: SolverSettings) -> None:
        """One try: forces, mechanism, lower end."""
        self.tries += 1
        self.stale += 1
        near = NEARNESS[self.daring]
        forces = self._extreme_forces(settings) if self.rng.random() < 0.5 else self.here.forces
        weights = self.rng.random(self.program.n_points) ** 3 + 1e-3  # a few points heavy: sparser vertices
        if self.rng.random() < 0.5:
            weights += self.gain * self.rng.random(self.program.n_points)
        speed = max(_speed(self.program, self.here.velocities), 1e-300)
        velocities = sparse_mechanism(self.program, forces, near, weights, speed, settings)
        succeeded = velocities is not None and self._descend(velocities, forces, settings)
        self.daring = min(self.daring + 1, len(NEARNESS) - 1) if succeeded else max(self.daring - 1, 0)

    def _descend(self, velocities: FloatArray, forces: FloatArray, settings: SolverSettings) -> bool:
        """Lower end for a mechanism; whether it was kept."""
        program = self.program
        motion = motion_of(program, velocities, AT_REST)
        if self.daring == 0:
            motion = _with_shear_of(program, motion, forces)
        form = fixed_mechanism_form(program, motion)
        solution = self._solve(form, form.cone_program, settings)
        if solution is None:
            return False
        end = law_state(program, 0.0, form.forces(solution.x), velocities, form.load_factor(solution.x))
        if max(end.residual, unbalanced(program, end)) > END_RESIDUAL:
            return False
        if end.load_factor > self.best.load_factor + PLATEAU * self.size:
            return False
        if end.load_factor <= NEEDLESS * program.dead_over_live:
            self.needless += 1
            return False
        self.here, self.gain = end, _gain(program, solution.z)
        if end.load_factor < self.best.load_factor:
            if end.load_factor < self.best.load_factor - PLATEAU * self.size:
                self.stale = 0
            self.best = end
            self._note(solution)
        return True

    def _extreme_forces(self, settings: SolverSettings) -> FloatArray:
        """Forces that fit the mechanism at nearly the same load factor, as extreme as random weights make them."""
        program = self.program
        form = fixed_mechanism_form(program, point_motion(program, self.here, AT_REST))
        cone_program, factor = form.cone_program, self.here.load_factor + 0.5 * PLATEAU * self.size
        on_normal = np.zeros((program.n_points, program.components))
        on_normal[:, 0] = self.rng.random(program.n_points) ** 3
        extreme = replace(
            cone_program,
            cost=form.expand.T @ on_normal.ravel(),
            matrix=cone_program.matrix[:, :-1],
            rhs=cone_program.rhs - factor * cone_program.matrix[:, [-1]].toarray().ravel(),
        )
        solution = self._solve(form, extreme, settings)
        return self.here.forces if solution is None else form.forces(np.append(solution.x, factor))

    def _solve(self, form: StaticForm, cone_program: ConeProgram, settings: SolverSettings) -> ConeSolution | None:
        number = len(self.records) + 1
        solution = interior_point_solver(cone_program, settings, self.unlogged.append, has_inside=False).solve(
            number, form.program.scaling.live
        )
        return solution if solution.status in WITH_VALUE else None

    def _note(self, solution: ConeSolution) -> None:
        """A line among the programs where the load factor has fallen by something worth one."""
        if self.best.load_factor > self.noted - NOTABLE * self.size:
            return
        live, now = self.program.scaling.live, time.perf_counter()
        change = abs(self.best.load_factor - self.noted) / self.size
        iterations = len(self.unlogged)
        for record in self.unlogged:
            self.log(record)
        self.unlogged = []
        number, value = len(self.records) + 1, self.best.load_factor * live
        last = solution.record(number, "lowest", value, change)
        self.records.append(replace(last, iterations=iterations, seconds=now - self.since))
        self.noted, self.since = self.best.load_factor, now

    def words(self, start: LawState, scheme: LowestScheme) -> tuple[Message, ...]:
        """How the lowest was found, and what it is."""
        live = self.program.scaling.live
        ended = "" if self.stale < STALE else f"; the last {STALE} found nothing lower"
        found = Message(
            "lowest-search",
            f"search for lower load factors (seed {scheme.seed}): {self.tries} mechanisms tried, from "
            f"{start.load_factor * live:.6g} down to {self.best.load_factor * live:.6g}{ended}; "
            "this is an upper bound of the least load factor without dilatancy, not that itself",
        )
        if not self.needless:
            return (found,)
        needless = (
            f"{self.needless} of the mechanisms tried needed no live load at all, such as a block that turns about the "
            "one contact point that carries all its force: they fit the joint law and are not counted"
        )
        return found, Message("lowest-search", needless)


def _speed(program: Program, velocities: FloatArray) -> float:
    """Largest contact speed of a mechanism."""
    v = (program.equilibrium_matrix.T @ velocities).reshape(-1, program.components)
    return float(np.linalg.norm(v, axis=1).max(initial=0.0))


def _gain(program: Program, duals: FloatArray) -> FloatArray:
    """What the load factor gains, per force, if a point that moves came to rest, over the largest; (n_points,).

    With y the dual variables of equilibrium, one unit of normal force with the best shear changes the load factor by
    (Aᵀy)_N − μ ‖(Aᵀy)_T‖.
    """
    rates = (program.equilibrium_matrix.T @ duals[: len(program.dead_load)]).reshape(-1, program.components)
    fall = program.limits.friction * np.linalg.norm(rates[:, 1:], axis=1) - rates[:, 0]
    return np.asarray(np.maximum(fall, 0.0) / max(float(fall.max(initial=0.0)), 1e-300))


def _with_shear_of(program: Program, motion: PointMotion, forces: FloatArray) -> PointMotion:
    """The motion with the direction of the shear that the forces have, where they have any."""
    limits = program.limits
    strength = limits.cohesion + limits.friction * forces[:, 0]
    size = np.linalg.norm(forces[:, 1:], axis=1)
    strong = strength > NEARNESS[0].force * float(strength.max(initial=0.0))
    direction = forces[:, 1:] / np.maximum(size, 1e-300)[:, None]
    return replace(motion, shear=np.where(strong[:, None], direction, motion.shear))
