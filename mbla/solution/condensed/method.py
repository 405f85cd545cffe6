"""The primal–dual interior-point method on the condensed system.

::

    min c·x + ½ xᵀQ x   s.t.  E x = e,  G x + s = h,  s ∈ K         dual:  Q x + c + Eᵀy + Gᵀz = 0,  z ∈ K

With the scaling of Nesterov and Todd, l = W z = W⁻¹ s, every iteration solves for the scaled steps dz̃ = W dz and
ds̃ = W⁻¹ ds, for products r and a share f of the residuals r_x = Q x + c + Eᵀy + Gᵀz, r_e = E x − e, r_z = G x + s − h::

    q̃ = l ∖ r − f W⁻¹ r_z
    (Q + G̃ᵀG̃) dx + Eᵀ dy = −f r_x + G̃ᵀ q̃,     E dx = −f r_e,      G̃ = W⁻¹ G
    dz̃ = G̃ dx − q̃,     ds̃ = −l ∖ r − dz̃

first with r = l ∘ l, f = 1 (predictor), then with r = l ∘ l + ds̃ ∘ dz̃ − σ μ e, f = 1 − σ, σ = (μ after the predictor /
μ)³ (corrector), then, where the step is short, with products that lie far from the mean pulled towards it. Where the
cost is linear s and (y, z) go their own lengths, else one.

A program without solution lets the iterates diverge along a ray that proves it: z with Eᵀy + Gᵀz → 0 and e·y + h·z < 0
(nothing is admissible), or x with E x → 0, G x + s → 0, Q x → 0 and c·x < 0 (unbounded).

Sources: Mehrotra 1992 (doi:10.1137/0802028); Gondzio 1996 (doi:10.1007/BF00249643) for the further correctors; Nesterov
and Todd 1998 (doi:10.1137/S1052623495290209); Andersen, Roos and Terlaky 2003 (doi:10.1007/s10107-002-0349-3) for
cones; Vandenberghe, "The CVXOPT linear and quadratic cone program solvers", 2010.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from typing import TypeVar

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.condensed.condensation import Condensation, refined_solution
from mbla.solution.condensed.cone_data import ConeData
from mbla.solution.condensed.scaling import Scaling

SHARE = 0.99
"""Of the way to the border that a step goes."""

CORRECTORS, LONG, BEYOND, OUTLYING = 2, 0.9, 0.3, 10.0
"""Correctors at most, only of steps shorter than this; how far beyond its end they look; factor from the mean that
counts as outlying. On 18 walls, vaults and arches they saved a tenth of the iterations."""

MARGIN = 0.1
"""Distance from the border of a warm start, in mean sizes. Of five structures with friction growing by a twentieth it
saved 13 to 42 % of the iterations, with the load turning by a twentieth 37 to 56 %; 0.01 saved more or none, 1 less."""

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
class Point:
    """An iterate."""

    x: FloatArray
    y: FloatArray
    s: FloatArray
    z: FloatArray


@dataclass(frozen=True)
class Measures:
    """How far an iterate is from the solution; all relative.

    primal_objective, dual_objective : c·x + ½ xᵀQx and −e·y − h·z − ½ xᵀQx
    infeasible, unbounded : how far it is from proving that, infinite where it says nothing of the kind: 1 over the size
                            that a solution of the program, of its dual, would at least have
    """

    gap: float
    primal: float
    dual: float
    primal_objective: float
    dual_objective: float
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


def solve_cone_program(data: ConeData, condensation: Condensation, run: Run, start: Point | None = None) -> Ended:
    """Run the method from a start inside the cones, the usual one if None."""
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):  # a run that diverges is seen and given up
        point = start or usual_start(data, condensation)
        if point is None:
            nothing = inside_start(data)
            return Ended(Outcome.NUMERICAL, nothing, measured(data, nothing), 0)
        return best_of_run(data, run, point, lambda now: _step(data, condensation, now), lambda now: now)


def warm_start(data: ConeData, x: FloatArray, y: FloatArray, z: FloatArray) -> Point:
    """The solution of a neighbouring program, moved into the cones of this one.

    Every half-line and cone gets a distance from its border of ``MARGIN`` times the mean one: from the border itself
    the method hardly gets away.
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


def inside_start(data: ConeData) -> Point:
    """S = z = e, nothing else."""
    e = data.product.identity()
    return Point(np.zeros(len(data.cost)), np.zeros(len(data.equation_rhs)), e, e)


def usual_start(data: ConeData, condensation: Condensation) -> Point | None:
    """Least squares: the least slack s, and the least z, that fit the equations, moved inside; None on breakdown."""
    product, identity = data.product, Scaling.identity(data.product)
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


Residuals = tuple[FloatArray, FloatArray, FloatArray]


def _residuals(data: ConeData, point: Point) -> Residuals:
    """r_x, r_e, r_z."""
    r_x = data.quadratic * point.x + data.cost + data.equations_t @ point.y + data.cone_matrix_t @ point.z
    return r_x, data.equations @ point.x - data.equation_rhs, data.cone_matrix @ point.x + point.s - data.cone_rhs


