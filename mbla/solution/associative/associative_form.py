"""The associative program as a cone program in velocities, and how forces and mechanism are read from a solution."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.program.kinematic import ConeProgram, KinematicForm, kinematic_form
from mbla.program.program import Program
from mbla.solution.cone_solvers.cone_solution import ConeSolution
from mbla.solution.proof.static_repair import carried_loads

LIGHT = 1e-2
"""Load of a block, in mean loads, below which its equilibrium has units of its own."""

LIGHTEST = 1e-12
"""Least unit of a block's equilibrium, in mean loads."""


@dataclass(frozen=True)
class AssociativeForm:
    """A cone program whose optimum is the load factor.

    program   : what its forces and velocities are those of
    row_units : (n_rows,) unit of each row of equilibrium in the kinematic form, in mean loads
    """

    program: Program
    kinematic: KinematicForm
    row_units: FloatArray

    @property
    def cone_program(self) -> ConeProgram:
        """The program itself."""
        return self.kinematic.cone_program

    def in_units(self, unit: float) -> ConeProgram:
        """The program with the live power in units of the load factor given."""
        return replace(self.cone_program, rhs=self.cone_program.rhs / unit)

    @property
    def reversed_program(self) -> ConeProgram:
        """The program that finds the least load factor instead, negated."""
        return replace(self.cone_program, rhs=-self.cone_program.rhs)

    def forces(self, solution: ConeSolution) -> FloatArray:
        """Contact forces, (n_points, components)."""
        return self.kinematic.contact_forces(solution.z)

    def load_factor(self, solution: ConeSolution) -> float:
        """That of the dual program, which the forces carry: early in a run it is far from the objective."""
        return -float(solution.z[0])

    def velocities(self, solution: ConeSolution) -> FloatArray:
        """Velocities of the mechanism or of a certificate, those of conditions behind, (n_rows + n_unknowns,)."""
        blocks, unknowns = np.split(self.kinematic.all_velocities(solution.x), [len(self.row_units)])
        return np.concatenate([blocks / self.row_units, unknowns])

    def slacks(self, solution: ConeSolution) -> FloatArray | None:
        """Of the conditions on interfaces, (n_slacks,); None where there are none."""
        conditions = self.program.conditions
        return None if conditions is None else solution.z[len(solution.z) - conditions.cones.shape[0] :]


def associative_form(program: Program) -> AssociativeForm:
    """The program in velocities."""
    return AssociativeForm(program, kinematic_form(program, program.limits), np.ones(len(program.dead_load)))


def in_own_units(program: Program, forces: FloatArray) -> AssociativeForm | None:
    """The form with the equilibrium of lightly loaded blocks in units of what they carry; None without such.

    The solver's tolerance is one for all: a block that carries a hundred millionth of the others is lost in it.

    forces : (n_points, components) of a first solution, which need not be sharp
    """
    unit = np.clip(carried_loads(program, forces), LIGHTEST, 1.0)
    if not np.any(unit < LIGHT):
        return None
    scaled = replace(
        program,
        equilibrium_matrix=sp.csr_array(sp.diags_array(1.0 / unit) @ program.equilibrium_matrix),
        dead_load=program.dead_load / unit,
        live_load=program.live_load / unit,
    )
    return replace(associative_form(scaled), program=program, row_units=unit)
