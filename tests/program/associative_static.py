"""The static form of the associative program: forces as unknowns, an independent check of the kinematic form.

::

    max λ   s.t.   A x + f_D + λ f_L = 0,   ‖T‖ ≤ c + μ N,   −f_t ≤ N ≤ f_c

Unknowns are the contact forces, without shear where a joint carries none, and λ. The dual variables of equilibrium are
the velocities, with live load power 1. Forces are large against the loads that they balance, so that the same tolerance
of the solver leaves a larger error of λ than in the kinematic form (:mod:`mbla.program.kinematic`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.program.kinematic import ConeProgram
from mbla.program.program import Program
from mbla.program.yield_conditions import Crushing, TensionCutOff


@dataclass(frozen=True)
class AssociativeStaticForm:
    """The cone program of a program in forces and load factor, and how to read its solution.

    columns : which components of the contact forces are unknowns
    """

    program: Program
    columns: IntArray
    cone_program: ConeProgram

    def contact_forces(self, x: FloatArray) -> FloatArray:
        """Non-dimensional contact forces, (n_points, components)."""
        forces = np.zeros(self.program.n_points * self.program.components)
        forces[self.columns] = x[:-1]
        return forces.reshape(-1, self.program.components)

    def velocities(self, z: FloatArray) -> FloatArray:
        """Non-dimensional velocities of the free blocks from the dual variables, (n_rows,)."""
        return z[: len(self.program.dead_load)]


def associative_static_form(program: Program) -> AssociativeStaticForm:
    """The program in forces; its objective is −λ."""
    limits, c, planar = program.limits, program.components, program.components == 2
    shears = (limits.friction > 0) | (limits.cohesion > 0)
    used = np.ones((program.n_points, c), dtype=bool)
    used[:, 1:] = shears[:, None]
    columns = np.flatnonzero(used.ravel())
    half_lines, room = _normal_rows(program)
    shear, limit = _shear_rows(program, np.flatnonzero(shears))
    forces = sp.csc_array(sp.vstack([program.equilibrium_matrix, -half_lines, -shear]))[:, columns]
    load = np.concatenate([program.live_load, np.zeros(forces.shape[0] - len(program.live_load))])
    matrix = sp.csc_array(sp.hstack([forces, sp.csr_array(load[:, None])]))
    matrix.eliminate_zeros()
    cone_program = ConeProgram(
        cost=np.append(np.zeros(len(columns)), -1.0),
        matrix=matrix,
        rhs=np.concatenate([-program.dead_load, room, limit]),
        n_half_lines=len(room) + (len(limit) if planar else 0),
        n_cones=0 if planar else int(shears.sum()),
        n_equations=len(program.dead_load),
    )
    return AssociativeStaticForm(program, columns, cone_program)


def _normal_rows(program: Program) -> tuple[sp.csr_array, FloatArray]:
    """Rows and offsets of N + f_t ≥ 0 and f_c − N ≥ 0 where these do not follow from the others."""
    limits = program.limits
    normal = sp.eye_array(program.components * program.n_points, format="csr")[:: program.components]
    crushable = np.flatnonzero(Crushing.applies(limits))
    cut_off = np.flatnonzero(TensionCutOff.applies(limits))
    rows = sp.csr_array(sp.vstack([normal[cut_off], -normal[crushable]]))
    return rows, np.concatenate([limits.tension[cut_off], limits.compression[crushable]])


def _shear_rows(program: Program, points: IntArray) -> tuple[sp.csr_array, FloatArray]:
    """Rows and offsets of c + μ N ≥ ‖T‖ at the points: (c + μ N, T) for cones, c + μ N ± T in a plane."""
    c, n = program.components, len(points)
    friction, cohesion = program.limits.friction[points], program.limits.cohesion[points]
    values = np.column_stack([friction, np.ones((n, c - 1))]).ravel()
    columns = (c * points[:, None] + np.arange(c)).ravel()
    if c == 3:
        rows = sp.csr_array((values, (np.arange(c * n), columns)), shape=(c * n, c * program.n_points))
        return rows, np.column_stack([cohesion, np.zeros((n, c - 1))]).ravel()
    sides = [
        sp.csr_array((values * sign, (np.arange(n).repeat(2), columns)), shape=(n, 2 * program.n_points))
        for sign in (np.tile([1.0, 1.0], n), np.tile([1.0, -1.0], n))
    ]
    return sp.csr_array(sp.vstack(sides)), np.tile(cohesion, 2)
