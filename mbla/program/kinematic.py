"""The kinematic form as a cone program: few unknowns, and load factors far more accurate than from the static form.

Unknowns are the velocities u of the free blocks and, at points with more than dry friction, the multipliers
p (Coulomb, p ≥ ‖v_T‖) and d ≥ 0 (crushing); the multiplier of the tension cut-off is eliminated::

    min  −f_D·u + Σ [c p + f_t (v_N − μ p + d) + f_c d]
    s.t. f_L·u = 1
         v_N − μ p + d ≥ 0,  d ≥ 0,  ‖v_T‖ ≤ p          points with a tension cut-off (cohesive, or without friction)
         v_N ≥ 0                                         points without friction and cohesion
         ‖v_T‖ ≤ v_N / μ                                 dry points: p = v_N / μ

In a plane ‖v_T‖ ≤ p is v_T ≤ p and −v_T ≤ p, half-lines again, so that the program is linear.

The dual variables of the rows are the contact forces, and −(dual of f_L·u = 1) is the load factor.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.program.program import Program
from mbla.program.yield_conditions import Coulomb, Crushing, TensionCutOff
from mbla.program.yield_conditions.limits import YieldLimits


@dataclass(frozen=True)
class ConeProgram:
    """min cost·x + ½ Σ quadratic x² subject to matrix x + s = rhs.

    s = 0 in the first ``n_equations`` rows, ≥ 0 in the next ``n_half_lines``, in cones of dimension 3 in the next
    3 ``n_cones``, and in cones of the dimensions ``further_cones`` in the rest, 1 being a half-line. The last
    ``n_local`` unknowns each belong to one contact point and to no equation.
    """

    cost: FloatArray
    matrix: sp.csc_array
    rhs: FloatArray
    n_half_lines: int
    n_cones: int
    n_equations: int = 1
    quadratic: FloatArray | None = None
    further_cones: tuple[int, ...] = ()
    n_local: int = 0


@dataclass(frozen=True)
class PointRows:
    """Which points have which rows and unknowns; the way back from dual variables to contact forces.

    dry       : points with one cone and no multiplier
    frictional: points with a cone and a multiplier p
    cut_off   : points with the half-line of the tension cut-off (frictional points, and those without friction)
    crushing  : points with a multiplier d
    """

    dry: IntArray
    frictional: IntArray
    cut_off: IntArray
    crushing: IntArray


@dataclass(frozen=True)
class KinematicForm:
    """The cone program of a program under given limits, and how to read its solution."""

    program: Program
    limits: YieldLimits
    rows: PointRows
    cone_program: ConeProgram

    def velocities(self, x: FloatArray) -> FloatArray:
        """Non-dimensional velocities of the free blocks, (n_rows,)."""
        return x[: len(self.program.dead_load)]

    def all_velocities(self, x: FloatArray) -> FloatArray:
        """The same with the unknowns of conditions on interfaces behind, (n_rows + n_unknowns,)."""
        n, conditions = len(self.program.dead_load), self.program.conditions
        return x[: n if conditions is None else n + len(conditions.cost)]

    def contact_forces(self, z: FloatArray) -> FloatArray:
        """Non-dimensional contact forces from the dual variables, (n_points, components)."""
        rows, limits = self.rows, self.limits
        forces = np.zeros((self.program.n_points, self.program.components))
        n_dry, n_normal = len(rows.dry), len(rows.cut_off) + len(rows.crushing)
        width = self.program.components  # two half-lines in a plane, a cone of three in space
        shear = z[1 + n_normal : 1 + n_normal + width * (n_dry + len(rows.frictional))].reshape(-1, width)
        if width == 2:
            shear = np.column_stack([shear.sum(axis=1), shear[:, 1] - shear[:, 0]])
        forces[rows.dry, 0] = shear[:n_dry, 0] / limits.friction[rows.dry]
        forces[rows.dry, 1:] = shear[:n_dry, 1:]
        forces[rows.cut_off, 0] = z[1 : 1 + len(rows.cut_off)] - limits.tension[rows.cut_off]
        forces[rows.frictional, 1:] = shear[n_dry:, 1:]
        return forces

    def cost_for(self, limits: YieldLimits) -> FloatArray:
        """Cost vector for other cohesion, tension and compression at the same friction; keeps matrix and rows."""
        return _cost(self.program, limits, self.rows)

    def rhs_for(self, weight: FloatArray, live_power: float = 1.0) -> FloatArray:
        """Right-hand side with which the contact forces are those of max (live power) λ − Σ weight N.

        weight : (n_points,) of the normal forces, 0 or more: a joint may close by so much before it counts as closed
        """
        return _rhs(self.program, self.limits, self.rows, weight, live_power)


def kinematic_form(program: Program, limits: YieldLimits, *, reduce_dry: bool = True) -> KinematicForm:
    """Kinematic form under the given limits, those of the program or modified ones.

    reduce_dry : False keeps the multiplier p at dry points too, so that a later cohesion changes the cost alone
    """
    rows, conditions, moving = _point_rows(limits, reduce_dry), program.conditions, program.with_own_motions
    n_shear = len(rows.dry) + len(rows.frictional)
    matrix, planar = _matrix(moving, limits, rows), program.components == 2
    if conditions is not None:
        matrix = _with_cones(matrix, conditions.cones, len(program.dead_load))
    cone_program = ConeProgram(
        cost=_cost(program, limits, rows),
        matrix=matrix,
        rhs=_rhs(program, limits, rows, np.zeros(program.n_points), 1.0),
        further_cones=() if conditions is None else tuple(conditions.cone_sizes.tolist()),
        n_half_lines=len(rows.cut_off) + len(rows.crushing) + (2 * n_shear if planar else 0),
        n_cones=0 if planar else n_shear,
        n_local=len(rows.frictional) + len(rows.crushing),
    )
    return KinematicForm(program, limits, rows, cone_program)


def _with_cones(matrix: sp.csc_array, cones: sp.csr_array, first: int) -> sp.csc_array:
    """The rows of further cones below a matrix, whose unknowns begin at column ``first``."""
    n_rows, last = cones.shape[0], matrix.shape[1] - first - cones.shape[1]
    below = sp.hstack([sp.csr_array((n_rows, first)), -cones, sp.csr_array((n_rows, last))])
    whole = sp.csc_array(sp.vstack([matrix, below]))
    whole.sort_indices()
    return whole


def _rhs(program: Program, limits: YieldLimits, rows: PointRows, weight: FloatArray, live_power: float) -> FloatArray:
    """``KinematicForm.rhs_for``."""
    dry, width = weight[rows.dry] / limits.friction[rows.dry], program.components
    shear = np.zeros((len(rows.dry) + len(rows.frictional), width))
    shear[: len(dry), : 1 if width == 3 else width] = dry[:, None]
    further = np.zeros(0 if program.conditions is None else program.conditions.cones.shape[0])
    return np.concatenate([[live_power], weight[rows.cut_off], np.zeros(len(rows.crushing)), shear.ravel(), further])


def _point_rows(limits: YieldLimits, reduce_dry: bool) -> PointRows:
    crushing = Crushing.applies(limits)
    no_shear = (limits.friction == 0) & (limits.cohesion == 0)
    cut_off = TensionCutOff.applies(limits) | crushing
    if not reduce_dry:
        cut_off = np.ones_like(cut_off)
        no_shear = np.zeros_like(no_shear)
    return PointRows(
        dry=np.flatnonzero(~cut_off),
        frictional=np.flatnonzero(cut_off & ~no_shear),
        cut_off=np.flatnonzero(cut_off),
        crushing=np.flatnonzero(crushing),
    )


def _matrix(program: Program, limits: YieldLimits, rows: PointRows) -> sp.csc_array:
    """Rows in the order of ``ConeProgram``; rows of cones and half-lines are −G where s = G x."""
    return _below(program.live_load, _rows_of_points(program.equilibrium_matrix, program.components, limits, rows))


def _below(first: FloatArray, matrix: sp.csc_array) -> sp.csc_array:
    """A row, as long as the matrix is wide or shorter, and the matrix below it; no zeros of the row are stored."""
    stored = np.zeros(matrix.shape[1], dtype=bool)
    stored[: len(first)] = first != 0.0
    pointers = matrix.indptr + np.append(0, np.cumsum(stored)).astype(matrix.indptr.dtype)
    top = pointers[:-1][stored]
    rest = np.ones(matrix.nnz + len(top), dtype=bool)
    rest[top] = False
    entries, indices = np.empty(len(rest)), np.zeros(len(rest), dtype=matrix.indices.dtype)
    entries[top], entries[rest] = first[first != 0.0], matrix.data
    indices[rest] = matrix.indices + 1
    return sp.csc_array((entries, indices, pointers), shape=(matrix.shape[0] + 1, matrix.shape[1]))


def _rows_of_points(equilibrium_matrix: sp.csr_array, c: int, limits: YieldLimits, rows: PointRows) -> sp.csc_array:
    """All rows but the first: what the contact points allow, whatever the loads; ``c`` components of force a point."""
    velocity = sp.csr_array(equilibrium_matrix.T)  # rows v_N, v_T1, v_T2 (v_N, v_T) of each point
    n_points = len(limits.friction)
    p_column, d_column = np.full(n_points, -1), np.full(n_points, -1)
    p_column[rows.frictional] = np.arange(len(rows.frictional))
    d_column[rows.crushing] = np.arange(len(rows.crushing))
    n_p, n_d = len(rows.frictional), len(rows.crushing)

    beta = Coulomb.slope(limits)
    cut_off_p = _selection(np.where(p_column[rows.cut_off] >= 0, p_column[rows.cut_off], -1), beta[rows.cut_off], n_p)
    cut_off_d = _selection(d_column[rows.cut_off], np.ones(len(rows.cut_off)), n_d)
    identity_d = sp.eye_array(n_d, format="csr")

    dry_limit = sp.diags_array(1.0 / beta[rows.dry], format="csr") @ velocity[c * rows.dry]
    dry = _shear_rows(dry_limit, velocity, rows.dry, c)
    none = sp.csr_array((n_p, velocity.shape[1]))
    shear = _shear_rows(none, velocity, rows.frictional, c)
    no_velocity = sp.csr_array((velocity.shape[0], n_p))
    of_p = _shear_rows(sp.csr_array(sp.eye_array(n_p, format="csr")), no_velocity, rows.frictional, c)

    blocks: list[list[sp.sparray | None]] = [
        [-velocity[c * rows.cut_off], cut_off_p, -cut_off_d],
        [sp.csr_array((n_d, velocity.shape[1])), None, -identity_d],
        [-dry, sp.csr_array((dry.shape[0], n_p)), sp.csr_array((dry.shape[0], n_d))],
        [-shear, -of_p, None],
    ]
    matrix = sp.csc_array(sp.block_array(blocks))
    matrix.eliminate_zeros()
    matrix.sort_indices()
    return matrix


def _shear_rows(limit: sp.csr_array, velocity: sp.csr_array, points: IntArray, components: int) -> sp.csr_array:
    """Rows of limit ≥ ‖v_T‖ at the given points: (limit, v_T) for cones, limit ∓ v_T in a plane."""
    tangential = [velocity[components * points + axis] for axis in range(1, components)]
    parts = [limit, *tangential] if components == 3 else [limit - tangential[0], limit + tangential[0]]
    stacked = sp.csr_array(sp.vstack(parts))
    return stacked[np.arange(components * len(points)).reshape(components, -1).T.ravel()]


def _selection(columns: IntArray, values: FloatArray, n_columns: int) -> sp.csr_array:
    """One entry a row in the given column; none where the column is −1."""
    present = np.flatnonzero(columns >= 0)
    return sp.csr_array((values[present], (present, columns[present])), shape=(len(columns), n_columns))


def _cost(program: Program, limits: YieldLimits, rows: PointRows) -> FloatArray:
    program = program.with_own_motions
    tension = np.zeros(program.n_points)
    tension[rows.cut_off] = limits.tension[rows.cut_off]
    on_normal = np.zeros((program.n_points, program.components))
    on_normal[:, 0] = tension
    velocity_cost = -program.dead_load + program.equilibrium_matrix @ on_normal.ravel()
    p_cost = limits.cohesion - limits.friction * tension
    d_cost = np.where(np.isinf(limits.compression), 0.0, limits.compression) + tension
    return np.concatenate([velocity_cost, p_cost[rows.frictional], d_cost[rows.crushing]])
