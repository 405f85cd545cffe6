"""One load case in rational arithmetic: every float of a result file taken as the rational number that it is.

Equilibrium and velocities are written once more here, from points, frames and centroids, with exact products.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import TypeAlias

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model

Vector: TypeAlias = list[Fraction]
ZERO = Fraction(0)
FINE = 2**200
"""roots are rounded up to multiples of one over this"""


@dataclass(frozen=True)
class Limits:
    """Of a contact point: friction, and the forces c, f_t and f_c; None where it cannot crush."""

    friction: Fraction
    cohesion: Fraction
    tension: Fraction
    compression: Fraction | None


@dataclass(frozen=True)
class ExactCase:
    """max λ subject to A x + f_D + λ f_L = 0 with every x_k = (N, T1, T2) within its limits.

    columns    : A by columns, 3 a point: entries other than zero by row, 6 rows a free block
    dead, live : f_D and f_L, (n_rows,)
    limits     : a point each
    free       : number of each free block in the model
    """

    columns: tuple[dict[int, Fraction], ...]
    dead: Vector
    live: Vector
    limits: tuple[Limits, ...]
    free: tuple[int, ...]

    def matrix(self) -> FloatArray:
        """A in floats, (n_rows, 3 n_points)."""
        matrix = np.zeros((len(self.dead), len(self.columns)))
        for number, column in enumerate(self.columns):
            for row, value in column.items():
                matrix[row, number] = float(value)
        return matrix

    def unbalanced(self, forces: Vector, factor: Fraction) -> Vector:
        """A x + f_D + λ f_L, (n_rows,)."""
        left = [dead + factor * live for dead, live in zip(self.dead, self.live, strict=True)]
        for column, force in zip(self.columns, forces, strict=True):
            for row, value in column.items():
                left[row] += value * force
        return left

    def velocities(self, motion: Vector) -> Vector:
        """Aᵀ u, 3 a point: opening and two slips."""
        return [sum((value * motion[row] for row, value in column.items()), ZERO) for column in self.columns]


def exact_case(model: Model, contacts: Contacts, load_case: LoadCase) -> ExactCase:
    """The load case of a result file; strengths are joint law times area of the point, multiplied exactly."""
    free = tuple(np.flatnonzero(~model.fixed).tolist())
    row_of = {block: 6 * number for number, block in enumerate(free)}
    columns: list[dict[int, Fraction]] = []
    limits: list[Limits] = []
    for point, interface in enumerate(contacts.interface_of_point.tolist()):
        bodies = contacts.bodies[interface].tolist()
        place = rationals(contacts.points[point])
        for direction in contacts.frames[point]:
            force = rationals(direction)
            column: dict[int, Fraction] = {}
            for body, sign in zip(bodies, (-1, 1), strict=True):
                if body in row_of:
                    arm = _difference(place, rationals(model.blocks.centroids[body]))
                    wrench = [sign * part for part in (*force, *_cross(arm, force))]
                    column |= {row_of[body] + k: part for k, part in enumerate(wrench) if part}
            columns.append(column)
        law = model.joints[contacts.joint_names[contacts.joints[interface]]]
        area = Fraction(float(contacts.point_areas[point]))
        crushes = math.isfinite(law.compressive_strength)
        limits.append(
            Limits(
                Fraction(law.friction),
                Fraction(law.cohesion) * area,
                Fraction(law.tensile_strength) * area,
                Fraction(law.compressive_strength) * area if crushes else None,
            )
        )
    dead, live = (rationals(load[list(free)].ravel()) for load in (load_case.dead_load, load_case.live_load))
    return ExactCase(tuple(columns), dead, live, tuple(limits), free)


def rationals(values: FloatArray) -> Vector:
    """Floats as the rational numbers that they are."""
    return [Fraction(value) for value in np.asarray(values).ravel().tolist()]


def dot(one: Vector, other: Vector) -> Fraction:
    """Sum of products."""
    return sum((a * b for a, b in zip(one, other, strict=True)), ZERO)


def at_least_root(square: Fraction) -> Fraction:
    """A rational number whose square is at least the given one, and hardly more; whole numbers alone find it."""
    return Fraction(math.isqrt(math.floor(square * FINE * FINE)) + 1, FINE) if square else ZERO


def solved_exactly(columns: list[Vector], right: Vector) -> Vector | None:
    """The x with Σ x_k columns_k = right of as many columns as rows; None where they are not independent."""
    size = len(right)
    rows = [[column[row] for column in columns] + [right[row]] for row in range(size)]
    for step in range(size):
        pivot = max(range(step, size), key=lambda row: abs(rows[row][step]))
        if rows[pivot][step] == 0:
            return None
        rows[step], rows[pivot] = rows[pivot], rows[step]
        for row in rows[step + 1 :]:
            if row[step]:
                share = row[step] / rows[step][step]
                row[step:] = [a - share * b for a, b in zip(row[step:], rows[step][step:], strict=True)]
    x = [ZERO] * size
    for step in reversed(range(size)):
        known = sum((rows[step][k] * x[k] for k in range(step + 1, size)), ZERO)
        x[step] = (rows[step][size] - known) / rows[step][step]
    return x


def _difference(one: Vector, other: Vector) -> Vector:
    return [a - b for a, b in zip(one, other, strict=True)]


def _cross(a: Vector, b: Vector) -> Vector:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
