"""The homogeneous embedding: less exact where there is a solution, made to find the ray that proves that there is none.

A scale τ of the program and the gap κ become unknowns::

    Q x + c τ + Eᵀy + Gᵀz = 0,   E x = e τ,   G x + s = h τ,   κ = −c·x − e·y − h·z − xᵀQ x / τ,   s, z ∈ K,  τ, κ ≥ 0

It always has a solution: with τ > 0 it gives that of the program, with κ > 0 a ray. It is run where the method itself
(``method``) ends without an answer: on a program without solution the products μ of that
one vanish before the residuals do, and its linear systems then cannot be solved any more.

Each iteration solves for the direction without change of τ and for the change with τ, from the same factorisation.

Sources: Ye, Todd and Mizuno 1994 (doi:10.1287/moor.19.1.53); with a quadratic cost: Goulart and Chen 2024
(arXiv:2405.12762), section 3.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.cone_solvers.interior_point.condensation import Condensation, refined_solution
from mbla.solution.cone_solvers.interior_point.cones import ConeData, ConeProduct, Scaling, dot
from mbla.solution.cone_solvers.interior_point.iterates import Ended, Point, Run, best_of_run, inside_start
from mbla.solution.cone_solvers.interior_point.method import SHARE


@dataclass(frozen=True)
class _Embedded:
    """An iterate of the embedding."""

    point: Point
    tau: float
    kappa: float

    def of_program(self) -> Point:
        """The iterate of the program itself; one of its size where τ vanishes."""
        p, tau = self.point, self.tau
        return Point(p.x / tau, p.y / tau, p.s / tau, p.z / tau)


@dataclass(frozen=True)
class _Direction:
    x: FloatArray
    y: FloatArray
    s: FloatArray  # scaled
    z: FloatArray  # scaled
    tau: float
    kappa: float


@dataclass(frozen=True)
class _Residuals:
    x: FloatArray
    e: FloatArray
    z: FloatArray
    tau: float


def solve_embedded(data: ConeData, condensation: Condensation, run: Run) -> Ended:
    """Run the embedding from the identity."""
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        start = _Embedded(inside_start(data), 1.0, 1.0)

        def step(now: _Embedded) -> tuple[_Embedded, float] | None:
            return _step(data, condensation, now)

        return best_of_run(data, run, start, step, _Embedded.of_program)


def _residuals(data: ConeData, now: _Embedded) -> _Residuals:
    p, tau = now.point, now.tau
    bent = data.quadratic * p.x
    along = dot(data.cost, p.x) + dot(data.equation_rhs, p.y) + dot(data.cone_rhs, p.z)
    return _Residuals(
        bent + data.cost * tau + data.equations_t @ p.y + data.cone_matrix_t @ p.z,
        data.equations @ p.x - data.equation_rhs * tau,
        data.cone_matrix @ p.x + p.s - data.cone_rhs * tau,
        now.kappa + along + dot(p.x, bent) / tau,
    )


def _step(data: ConeData, condensation: Condensation, now: _Embedded) -> tuple[_Embedded, float] | None:
    product, p = data.product, now.point
    scaling = Scaling.of(product, p.s, p.z)
    middle = scaling.times(p.z)
    if not np.isfinite(middle).all() or not condensation.factorize(scaling):
        return None
    residuals = _residuals(data, now)
    held = scaling.inverse(data.cone_rhs)
    right = data.cone_matrix_t @ scaling.inverse(held) - data.cost
    x2, y2 = refined_solution(data, condensation, scaling, right, data.equation_rhs)
    z2 = scaling.inverse(data.cone_matrix @ x2) - held
    bent = scaling.inverse(residuals.z)
    curved = data.quadratic * (p.x / now.tau)
    steep = data.cost + 2.0 * curved

    def along(x: FloatArray, y: FloatArray, z: FloatArray) -> float:
        return dot(steep, x) + dot(data.equation_rhs, y) + dot(held, z)

    slope = along(x2, y2, z2) - dot(curved, p.x) / now.tau - now.kappa / now.tau

    def direction(products: FloatArray, corner: float, share: float) -> _Direction:
        divided = product.quotient(middle, products)
        q = divided - share * bent
        rhs = data.cone_matrix_t @ scaling.inverse(q) - share * residuals.x
        x1, y1 = refined_solution(data, condensation, scaling, rhs, -share * residuals.e)
        z1 = scaling.inverse(data.cone_matrix @ x1) - q
        tau = (corner / now.tau - share * residuals.tau - along(x1, y1, z1)) / slope
        z = z1 + tau * z2
        return _Direction(x1 + tau * x2, y1 + tau * y2, -divided - z, z, tau, -(corner + now.kappa * tau) / now.tau)

    mean = (dot(middle, middle) + now.tau * now.kappa) / (product.degree + 1)
    first = direction(product.product(middle, middle), now.tau * now.kappa, 1.0)
    sigma = (1.0 - min(1.0, _reach(product, middle, now, first))) ** 3
    products = product.product(middle, middle) + product.product(first.s, first.z) - sigma * mean * product.identity()
    corner = now.tau * now.kappa + first.tau * first.kappa - sigma * mean
    d = direction(products, corner, 1.0 - sigma)
    if not (np.isfinite(d.x).all() and np.isfinite(d.z).all() and np.isfinite(d.tau)):
        return None
    length = min(1.0, SHARE * _reach(product, middle, now, d))
    return _moved(scaling, now, d, length), length


def _reach(product: ConeProduct, middle: FloatArray, now: _Embedded, d: _Direction) -> float:
    """Longest step along a direction that stays within the cones, τ and κ positive."""
    ends = [product.step_to_boundary(middle, d.s), product.step_to_boundary(middle, d.z)]
    ends += [-v / dv if dv < 0.0 else np.inf for v, dv in ((now.tau, d.tau), (now.kappa, d.kappa))]
    return float(min(ends))


def _moved(scaling: Scaling, now: _Embedded, d: _Direction, length: float) -> _Embedded:
    """The iterate after a step; slacks and multipliers of a direction are scaled."""
    p = now.point
    moved = Point(
        p.x + length * d.x,
        p.y + length * d.y,
        p.s + length * scaling.times(d.s),
        p.z + length * scaling.inverse(d.z),
    )
    return _Embedded(moved, now.tau + length * d.tau, now.kappa + length * d.kappa)
