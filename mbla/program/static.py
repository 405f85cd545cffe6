"""The static form with a quadratic term: forces as unknowns, made unique by their distance from given ones.

Two programs of the non-associative scheme have this form, with x_k = (N, T1, T2) at each point::

    gravity state      min  ½ ‖x‖²                      s.t.  A x + f_D = 0,           ‖T‖ ≤ c + μ N
    proximal step      min  ½ ρ ‖x − x̄‖² − λ            s.t.  A x + f_D + λ f_L = 0,   ‖T‖ ≤ l  (l given)

both with −f_t ≤ N ≤ f_c. The dual variables of equilibrium are the velocities of the blocks.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.program.kinematic import ConeProgram
from mbla.program.program import Program

LEAST_LIMIT = 1e-12
"""Least radius of a cone of given size, in mean block loads: a cone that is a point has no inside to walk in."""


@dataclass(frozen=True)
class StaticForm:
    """A cone program in forces, and how to read its solution."""

    program: Program
    cone_program: ConeProgram

    def forces(self, x: FloatArray) -> FloatArray:
        """Contact forces, (n_points, 3)."""
        return x[: 3 * self.program.n_points].reshape(-1, 3)

    def load_factor(self, x: FloatArray) -> float:
        """Load factor of the program; only of a proximal step."""
        return float(x[-1])

    def velocities(self, z: FloatArray) -> FloatArray:
        """Velocities of the free blocks, (6 n_free,)."""
        return z[: len(self.program.dead_load)]


def gravity_form(program: Program) -> StaticForm:
    """The least forces that carry the dead load alone."""
    n = program.n_points
    rows = sp.diags_array(np.column_stack([program.limits.friction, np.ones((n, 2))]).ravel(), format="csr")
    half_lines, room = _normal_limits(program)
    matrix = sp.vstack([program.equilibrium_matrix, -half_lines, -rows])
    cohesion = np.column_stack([program.limits.cohesion, np.zeros((n, 2))]).ravel()
    return StaticForm(
        program,
        ConeProgram(
            cost=np.zeros(3 * n),
            matrix=_tidy(matrix),
            rhs=np.concatenate([-program.dead_load, room, cohesion]),
            n_half_lines=len(room),
            n_cones=n,
            n_equations=len(program.dead_load),
            quadratic=np.ones(3 * n),
        ),
    )


def proximal_form(program: Program, rho: float) -> StaticForm:
    """A proximal step; its anchor and limits come with ``proximal_data``."""
    n = program.n_points
    shear = sp.diags_array(np.tile([0.0, 1.0, 1.0], n), format="csr")
    half_lines, room = _normal_limits(program)
    forces = sp.vstack([program.equilibrium_matrix, -half_lines, -shear])
    n_rows = forces.shape[0] - len(program.dead_load)
    load = np.concatenate([program.live_load, np.zeros(n_rows)])
    matrix = sp.hstack([forces, sp.csr_array(load[:, None])])
    return StaticForm(
        program,
        ConeProgram(
            cost=np.append(np.zeros(3 * n), -1.0),
            matrix=_tidy(matrix),
            rhs=np.concatenate([-program.dead_load, room, np.zeros(3 * n)]),
            n_half_lines=len(room),
            n_cones=n,
            n_equations=len(program.dead_load),
            quadratic=np.append(np.full(3 * n, rho), 0.0),
        ),
    )


def proximal_data(form: StaticForm, rho: float, anchor: FloatArray, limit: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Cost and right-hand side of a proximal step from forces x̄, (n_points, 3), with shear limits l, (n_points,)."""
    rhs = form.cone_program.rhs.copy()
    rhs[len(rhs) - 3 * form.program.n_points :: 3] = np.maximum(limit, LEAST_LIMIT)
    return np.append(-rho * anchor.ravel(), -1.0), rhs


def _normal_limits(program: Program) -> tuple[sp.csr_array, FloatArray]:
    """Rows and offsets of N + f_t ≥ 0 at every point and f_c − N ≥ 0 where the strength is finite."""
    limits = program.limits
    normal = sp.eye_array(3 * program.n_points, format="csr")[::3]
    crushable = np.flatnonzero(np.isfinite(limits.compression))
    rows = sp.csr_array(sp.vstack([normal, -normal[crushable]]))
    return rows, np.concatenate([limits.tension, limits.compression[crushable]])


def _tidy(matrix: sp.sparray) -> sp.csc_array:
    tidy = sp.csc_array(matrix)
    tidy.eliminate_zeros()
    tidy.sort_indices()
    return tidy
