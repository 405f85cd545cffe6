"""The associative load factor between two linear programs: friction polygons inside and around the circle.

A polygon of m sides inscribed in the friction circle leaves less strength, one around it more: their load factors
enclose that of the circle. Both are assembled here from points, frames and loads, and HiGHS solves them; of the
program's own matrices and cones nothing is used.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.optimize import linprog

from mbla.arrays import FloatArray
from tests.trust.certificates.rational import ExactCase, Limits

SIDES = 16
LOCKED = 1e6
"""load factors of this many times dead over live load count as unlimited"""


@dataclass(frozen=True)
class Bracket:
    """Load factors with the inner and the outer polygon: -inf where nothing is in equilibrium, inf without a limit.

    inner_stands : whether the inner polygon carries the dead load alone. A live load that holds the structure up may
                   leave a load factor where it is not carried, below zero or above
    outer_stands : whether HiGHS does not exclude that the outer one carries it
    """

    inner: float
    outer: float
    inner_stands: bool
    outer_stands: bool


def bracket_of(case: ExactCase) -> Bracket:
    """The load factor of both linear programs; nan where HiGHS does not decide."""
    apothem = math.cos(math.pi / SIDES)
    return Bracket(
        inner=_load_factor(case, apothem, LOCKED),
        outer=_load_factor(case, 1.0, LOCKED),
        inner_stands=_load_factor(case, apothem, 0.0) == 0.0,
        outer_stands=_load_factor(case, 1.0, 0.0) != -math.inf,
    )


def _load_factor(case: ExactCase, radius: float, most: float) -> float:
    """With the polygon of ``SIDES`` sides at that distance from the middle, over the radius of the friction circle.

    Unknowns are 3 forces a point and the load factor, of size ``most`` at most, in units of the mean dead load.
    """
    dead, live = (np.array([float(part) for part in load]) for load in (case.dead, case.live))
    unit, live_unit = float(np.abs(dead[dead != 0]).mean()), float(np.abs(live).max())
    equations = sp.hstack([sp.csr_array(case.matrix()), sp.csr_array((live / live_unit)[:, None])], format="csr")
    shear, strength = _shear_conditions(case, radius, unit)
    ends = [_ends(limits, unit) for limits in case.limits]
    bounds = [end for normal in ends for end in (normal, (None, None), (None, None))]
    answer = linprog(  # type: ignore[call-overload]  # its stubs do not know sparse matrices
        -np.eye(1, equations.shape[1], equations.shape[1] - 1)[0],
        A_ub=shear,
        b_ub=strength,
        A_eq=equations,
        b_eq=-dead / unit,
        bounds=[*bounds, (-most, most)],
        method="highs",
    )
    if answer.status == 2:
        return -math.inf
    if answer.status != 0:
        return math.nan
    factor = float(answer.x[-1])
    return math.inf if most > 0 and factor > 0.999 * most else factor * unit / live_unit


def _ends(limits: Limits, unit: float) -> tuple[float, float | None]:
    """Least and greatest normal force of a point."""
    return -float(limits.tension) / unit, None if limits.compression is None else float(limits.compression) / unit


def _shear_conditions(case: ExactCase, radius: float, unit: float) -> tuple[sp.csr_array, FloatArray]:
    """g·T - radius μ N ≤ radius c for the normals g of all sides, at all points."""
    angles = (np.arange(SIDES) + 0.5) * 2.0 * math.pi / SIDES
    sides = np.column_stack([np.cos(angles), np.sin(angles)])
    blocks = [
        np.column_stack([np.full(SIDES, -radius * float(limits.friction)), sides[:, 0], sides[:, 1]])
        for limits in case.limits
    ]
    matrix = sp.block_diag(blocks, format="csr")
    strength = np.repeat([radius * float(limits.cohesion) / unit for limits in case.limits], SIDES)
    return sp.csr_array(sp.hstack([matrix, sp.csr_array((matrix.shape[0], 1))])), strength