def measured(data: ConeData, point: Point) -> Measures:
    """How far an iterate is from the solution, or from a ray."""
    r_x, r_e, r_z = _residuals(data, point)
    x, y, s, z = point.x, point.y, point.s, point.z
    curved = float(x @ (data.quadratic * x))
    primal_objective = float(data.cost @ x) + 0.5 * curved
    offset = float(data.equation_rhs @ y + data.cone_rhs @ z)
    dual_objective = -offset - 0.5 * curved
    size_x = max(_size(x), _size(s))
    size_z = max(_size(y), _size(z))
    limit = max(1.0, max(_size(data.equation_rhs), _size(data.cone_rhs)) + size_x)
    ray_dual = max(_size(r_x - data.cost - data.quadratic * x), 0.0)
    ray_primal = max(_size(r_e + data.equation_rhs), _size(r_z + data.cone_rhs), _size(data.quadratic * x))
    work = float(data.cost @ x)
    return Measures(
        gap=abs(primal_objective - dual_objective) / max(1.0, min(abs(primal_objective), abs(dual_objective))),
        primal=max(_size(r_e), _size(r_z)) / limit,
        dual=_size(r_x) / max(1.0, _size(data.cost) + size_z + _size(x)),
        primal_objective=primal_objective,
        dual_objective=dual_objective,
        infeasible=ray_dual / -offset if offset < 0.0 else np.inf,
        unbounded=ray_primal * max(1.0, _size(data.cost)) / -work if work < 0.0 else np.inf,
    )


@dataclass(frozen=True)
class _Direction:
    """A step: of x and y, and of s and z in the scaled space."""

    x: FloatArray
    y: FloatArray
    s: FloatArray
    z: FloatArray


@dataclass(frozen=True)
class _Frame:
    """An iterate in the scaled space, with N factorised there.

    middle : l = W z = W⁻¹ s
    """

    data: ConeData
    condensation: Condensation
    scaling: Scaling
    middle: FloatArray
    residuals: Residuals

    @property
    def mean(self) -> float:
        """μ."""
        return float(self.middle @ self.middle) / self.data.product.degree

    def direction(self, products: FloatArray, share: float, *, refined: bool = True) -> _Direction:
        """The step for products r and a share f of the residuals."""
        data, scaling = self.data, self.scaling
        r_x, r_e, r_z = self.residuals
        divided = data.product.quotient(self.middle, products)
        q = divided - share * scaling.inverse(r_z)
        right = data.cone_matrix_t @ scaling.inverse(q) - share * r_x
        if refined:
            x, y = refined_solution(data, self.condensation, scaling, right, -share * r_e)
        else:
            x, y = self.condensation.solve(right, -share * r_e)
        z = scaling.inverse(data.cone_matrix @ x) - q
        return _Direction(x, y, -divided - z, z)

    def lengths(self, direction: _Direction, share: float) -> tuple[float, float]:
        """How far s and (y, z) go, at most 1: each its own way where the cost is linear."""
        product = self.data.product
        reach = [min(1.0, share * product.longest_step(self.middle, step)) for step in (direction.s, direction.z)]
        return (reach[0], reach[1]) if self.data.is_linear else (min(reach), min(reach))

    def ahead(self, direction: _Direction, to_s: float, to_z: float) -> tuple[FloatArray, FloatArray]:
        """Scaled s and z after a step."""
        return self.middle + to_s * direction.s, self.middle + to_z * direction.z


def _step(data: ConeData, condensation: Condensation, point: Point) -> tuple[Point, float] | None:
    """Predictor and correctors; the next iterate and the shorter of the two lengths, None on breakdown."""
    product = data.product
    scaling = Scaling.of(product, point.s, point.z)
    middle = scaling.times(point.z)
    if not np.isfinite(middle).all() or not condensation.factorize(scaling):
        return None
    frame = _Frame(data, condensation, scaling, middle, _residuals(data, point))
    square = product.product(middle, middle)
    predictor = frame.direction(square, 1.0, refined=False)
    s, z = frame.ahead(predictor, *frame.lengths(predictor, 1.0))
    sigma = min(1.0, (max(float(s @ z), 0.0) / product.degree / frame.mean) ** 3)
    products = square + product.product(predictor.s, predictor.z) - sigma * frame.mean * product.identity()
    direction = frame.direction(products, 1.0 - sigma)
    direction, to_s, to_z = _centred(frame, products, sigma, direction)
    if not (np.isfinite(direction.x).all() and np.isfinite(direction.z).all()):
        return None
    moved = Point(
        point.x + to_s * direction.x,
        point.y + to_z * direction.y,
        point.s + to_s * scaling.times(direction.s),
        point.z + to_z * scaling.inverse(direction.z),
    )
    return moved, min(to_s, to_z)


def _centred(
    frame: _Frame, products: FloatArray, sigma: float, direction: _Direction
) -> tuple[_Direction, float, float]:
    """The direction and its lengths, after correctors that pull outlying products towards the middle.

    A corrector looks at the products a little beyond where the step would end, and is kept where it makes it longer.
    """
    product, target = frame.data.product, sigma * frame.mean
    to_s, to_z = frame.lengths(direction, SHARE)
    for _ in range(CORRECTORS):
        if min(to_s, to_z) > LONG:
            break
        ahead = product.product(*frame.ahead(direction, min(1.0, to_s + BEYOND), min(1.0, to_z + BEYOND)))
        wanted = product.clipped(ahead, target / OUTLYING, target * OUTLYING)
        products = products + ahead - wanted
        trial = frame.direction(products, 1.0 - sigma)
        longer = frame.lengths(trial, SHARE)
        if not min(longer) >= min(to_s, to_z) + 0.1 * BEYOND:
            break
        direction, (to_s, to_z) = trial, longer
    return direction, to_s, to_z


def _size(v: FloatArray) -> float:
    return float(np.abs(v).max(initial=0.0))
