"""Iterates of a cone program: how far they are from a solution or a ray, where a run starts and how it ends.

A run starts inside the cones: from nothing, by least squares, or near the solution of a neighbour.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.cone_solvers.interior_point.condensation import Condensation, refined_solution
from mbla.solution.cone_solvers.interior_point.cones import ConeData, NesterovToddScaling, dot, largest_entry


@dataclass(frozen=True)
class Point:
    """An iterate."""

    x: FloatArray
    y: FloatArray
    s: FloatArray
    z: FloatArray


@dataclass(frozen=True)
class Measures:
    """How far an iterate is from the solution; all relative.

    primal_objective : c·x + ½ xᵀQx
    infeasible, unbounded : how far it is from proving that, infinite where it says nothing of the kind: 1 over the size
                            that a solution of the program, of its dual, would at least have
    """

    gap: float
    primal: float
    dual: float
    primal_objective: float
    infeasible: float
    unbounded: float

    @property
    def ray(self) -> float:
        """How far the iterate is from a ray that proves something."""
        return min(self.infeasible, self.unbounded)

    @property
    def worst(self) -> float:
        """The largest of gap and residuals."""
        return max(self.gap, self.primal, self.dual)


Residuals = tuple[FloatArray, FloatArray, FloatArray]


def residuals_of(data: ConeData, point: Point) -> Residuals:
    """r_x, r_e, r_z."""
    r_x = data.quadratic * point.x + data.cost + data.equations_t @ point.y + data.cone_matrix_t @ point.z
    return r_x, data.equations @ point.x - data.equation_rhs, data.cone_matrix @ point.x + point.s - data.cone_rhs


def measured(data: ConeData, point: Point) -> Measures:
    """How far an iterate is from the solution, or from a ray."""
    r_x, r_e, r_z = residuals_of(data, point)
    x, y, s, z = point.x, point.y, point.s, point.z
    curved = dot(x, data.quadratic * x)
    primal_objective = dot(data.cost, x) + 0.5 * curved
    offset = dot(data.equation_rhs, y) + dot(data.cone_rhs, z)
    dual_objective = -offset - 0.5 * curved
    size_x = max(largest_entry(x), largest_entry(s))
    size_z = max(largest_entry(y), largest_entry(z))
    limit = max(1.0, max(largest_entry(data.equation_rhs), largest_entry(data.cone_rhs)) + size_x)
    ray_dual = max(largest_entry(r_x - data.cost - data.quadratic * x), 0.0)
    ray_primal = max(
        largest_entry(r_e + data.equation_rhs), largest_entry(r_z + data.cone_rhs), largest_entry(data.quadratic * x)
    )
    work = dot(data.cost, x)
    return Measures(
        gap=abs(primal_objective - dual_objective) / max(1.0, min(abs(primal_objective), abs(dual_objective))),
        primal=max(largest_entry(r_e), largest_entry(r_z)) / limit,
        dual=largest_entry(r_x) / max(1.0, largest_entry(data.cost) + size_z + largest_entry(x)),
        primal_objective=primal_objective,
        infeasible=ray_dual / -offset if offset < 0.0 else np.inf,
        unbounded=ray_primal * max(1.0, largest_entry(data.cost)) / -work if work < 0.0 else np.inf,
    )


MARGIN = 0.1
"""Distance from the border of a warm start, in mean sizes. Of five structures with friction growing by a twentieth it
saved 13 to 42 % of the iterations, with the load turning by a twentieth 37 to 56 %; 0.01 saved more or none, 1 less."""


def inside_start(data: ConeData) -> Point:
    """S = z = e, nothing else."""
    e = data.product.identity()
    return Point(np.zeros(len(data.cost)), np.zeros(len(data.equation_rhs)), e, e)


def usual_start(data: ConeData, condensation: Condensation) -> Point | None:
    """Least squares: the least slack s, and the least z, that fit the equations, moved inside; None on breakdown."""
    product, identity = data.product, NesterovToddScaling.identity(data.product)
    if not condensation.factorize(identity):
        return None
    pull = data.cone_matrix_t @ data.cone_rhs
    if data.is_linear:
        x, _ = refined_solution(data, condensation, identity, pull, data.equation_rhs)
        way, y = refined_solution(data, condensation, identity, -data.cost, np.zeros_like(data.equation_rhs))
        s, z = data.cone_rhs - data.cone_matrix @ x, data.cone_matrix @ way
    else:
        x, y = refined_solution(data, condensation, identity, pull - data.cost, data.equation_rhs)
        s = data.cone_rhs - data.cone_matrix @ x
        z = -s
    if not all(np.isfinite(part).all() for part in (x, y, s, z)):
        return None
    e = product.identity()
    return Point(x, y, *(v + max(0.0, 1.0 - product.least_eigenvalue(v)) * e for v in (s, z)))


def warm_start(data: ConeData, x: FloatArray, y: FloatArray, z: FloatArray) -> Point:
    """The solution of a neighbouring program, moved into the cones of this one.

    Every half-line and cone gets a distance from its border of ``MARGIN`` times the mean one: from the border itself
    the method hardly gets away.

    x, y, z : (n_unknowns,), (n_equations,) and (n_lines + 3 n_cones,)
    """
    product = data.product
    inside = []
    for v in (data.cone_rhs - data.cone_matrix @ x, z.copy()):
        heads = v[: product.degree]  # of half-lines and cones
        margin = MARGIN * max(float(np.abs(heads).mean()), 1e-300)
        cones = product.cones(v)
        product.lines(v)[:] = np.maximum(product.lines(v), margin)
        cones[0] = np.maximum(cones[0], np.hypot(cones[1], cones[2]) + margin)
        inside.append(v)
    return Point(x, y, *inside)


SHORTEST_STEP = 1e-8
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


@dataclass(frozen=True)
class IterationControl:
    """What a run needs beside the data.

    progress : gets every iterate's number, measures and the length of the step that led there
    """

    tolerance: float
    max_iterations: int
    deadline: float | None
    progress: Callable[[int, Measures, float], None]


@dataclass(frozen=True)
class Ended:
    """The last or the best iterate, and why the run ended."""

    outcome: Outcome
    point: Point
    measures: Measures
    iterations: int


def best_of_run(
    data: ConeData, run: IterationControl, start: Point, step: Callable[[Point], tuple[Point, float] | None]
) -> Ended:
    """Iterate until there is an answer or none can be expected; ``step`` gives None on breakdown, and its length."""
    kept, point, length, outcome = _Kept(), start, 1.0, Outcome.ITERATIONS
    for number in range(run.max_iterations + 1):
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
        if kept.stalled(number) or length < SHORTEST_STEP:
            outcome = Outcome.STALLED
            break
        if number == run.max_iterations:
            break
        moved = step(point)
        if moved is None:
            outcome = Outcome.NUMERICAL
            break
        point, length = moved
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


def _verdict(measures: Measures, run: IterationControl) -> Outcome | None:
    if measures.worst <= run.tolerance:
        return Outcome.SOLVED
    if measures.infeasible <= run.tolerance:
        return Outcome.INFEASIBLE
    if measures.unbounded <= run.tolerance:
        return Outcome.UNBOUNDED
    return None
