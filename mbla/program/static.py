"""Static forms: cone programs with the contact forces as unknowns.

With a quadratic term forces are unique, by their distance from given ones. Two programs of the non-associative scheme
have this form, with x_k = (N, T1, T2) at each point::

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
        """Contact forces, (n_points, components)."""
        return x[: self.program.components * self.program.n_points].reshape(-1, self.program.components)

    def load_factor(self, x: FloatArray) -> float:
        """Load factor of the program; only of a proximal step."""
        return float(x[-1])

    def velocities(self, z: FloatArray) -> FloatArray:
        """Velocities of the free blocks, (n_rows,)."""
        return z[: len(self.program.dead_load)]


def gravity_form(program: Program) -> StaticForm:
    """The least forces that carry the dead load alone."""
    size = program.components * program.n_points
    half_lines, room = _normal_limits(program)
    shear, limit = _shear_limits(program, program.limits.friction, program.limits.cohesion)
    matrix = sp.vstack([program.equilibrium_matrix, -half_lines, -shear])
    return StaticForm(
        program,
        ConeProgram(
            cost=np.zeros(size),
            matrix=_tidy(matrix),
            rhs=np.concatenate([-program.dead_load, room, limit]),
            n_half_lines=len(room) + (len(limit) if program.components == 2 else 0),
            n_cones=program.n_points if program.components == 3 else 0,
            n_equations=len(program.dead_load),
            quadratic=np.ones(size),
        ),
    )


def proximal_form(program: Program, rho: float) -> StaticForm:
    """A proximal step; its anchor and limits come with ``proximal_data``."""
    size = program.components * program.n_points
    half_lines, room = _normal_limits(program)
    none = np.zeros(program.n_points)
    shear, limit = _shear_limits(program, none, none)
    forces = sp.vstack([program.equilibrium_matrix, -half_lines, -shear])
    n_rows = forces.shape[0] - len(program.dead_load)
    load = np.concatenate([program.live_load, np.zeros(n_rows)])
    matrix = sp.hstack([forces, sp.csr_array(load[:, None])])
    return StaticForm(
        program,
        ConeProgram(
            cost=np.append(np.zeros(size), -1.0),
            matrix=_tidy(matrix),
            rhs=np.concatenate([-program.dead_load, room, limit]),
            n_half_lines=len(room) + (len(limit) if program.components == 2 else 0),
            n_cones=program.n_points if program.components == 3 else 0,
            n_equations=len(program.dead_load),
            quadratic=np.append(np.full(size, rho), 0.0),
        ),
    )


def proximal_data(form: StaticForm, rho: float, anchor: FloatArray, limit: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Cost and right-hand side of a proximal step from forces x̄, (n_points, components), with shear limits l."""
    program, rhs = form.program, form.cone_program.rhs.copy()
    limit = np.maximum(limit, LEAST_LIMIT)
    if program.components == 3:
        rhs[len(rhs) - 3 * program.n_points :: 3] = limit
    else:
        rhs[len(rhs) - 2 * program.n_points :] = np.repeat(limit, 2)
    return np.append(-rho * anchor.ravel(), -1.0), rhs


def _shear_limits(program: Program, slope: FloatArray, offset: FloatArray) -> tuple[sp.csr_array, FloatArray]:
    """Rows and offsets of offset + slope N ≥ ‖T‖: cones of a spatial program, pairs of half-lines of a planar one."""
    n = program.n_points
    if program.components == 3:
        diagonal = sp.diags_array(np.column_stack([slope, np.ones((n, 2))]).ravel(), format="csr")
        return sp.csr_array(diagonal), np.column_stack([offset, np.zeros((n, 2))]).ravel()
    row, point = np.arange(2 * n), np.repeat(np.arange(n), 2)
    sign = np.tile([1.0, -1.0], n)
    entries = (np.concatenate([slope[point], sign]), (np.tile(row, 2), np.concatenate([2 * point, 2 * point + 1])))
    return sp.csr_array(sp.coo_array(entries, shape=(2 * n, 2 * n))), np.repeat(offset, 2)


def _normal_limits(program: Program) -> tuple[sp.csr_array, FloatArray]:
    """Rows and offsets of N + f_t ≥ 0 at every point and f_c − N ≥ 0 where the strength is finite."""
    limits = program.limits
    normal = sp.eye_array(program.components * program.n_points, format="csr")[:: program.components]
    crushable = np.flatnonzero(np.isfinite(limits.compression))
    rows = sp.csr_array(sp.vstack([normal, -normal[crushable]]))
    return rows, np.concatenate([limits.tension, limits.compression[crushable]])


def _tidy(matrix: sp.sparray) -> sp.csc_array:
    tidy = sp.csc_array(matrix)
    tidy.eliminate_zeros()
    tidy.sort_indices()
    return tidy
