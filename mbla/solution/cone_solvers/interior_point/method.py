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

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.cone_solvers.interior_point.condensation import Condensation, refined_solution
from mbla.solution.cone_solvers.interior_point.cones import ConeData, NesterovToddScaling, dot
from mbla.solution.cone_solvers.interior_point.iterates import (
    Ended,
    IterationControl,
    Outcome,
    Point,
    Residuals,
    best_of_run,
    inside_start,
    measured,
    residuals_of,
    usual_start,
)

SHARE = 0.99
"""Of the way to the border that a step goes."""

CORRECTORS, LONG, BEYOND, OUTLYING = 2, 0.9, 0.3, 10.0
"""Correctors at most, only of steps shorter than this; how far beyond its end they look; factor from the mean that
counts as outlying. On 18 walls, vaults and arches they saved a tenth of the iterations."""


def solve_cone_program(
    data: ConeData, condensation: Condensation, run: IterationControl, start: Point | None = None
) -> Ended:
    """Run the method from a start inside the cones, the usual one if None."""
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):  # a run that diverges is seen and given up
        point = start or usual_start(data, condensation)
        if point is None:
            nothing = inside_start(data)
            return Ended(Outcome.NUMERICAL, nothing, measured(data, nothing), 0)
        return best_of_run(data, run, point, lambda now: _step(data, condensation, now))


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
    scaling: NesterovToddScaling
    middle: FloatArray
    residuals: Residuals

    @property
    def mean(self) -> float:
        """μ."""
        return dot(self.middle, self.middle) / self.data.product.degree

    def direction(self, products: FloatArray, share: float, *, refined: bool = True) -> _Direction:
        """The step for products r and a share f of the residuals.

        products : (n_lines + 3 n_cones,)
        refined  : whether the step is refined against the system itself
        """
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
        reach = [min(1.0, share * product.step_to_boundary(self.middle, step)) for step in (direction.s, direction.z)]
        return (reach[0], reach[1]) if self.data.is_linear else (min(reach), min(reach))

    def ahead(self, direction: _Direction, to_s: float, to_z: float) -> tuple[FloatArray, FloatArray]:
        """Scaled s and z, (n_lines + 3 n_cones,) each, after steps of ``to_s`` and ``to_z`` along a direction."""
        return self.middle + to_s * direction.s, self.middle + to_z * direction.z


def _step(data: ConeData, condensation: Condensation, point: Point) -> tuple[Point, float] | None:
    """Predictor and correctors; the next iterate and the shorter of the two lengths, None on breakdown."""
    product = data.product
    scaling = NesterovToddScaling.of(product, point.s, point.z)
    middle = scaling.times(point.z)
    if not np.isfinite(middle).all() or not condensation.factorize(scaling):
        return None
    frame = _Frame(data, condensation, scaling, middle, residuals_of(data, point))
    square = product.product(middle, middle)
    predictor = frame.direction(square, 1.0, refined=False)
    s, z = frame.ahead(predictor, *frame.lengths(predictor, 1.0))
    sigma = min(1.0, (max(dot(s, z), 0.0) / product.degree / frame.mean) ** 3)
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
