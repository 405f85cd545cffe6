"""Vectors of a product of half-lines and second-order cones: inside or not, how far to the border, the barrier."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray, starts
from mbla.program.kinematic import ConeProgram

LEAST = 1e-13
"""Least distance from the border of its cone, relative to the largest vector, that a vector is moved to; relative to
what light blocks carry where it belongs to one."""


def lines_to_boundary(inside: FloatArray, step: FloatArray) -> FloatArray:
    """Largest t ≥ 0 with inside + t step ≥ 0 of each positive number, (n,); infinite where there is none."""
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        return np.where(step < 0.0, -inside / step, np.inf)


def cones_to_boundary(inside: FloatArray, mixed: FloatArray, step: FloatArray) -> FloatArray:
    """Largest t ≥ 0 with z + t d in the second-order cone of each pair z, d, (n,); infinite where there is none.

    With D = z_0² − ‖z̄‖² > 0, B = z_0 d_0 − z̄·d̄ and A = d_0² − ‖d̄‖²: t = D / (√(B² − A D) − B) where positive.

    inside, mixed, step : (n,) D, B and A
    """
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        root = np.sqrt(np.maximum(mixed**2 - step * inside, 0.0)) - mixed
        return np.where(root > 0.0, inside / root, np.inf)


class ConeVectors:
    """The half-lines and cones of a cone program, in the order of its rows behind the equations."""

    def __init__(self, sizes: IntArray) -> None:
        self.sizes = sizes
        self.start = starts(sizes)
        self.head = self.start[:-1]
        self.cone_of_row = np.repeat(np.arange(len(sizes)), sizes)
        self.is_head = np.zeros(self.start[-1], dtype=bool)
        self.is_head[self.head] = True

    @classmethod
    def of(cls, program: ConeProgram) -> ConeVectors:
        """Of a cone program."""
        return cls(
            np.concatenate(
                [np.ones(program.n_half_lines), np.full(program.n_cones, 3), np.array(program.further_cones)]
            ).astype(np.int64)
        )

    def products(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """x_0 y_0 − x̄·ȳ of every cone, (n_cones,), of vectors of all cones, (n_entries,)."""
        signed = np.where(self.is_head, 1.0, -1.0) * x * y
        return np.asarray(np.bincount(self.cone_of_row, signed, len(self.sizes)))

    def tails(self, x: FloatArray) -> FloatArray:
        """‖x̄‖ of every cone, (n_cones,), of a vector of all cones, (n_entries,)."""
        return np.asarray(np.sqrt(np.bincount(self.cone_of_row, np.where(self.is_head, 0.0, x**2), len(self.sizes))))

    def pulled_inside(self, z: FloatArray, distance: float, sizes: FloatArray) -> FloatArray:
        """Heads raised until every vector is inside by a distance relative to its size.

        sizes : (n_cones,) what a vector is large beside, where that is less than the largest vector
        """
        inside, tail = z.copy(), self.tails(z)
        largest = max(float(np.abs(z).max(initial=0.0)), 1e-300)
        least = LEAST * np.minimum(largest, sizes)
        inside[self.head] = np.maximum(z[self.head], tail * (1.0 + distance) + least)
        return inside

    def step_to_boundary(self, z: FloatArray, step: FloatArray) -> float:
        """Largest factor with which z + factor step stays inside, infinite where all do; both are (n_entries,)."""
        cones = cones_to_boundary(self.products(z, z), self.products(z, step), self.products(step, step))
        lines = lines_to_boundary(z[self.head], step[self.head])
        return float(np.where(self.sizes == 1, lines, cones).min(initial=np.inf))

    def inverse_hessian(self, z: FloatArray) -> sp.csr_array:
        """Block-diagonal, (n_entries, n_entries), of the barrier −log(z_0² − ‖z̄‖²) at z, (n_entries,)."""
        determinant = np.maximum(self.products(z, z), 0.0)
        reflection = np.where(self.is_head, -0.5, 0.5) * determinant[self.cone_of_row]
        reflection[self.sizes[self.cone_of_row] == 1] = 0.0
        membership = sp.csr_array((z, (np.arange(len(z)), self.cone_of_row)), shape=(len(z), len(self.sizes)))
        return sp.csr_array(membership @ membership.T + sp.diags_array(reflection))

    def root_of_inverse_hessian(self, z: FloatArray) -> sp.csr_array:
        """L, (n_entries, n_entries), block-diagonal and symmetric, with L L the inverse Hessian at z, (n_entries,).

        Of a cone it is [[z_0, z̄ᵀ], [z̄, d I + (z_0 − d) u uᵀ]]/√2 with u = z̄/‖z̄‖ and d² = z_0² − ‖z̄‖².
        """
        half_line, tail = self.sizes == 1, self.tails(z)
        root = np.sqrt(np.maximum(self.products(z, z), 0.0))
        direction = np.where(self.is_head, 0.0, z) / np.maximum(tail, 1e-300)[self.cone_of_row]
        shape = (len(z), len(self.sizes))
        along = sp.csr_array((direction, (np.arange(len(z)), self.cone_of_row)), shape=shape)
        heads = sp.csr_array((np.ones(len(self.sizes)), (self.head, np.arange(len(self.sizes)))), shape=shape)
        more, across = sp.diags_array(z[self.head] - root), sp.diags_array(tail)
        both = sp.diags_array(root[self.cone_of_row]) + heads @ more @ heads.T + along @ more @ along.T
        both = both + heads @ across @ along.T + along @ across @ heads.T
        size = np.where(half_line, 1.0, np.sqrt(0.5))[self.cone_of_row]
        return sp.csr_array(sp.diags_array(size) @ both)
