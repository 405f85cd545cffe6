"""The way back from a program to a larger one that it was reduced from: u = U q for velocities, x = P y for forces.

However many reductions lie between, their ways are one: that of a further reduction, u = S q and x = R y, is U S, P R.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray

if TYPE_CHECKING:
    from mbla.program.program import Program


@dataclass(frozen=True)
class Lift:
    """From the unknowns of a program to those of the larger one.

    full       : the larger program
    velocities : U, (n_rows of it, n_rows)
    forces     : P, (components n_points of it, components n_points)
    components : of a force of the program
    """

    full: Program
    velocities: sp.csr_array
    forces: sp.csr_array
    components: int

    @staticmethod
    def identity(program: Program) -> Lift:
        """From a program to itself."""
        return Lift.after(None, program, None, None, program.components)

    @staticmethod
    def after(
        before: Lift | None,
        program: Program,
        velocities: sp.csr_array | None,
        forces: sp.csr_array | None,
        components: int,
    ) -> Lift:
        """From a reduction of a program with a way back of its own, None for none.

        velocities : S, (n_rows, n_new_rows); forces : R, (components n_points, new components times new points); None
                     where it leaves these unknowns as they are
        components : of a force of the reduction
        """
        if before is not None:
            velocities = before.velocities if velocities is None else before.velocities @ velocities
            forces = before.forces if forces is None else before.forces @ forces
        if velocities is None:
            velocities = sp.eye_array(len(program.dead_load), format="csr")
        if forces is None:
            forces = sp.eye_array(program.components * program.n_points, format="csr")
        full = program if before is None else before.full
        return Lift(full, sp.csr_array(velocities), sp.csr_array(forces), components)

    def motion(self, velocities: FloatArray) -> FloatArray:
        """Velocities of the larger program, or loads that do work in these, from those of the program, (n_rows,)."""
        return np.asarray(self.velocities @ velocities)

    def motion_within(self, motion: FloatArray) -> FloatArray:
        """The way back from ``motion``: as near to it as velocities of the program come, (n_rows,)."""
        lengths = np.asarray(self.velocities.power(2).sum(axis=0))  # orthogonal, and of length 1 but for units of force
        return np.asarray(self.velocities.T @ motion) / np.maximum(lengths, 1e-300)

    def contact_forces(self, forces: FloatArray) -> FloatArray:
        """Forces of the larger program, (n_points of it, its components), from (n_points, components)."""
        return np.asarray((self.forces @ forces.ravel()).reshape(-1, self.full.components))

    @property
    def normal_forces(self) -> sp.csr_array:
        """P of the normal forces alone, (n_points of the larger program, n_points)."""
        return sp.csr_array(self.forces[:: self.full.components][:, :: self.components])

    def stiffness(self, stiffness: FloatArray) -> FloatArray:
        """Of the points of the larger program, each with its share of the force, from that of the points, (n_points,).

        Points of one share move alike: the velocity of the reduced one is the sum of theirs, each times its share.
        """
        shares = abs(self.normal_forces)
        return np.asarray(shares @ (np.asarray(shares.sum(axis=0)).ravel() * stiffness))
