"""The gravity state as a cone program with the contact forces as unknowns.

The least forces that carry the dead load alone, unique by their distance from none::

    min ½ ‖x‖²     s.t.   A x + f_D = 0,   ‖T‖ ≤ μ N + c,   −f_t ≤ N ≤ f_c
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.program.kinematic import ConeProgram
from mbla.program.program import Program
from mbla.program.yield_conditions import Crushing


@dataclass(frozen=True)
class StaticForm:
    """A cone program in forces, and how to read its solution."""

    program: Program
    cone_program: ConeProgram

    def forces(self, x: FloatArray) -> FloatArray:
        """Contact forces, (n_points, components)."""
        return x.reshape(-1, self.program.components)

    def velocities(self, z: FloatArray) -> FloatArray:
        """Velocities of the free blocks, (n_rows,), from the dual variables of equilibrium."""
        return z[: len(self.program.dead_load)]


def gravity_form(program: Program) -> StaticForm:
    """The least forces that carry the dead load alone."""
    limits, c, size = program.limits, program.components, program.components * program.n_points
    crushable = np.flatnonzero(Crushing.applies(limits))
    normal, unit = c * np.arange(program.n_points), sp.eye_array(size, format="csr")
    lines = sp.vstack([unit[normal], -unit[c * crushable]])
    shear, limit = _shear_limits(program, unit)
    matrix = sp.csc_array(sp.vstack([program.equilibrium_matrix, -lines, -shear]))
    matrix.eliminate_zeros()
    matrix.sort_indices()
    planar = c == 2
    cone_program = ConeProgram(
        cost=np.zeros(size),
        matrix=matrix,
        rhs=np.concatenate([-program.dead_load, limits.tension, limits.compression[crushable], limit]),
        n_half_lines=lines.shape[0] + (len(limit) if planar else 0),
        n_cones=0 if planar else program.n_points,
        n_equations=len(program.dead_load),
        quadratic=np.ones(size),
    )
    return StaticForm(program, cone_program)


def _shear_limits(program: Program, unit: sp.csr_array) -> tuple[sp.csr_array, FloatArray]:
    """Rows and offsets of c + μ N ≥ ‖T‖ at every point: cones, or pairs of half-lines in a plane."""
    limits, c, n = program.limits, program.components, program.n_points
    normal = c * np.arange(n)
    strength = sp.csr_array(sp.diags_array(limits.friction, format="csr") @ unit[normal])
    if c == 2:
        both = sp.csr_array(sp.vstack([strength + unit[normal + 1], strength - unit[normal + 1]]))
        return both, np.tile(limits.cohesion, 2)
    stacked = sp.csr_array(sp.vstack([strength, unit[normal + 1], unit[normal + 2]]))
    rows = stacked[np.arange(3 * n).reshape(3, n).T.ravel()]
    return rows, np.column_stack([limits.cohesion, np.zeros((n, 2))]).ravel()
