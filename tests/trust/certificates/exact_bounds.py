r"""Bounds of the associative load factor in rational arithmetic.

Let points, frames, centroids, loads, friction and strengths of a result file be the rational numbers that their floats
are. With A, f_D and f_L made of them by exact products, the *load factor of the file's model* is::

    λ* = sup { λ : A x + f_D + λ f_L = 0,  ‖(T1, T2)‖ ≤ c + μ N,  −f_t ≤ N ≤ f_c  at every point }

It is a definite real number, which no rounding enters. Two theorems enclose it.

*Static.* If rational x and λ fulfil all conditions then λ ≤ λ*, by definition. The cone is tested without a root:
c + μ N ≥ 0 and T1² + T2² ≤ (c + μ N)².

*Kinematic.* Let u be rational with f_L·u > 0, v = Aᵀu, and at each point s ≥ 0 with s² ≥ v1² + v2², q = v_N − μ s,
and q ≥ 0 where the point cannot crush. Then λ* ≤ (Σ D − f_D·u) / (f_L·u) with D = c s + f_t q where q ≥ 0,
D = c s − f_c q where q < 0. For any x within the conditions

    −x·v = −N (μ s + q) − T·(v1, v2) ≤ −N μ s − N q + (c + μ N) s = c s − N q ≤ D,

and equilibrium gives λ f_L·u + f_D·u = −x·v summed over the points.

Where x and u come from does not matter to the proof. Forces of the file are moved by a share θ towards forces strictly
inside of all conditions, then put into equilibrium: by least squares in floats, and the rest exactly, by a square
system of the columns with most room. The mechanism of the file is moved by θ towards one that opens every joint beyond
its friction. Both inner points are found by linear programs.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from scipy.linalg import qr
from scipy.optimize import linprog

from mbla.arrays import FloatArray
from mbla.solution.solution import Mechanics
from tests.trust.certificates.rational import (
    ZERO,
    ExactCase,
    Vector,
    at_least_root,
    dot,
    rationals,
    solved_exactly,
)

SHARES = tuple(10.0**power for power in (-11, -10, -9, -8, -7, -6, -5))
"""θ, tried in turn"""
ROOM = 1e-9
"""least margin of an inner point, over the size of what it is inside of, that counts"""


@dataclass(frozen=True)
class ExactBounds:
    """static ≤ λ* ≤ kinematic; None where no certificate was found."""

    static: Fraction | None
    kinematic: Fraction | None


def exact_bounds(case: ExactCase, mechanics: Mechanics) -> ExactBounds:
    """Exact bounds from the forces and the mechanism of a result file."""
    return ExactBounds(exact_static(case, mechanics), exact_kinematic(case, mechanics))


def exact_static(case: ExactCase, mechanics: Mechanics) -> Fraction | None:
    """A λ that is carried, proved."""
    matrix, x, factor = case.matrix(), mechanics.contact_forces.ravel(), mechanics.load_factor
    inner = _inner_forces(case, matrix, factor)
    if inner is None:
        return None
    for share in SHARES:
        near = (1.0 - share) * x + share * inner[0]
        carried = Fraction((1.0 - share) * factor + share * inner[1])
        forces = _balanced(case, matrix, near, carried)
        if forces is not None and within_limits(case, forces) and not any(case.unbalanced(forces, carried)):
            return carried
    return None


def exact_kinematic(case: ExactCase, mechanics: Mechanics) -> Fraction | None:
    """A λ beyond which nothing is carried, proved."""
    motion = mechanics.mechanism[list(case.free)].ravel()
    opening = _opening_motion(case, motion)
    opened = [] if opening is None else [motion + share * opening for share in SHARES]
    for tried in (*opened, motion):
        bound = bound_of(case, rationals(tried))
        if bound is not None:
            return bound
    return None


def within_limits(case: ExactCase, forces: Vector) -> bool:
    """Whether forces, 3 a point, fulfil all conditions."""
    for number, limits in enumerate(case.limits):
        normal, first, second = forces[3 * number : 3 * number + 3]
        strength = limits.cohesion + limits.friction * normal
        if strength < 0 or first * first + second * second > strength * strength or normal < -limits.tension:
            return False
        if limits.compression is not None and normal > limits.compression:
            return False
    return True


def bound_of(case: ExactCase, motion: Vector) -> Fraction | None:
    """The kinematic bound of a motion, (n_rows,); None where it proves nothing."""
    power, velocities = dot(case.live, motion), case.velocities(motion)
    if power <= 0:
        return None
    dissipated = ZERO
    for number, limits in enumerate(case.limits):
        opening, first, second = velocities[3 * number : 3 * number + 3]
        sliding = at_least_root(first * first + second * second)
        surplus = opening - limits.friction * sliding
        if surplus < 0 and limits.compression is None:
            return None
        resistance = limits.tension if surplus >= 0 else -(limits.compression or ZERO)
        dissipated += limits.cohesion * sliding + resistance * surplus
    return (dissipated - dot(case.dead, motion)) / power


def _balanced(case: ExactCase, matrix: FloatArray, near: FloatArray, factor: Fraction) -> Vector | None:
    """Forces near the given ones in exact equilibrium; None where no square system of columns is found."""
    room = _margins(case, near)
    weighted = matrix * room
    scale = np.abs(matrix).sum(axis=1) @ np.abs(matrix).sum(axis=1) / len(matrix)
    size = 1.0 / np.sqrt(np.maximum((weighted**2).sum(axis=1), 1e-300 * scale))
    for _ in range(3):
        left = np.array([float(part) for part in case.unbalanced(rationals(near), factor)])
        near = near - room * np.linalg.lstsq(weighted * size[:, None], left * size, rcond=None)[0]
    _, _, order = qr(weighted * size[:, None], mode="economic", pivoting=True)
    chosen = order[: len(matrix)].tolist()
    if len(chosen) < len(matrix):
        return None
    rows = range(len(matrix))
    columns = [[case.columns[number].get(row, ZERO) for row in rows] for number in chosen]
    forces = rationals(near)
    change = solved_exactly(columns, [-part for part in case.unbalanced(forces, factor)])
    if change is None:
        return None
    for number, part in zip(chosen, change, strict=True):
        forces[number] += part
    return forces


def _margins(case: ExactCase, forces: FloatArray) -> FloatArray:
    """How far each component may move about, (3 n_points,): the distance of its force from the cone and the ends."""
    room = []
    for limits, (normal, first, second) in zip(case.limits, forces.reshape(-1, 3), strict=True):
        margin = float(limits.cohesion) + float(limits.friction) * normal - np.hypot(first, second)
        ends = [margin, normal + float(limits.tension)]
        if limits.compression is not None:
            ends.append(float(limits.compression) - normal)
        room += 3 * [max(min(ends), 1e-290)]
    return np.array(room)


def _inner_forces(case: ExactCase, matrix: FloatArray, factor: float) -> tuple[FloatArray, float] | None:
    """Forces strictly inside of all conditions, and the load factor that they carry; None where there are none.

    Of |T1| + |T2| ≤ c + μ N, which is inside of the cone, the least margin is made as large as it can be.
    """
    dead, live = (np.array([float(part) for part in load]) for load in (case.dead, case.live))
    unit = float(np.abs(dead).max()) or float(np.abs(live).max())
    n_points, n_forces = len(case.limits), matrix.shape[1]
    rows, ends = [], []
    for number, limits in enumerate(case.limits):
        for first in (-1.0, 1.0):
            for second in (-1.0, 1.0):
                row = np.zeros(n_forces + 2)
                row[3 * number : 3 * number + 3] = -float(limits.friction), first, second
                row[-1] = 1.0
                rows.append(row)
                ends.append(float(limits.cohesion) / unit)
    lower = [-float(limits.tension) / unit for limits in case.limits]
    upper = [np.inf if limits.compression is None else float(limits.compression) / unit for limits in case.limits]
    for sign, ends_of in ((-1.0, [-end for end in lower]), (1.0, upper)):
        for number in range(n_points):
            if np.isfinite(ends_of[number]):
                row = np.zeros(n_forces + 2)
                row[3 * number], row[-1] = sign, 1.0
                rows.append(row)
                ends.append(ends_of[number])
    reach = max(abs(factor), 1e-3)
    answer = linprog(
        -np.eye(n_forces + 2)[-1],
        A_ub=np.array(rows),
        b_ub=np.array(ends),
        A_eq=np.column_stack([matrix, live / unit, np.zeros(len(dead))]),
        b_eq=-dead / unit,
        bounds=[(None, None)] * n_forces + [(factor - 2.0 * reach, factor), (0.0, 1.0)],
        method="highs",
    )
    if answer.x is None or not answer.success or answer.x[-1] <= ROOM:
        return None
    return answer.x[:-2] * unit, float(answer.x[-2])


def _opening_motion(case: ExactCase, motion: FloatArray) -> FloatArray | None:
    """A motion about as large as the given one that opens all joints which cannot crush beyond their friction.

    v_N - μ (|v_1| + |v_2|) is made as large as it can be at the joint where it is least; None where it is not positive.
    """
    matrix = case.matrix()
    speed = float(np.abs(matrix.T @ motion).max(initial=0.0))
    rows = []
    for number, limits in enumerate(case.limits):
        if limits.compression is None:
            normal, one, other = matrix[:, 3 * number : 3 * number + 3].T
            for first in (-1.0, 1.0):
                for second in (-1.0, 1.0):
                    row = -normal + float(limits.friction) * (first * one + second * other)
                    rows.append(np.append(row, 1.0))
    if not rows or not speed > 0:
        return None
    answer = linprog(
        np.append(np.zeros(len(motion)), -1.0),
        A_ub=np.array(rows),
        b_ub=np.zeros(len(rows)),
        bounds=[(-1e3, 1e3)] * len(motion) + [(0.0, 1.0)],
        method="highs",
    )
    if answer.x is None or not answer.success or answer.x[-1] <= ROOM:
        return None
    return np.asarray(answer.x[:-1] * speed)
