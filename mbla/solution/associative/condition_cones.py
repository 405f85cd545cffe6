"""Conditions on the interfaces of a program as its repairs see them: slacks and multipliers, cone by cone."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.solution.cone_solvers.cone_vectors import ConeVectors


@dataclass(frozen=True)
class ConditionCones:
    """A x + C s + f_D + λ f_L = 0 and Cᵀ w in cones, w = (u, ψ).

    moving : the program with the unknowns ψ of its conditions behind the velocities of the blocks
    held   : C, (n_rows + n_unknowns, n_slacks)
    cones  : of the slacks
    """

    moving: Program
    held: sp.csr_array
    cones: ConeVectors

    @classmethod
    def of(cls, program: Program) -> ConditionCones:
        """Of a program, which may have none."""
        n, conditions = len(program.dead_load), program.conditions
        if conditions is None:
            return cls(program, sp.csr_array((n, 0)), ConeVectors(np.zeros(0, dtype=np.int64)))
        held = sp.csr_array(sp.vstack([sp.csr_array((n, conditions.cones.shape[0])), conditions.cones.T]))
        return cls(program.with_own_motions, held, ConeVectors(conditions.cone_sizes))

    @property
    def none(self) -> FloatArray:
        """No slacks, (n_slacks,)."""
        return np.zeros(self.held.shape[1])

    def unbalanced(self, x: FloatArray, s: FloatArray, factor: float) -> FloatArray:
        """What forces, (n_points, components), and slacks, (n_slacks,), leave, (n_rows + n_unknowns,)."""
        program = self.moving
        left = program.equilibrium_matrix @ x.ravel() + program.dead_load + factor * program.live_load
        return np.asarray(left + self.held @ s)

    def with_slacks(self, normal: sp.sparray, metric: sp.csr_array) -> sp.csc_array:
        """A W Aᵀ with C M Cᵀ, (n_rows + n_unknowns,) each way.

        metric : M, (n_slacks, n_slacks)
        """
        return sp.csc_array(normal + self.held @ metric @ self.held.T if self.held.shape[1] else normal)

    def lack(self, z: FloatArray) -> FloatArray:
        """‖z̄‖ − z_0 of every cone, where that is positive, (n_cones,), from (n_slacks,)."""
        return np.maximum(self.cones.tails(z) - z[self.cones.head], 0.0)

    def pulled_inside(self, s: FloatArray, distance: float) -> FloatArray:
        """Slacks, (n_slacks,), strictly inside, by a distance over their size."""
        return self.cones.pulled_inside(s, distance, np.ones(len(self.cones.sizes)))

    def inside_by(self, z: FloatArray, opening: float) -> FloatArray:
        """Multipliers, (n_slacks,), inside by a share of the largest."""
        inside = z.copy()
        most = max(float(np.abs(z).max(initial=0.0)), 1e-150)
        inside[self.cones.head] = np.maximum(z[self.cones.head], self.cones.tails(z) + opening * most)
        return inside

    def inverse_hessian(self, z: FloatArray) -> sp.csr_array:
        """Of the barrier, (n_slacks, n_slacks)."""
        return self.cones.inverse_hessian(z)

    def hessian(self, z: FloatArray) -> sp.csr_array:
        """Of the barrier, (n_slacks, n_slacks): 4/det² times the inverse at the reflection of z, 1/z² of half-lines."""
        cones = self.cones
        of_cone = np.where(cones.sizes == 1, z[cones.head] ** -4.0, 4.0 / cones.products(z, z) ** 2)
        reflected = np.where(cones.is_head, z, -z)
        return sp.csr_array(sp.diags_array(of_cone[cones.cone_of_row]) @ cones.inverse_hessian(reflected))
