"""The static form of the associative program: forces as unknowns, an independent check of the kinematic form.

::

    max λ   s.t.   A x + f_D + λ f_L = 0,   ‖T‖ ≤ c + μ N,   −f_t ≤ N ≤ f_c

Unknowns are the contact forces, without shear where a joint carries none, and λ. The dual variables of equilibrium are
the velocities, with live load power 1. Forces are large against the loads that they balance, so that the same tolerance
of the solver leaves a larger error of λ than in the kinematic form (:mod:`mbla.program.kinematic`).

Where directions g_i bound shear instead of a cone (p ≥ g_i·v_T), −T, which opposes sliding, lies in c + μ N times their
hull: one half-line −n_j·T ≤ c + μ N for each side of the hull, n_j·g = 1 at the two corners of the side.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.program.kinematic import PLANAR_FACETS, ConeProgram
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


def associative_static_form(program: Program, facets: FloatArray | None = None) -> AssociativeStaticForm:
    """The program in forces; its objective is −λ.

    facets : (n_facets, components − 1) directions that bound shear, as in ``kinematic_form``; None for cones
    """
    facets = PLANAR_FACETS if program.components == 2 else facets
    limits, c = program.limits, program.components
    shears = (limits.friction > 0) | (limits.cohesion > 0)
    used = np.ones((program.n_points, c), dtype=bool)
    used[:, 1:] = shears[:, None]
    columns = np.flatnonzero(used.ravel())
    half_lines, room = _normal_rows(program)
    shear, limit = _shear_rows(program, np.flatnonzero(shears), facets)
    forces = sp.csc_array(sp.vstack([program.equilibrium_matrix, -half_lines, -shear]))[:, columns]
    load = np.concatenate([program.live_load, np.zeros(forces.shape[0] - len(program.live_load))])
    matrix = sp.csc_array(sp.hstack([forces, sp.csr_array(load[:, None])]))
    matrix.eliminate_zeros()
    cone_program = ConeProgram(
        cost=np.append(np.zeros(len(columns)), -1.0),
        matrix=matrix,
        rhs=np.concatenate([-program.dead_load, room, limit]),
        n_half_lines=len(room) + (0 if facets is None else len(limit)),
        n_cones=int(shears.sum()) if facets is None else 0,
        n_equations=len(program.dead_load),
    )
    return AssociativeStaticForm(program, columns, cone_program)


def polygon_sides(corners: FloatArray) -> FloatArray:
    """Normals n_j of the sides of the hull of directions about the origin, n_j·T ≤ 1 inside, (n, components − 1).

    corners : (n, 2) counter-clockwise, or (2, 1): the two ends of a segment
    """
    if corners.shape[1] == 1:
        return 1.0 / corners
    following = np.roll(corners, -1, axis=0)
    turn = corners[:, 0] * following[:, 1] - corners[:, 1] * following[:, 0]
    edge = following - corners
    return np.column_stack([edge[:, 1], -edge[:, 0]]) / turn[:, None]


def _normal_rows(program: Program) -> tuple[sp.csr_array, FloatArray]:
    """Rows and offsets of N + f_t ≥ 0 and f_c − N ≥ 0 where these do not follow from the others."""
    limits = program.limits
    normal = sp.eye_array(program.components * program.n_points, format="csr")[:: program.components]
    crushable = np.flatnonzero(Crushing.applies(limits))
    cut_off = np.flatnonzero(TensionCutOff.applies(limits))
    rows = sp.csr_array(sp.vstack([normal[cut_off], -normal[crushable]]))
    return rows, np.concatenate([limits.tension[cut_off], limits.compression[crushable]])


def _shear_rows(program: Program, points: IntArray, facets: FloatArray | None) -> tuple[sp.csr_array, FloatArray]:
    """Rows and offsets of c + μ N ≥ ‖T‖ at the points: (c + μ N, T) for cones, c + μ N + n_j·T for each side."""
    c, n = program.components, len(points)
    friction, cohesion = program.limits.friction[points], program.limits.cohesion[points]
    if facets is None:
        values = np.column_stack([friction, np.ones((n, c - 1))]).ravel()
        columns = (c * points[:, None] + np.arange(c)).ravel()
        rows = sp.csr_array((values, (np.arange(c * n), columns)), shape=(c * n, c * program.n_points))
        return rows, np.column_stack([cohesion, np.zeros((n, c - 1))]).ravel()
    sides = polygon_sides(facets)
    m = len(sides)
    values = np.empty((n, m, c))
    values[:, :, 0] = friction[:, None]
    values[:, :, 1:] = sides
    columns = np.broadcast_to((c * points[:, None] + np.arange(c))[:, None, :], values.shape)
    row = np.broadcast_to(np.arange(n * m).reshape(n, m, 1), values.shape)
    rows = sp.csr_array((values.ravel(), (row.ravel(), columns.ravel())), shape=(n * m, c * program.n_points))
    return rows, np.repeat(cohesion, m)
