"""A run of an interior-point method: when it ends, and with which of its iterates."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from typing import TypeVar

import numpy as np

from mbla.solution.cone_solvers.interior_point.cone_data import ConeData
from mbla.solution.cone_solvers.interior_point.iterates import Measures, Point, measured

SHORTEST = 1e-8
"""Length of steps below which the method no longer gets on."""

STALLED, BETTER = 15, 0.8
"""Iterations after which the best iterate is returned when none was better, by this factor at least."""

RAY_SEEN = 1e-2
"""Quality of a ray from which it is watched."""

RAY_ENOUGH = 1e-5
"""Quality at which the ray of an unbounded program is an answer where the method gets no further; what it proves is for
the caller to repair."""

INFEASIBLE_ENOUGH = 1e-8
"""Likewise of an infeasible program, which is believed: it says that admissible x are larger than its inverse, and x
of a million occur where friction of a million meets joints that crush."""

RAY_STALLED = 4
"""Iterations in which such a ray must become twice as good."""

ALMOST = 1e-5
"""Accuracy up to which a best iterate is an approximate solution."""


class Outcome(Enum):
    """How a run ended."""

    SOLVED = "Solved"
    ALMOST = "AlmostSolved"
    INFEASIBLE = "PrimalInfeasible"
    UNBOUNDED = "DualInfeasible"
    ITERATIONS = "MaxIterations"
    TIME = "MaxTime"
    STALLED = "InsufficientProgress"
    NUMERICAL = "NumericalError"
    ENOUGH = "AlmostSolved, as asked"


@dataclass(frozen=True)
class Run:
    """What a run needs beside the data.

    enough   : accuracy at which to stop early, well inside the cones; 0: only at the end
    progress : gets every iterate's number, measures and the length of the step that led there
    """

    tolerance: float
    max_iterations: int
    deadline: float | None
    enough: float
    progress: Callable[[int, Measures, float], None]


@dataclass(frozen=True)
class Ended:
    """The last or the best iterate, and why the run ended."""

    outcome: Outcome
    point: Point
    measures: Measures
    iterations: int


Iterate = TypeVar("Iterate")


def best_of_run(
    data: ConeData,
    run: Run,
    start: Iterate,
    step: Callable[[Iterate], tuple[Iterate, float] | None],
    of_program: Callable[[Iterate], Point],
) -> Ended:
    """Iterate until there is an answer or none can be expected; ``step`` gives None on breakdown, and its length."""
    kept, now, length, outcome = _Kept(), start, 1.0, Outcome.ITERATIONS
    for number in range(run.max_iterations + 1):
        point = of_program(now)
        measures = measured(data, point)
        run.progress(number, measures, length)
        if not np.isfinite(measures.worst):
            outcome = Outcome.NUMERICAL
            break
        kept.see(number, point, measures)
        verdict = _verdict(measures, run)
        if verdict is not None:
            return Ended(verdict, point, measures, number)
        if run.deadline is not None and time.monotonic() > run.deadline:
            outcome = Outcome.TIME
            break
        if kept.stalled(number) or length < SHORTEST:
            outcome = Outcome.STALLED
            break
        if number == run.max_iterations:
            break
        moved = step(now)
        if moved is None:
            outcome = Outcome.NUMERICAL
            break
        now, length = moved
    return kept.ended(outcome, point, measures, number)


@dataclass
class _Kept:
    """The best iterate and the best ray of a run, and when they were found."""

    best: tuple[Point, Measures] | None = None
    ray: tuple[Point, Measures] | None = None
    last_best: int = 0
    last_worst: float = np.inf
    last_ray: int = 0
    last_measured: float = RAY_SEEN

    def see(self, number: int, point: Point, measures: Measures) -> None:
        if self.best is None or measures.worst < self.best[1].worst:
            self.best = point, measures
        if measures.worst < BETTER * self.last_worst:
            self.last_best, self.last_worst = number, measures.worst
        if measures.ray < (RAY_SEEN if self.ray is None else self.ray[1].ray):
            self.ray = point, measures
            if measures.ray < 0.5 * self.last_measured:
                self.last_ray, self.last_measured = number, measures.ray

    def stalled(self, number: int) -> bool:
        """Whether neither has become better for long; a ray is soon as good as it gets."""
        if self._proof() is not None:
            return number - self.last_ray > RAY_STALLED
        return number - max(self.last_best, self.last_ray) > STALLED

    def _proof(self) -> Outcome | None:
        """What the best ray is taken for where nothing better comes."""
        if self.ray is None:
            return None
        measures = self.ray[1]
        if measures.infeasible < measures.unbounded:
            return Outcome.INFEASIBLE if measures.infeasible <= INFEASIBLE_ENOUGH else None
        return Outcome.UNBOUNDED if measures.unbounded <= RAY_ENOUGH else None

    def ended(self, outcome: Outcome, point: Point, measures: Measures, number: int) -> Ended:
        """The run's end: a ray that says something, else the best iterate."""
        if self.best is None:
            return Ended(outcome, point, measures, number)
        if outcome in (Outcome.STALLED, Outcome.NUMERICAL, Outcome.ITERATIONS):
            if self.best[1].worst <= ALMOST:
                return Ended(Outcome.ALMOST, *self.best, number)
            proof = self._proof()
            if proof is not None and self.ray is not None:
                return Ended(proof, *self.ray, number)
        return Ended(outcome, *self.best, number)


def _verdict(measures: Measures, run: Run) -> Outcome | None:
    if measures.worst <= run.tolerance:
        return Outcome.SOLVED
    if measures.infeasible <= run.tolerance:
        return Outcome.INFEASIBLE
    if measures.unbounded <= run.tolerance:
        return Outcome.UNBOUNDED
    return Outcome.ENOUGH if measures.worst <= run.enough else None
