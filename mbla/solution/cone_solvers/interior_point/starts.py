"""Where a run starts: inside the cones, from nothing, by least squares, or near the solution of a neighbour."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.cone_solvers.interior_point.condensation import Condensation, refined_solution
from mbla.solution.cone_solvers.interior_point.cone_data import ConeData
from mbla.solution.cone_solvers.interior_point.iterates import Point
from mbla.solution.cone_solvers.interior_point.scaling import Scaling

MARGIN = 0.1
"""Distance from the border of a warm start, in mean sizes. Of five structures with friction growing by a twentieth it
saved 13 to 42 % of the iterations, with the load turning by a twentieth 37 to 56 %; 0.01 saved more or none, 1 less."""


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
