"""Iterates of a cone program, and how far they are from its solution or from a ray that proves that there is none."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.cone_solvers.interior_point.cone_data import ConeData
from mbla.solution.cone_solvers.interior_point.cones import dot


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
    size_x = max(_size(x), _size(s))
    size_z = max(_size(y), _size(z))
    limit = max(1.0, max(_size(data.equation_rhs), _size(data.cone_rhs)) + size_x)
    ray_dual = max(_size(r_x - data.cost - data.quadratic * x), 0.0)
    ray_primal = max(_size(r_e + data.equation_rhs), _size(r_z + data.cone_rhs), _size(data.quadratic * x))
    work = dot(data.cost, x)
    return Measures(
        gap=abs(primal_objective - dual_objective) / max(1.0, min(abs(primal_objective), abs(dual_objective))),
        primal=max(_size(r_e), _size(r_z)) / limit,
        dual=_size(r_x) / max(1.0, _size(data.cost) + size_z + _size(x)),
        primal_objective=primal_objective,
        dual_objective=dual_objective,
        infeasible=ray_dual / -offset if offset < 0.0 else np.inf,
        unbounded=ray_primal * max(1.0, _size(data.cost)) / -work if work < 0.0 else np.inf,
    )


def _size(v: FloatArray) -> float:
    return float(np.abs(v).max(initial=0.0))
