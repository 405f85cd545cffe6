"""Static form of the convex contact model where the limits of friction are given: the motion that they resist least.

    max λ   s.t.   A x + f_D + λ f_L = 0,   −f_t ≤ N,   ‖T‖ ≤ l at the points
                   (R − ½ θ k, T − T', (1 − ½ θ) k) and (V − R, T') in cones,   k ≥ |M_n|/ρ
                   the stress block of every interface that can crush

With l, R and V from the normal forces of other forces, sliding and twisting do not dilate. The dual variables are the
velocities of the blocks, and the motions of the interfaces.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.program.resultants.assemble import ConvexProgram
from mbla.program.resultants.conditions import MN, T1, T2, ConeRows
from mbla.program.resultants.crushing import crushing_cones
from mbla.program.static import StaticForm, gravity_form

LEAST_LIMIT = 1e-12
"""Least radius of a cone of given size, in mean block loads: a cone that is a point has no inside to walk in."""


@dataclass(frozen=True)
class ConvexStaticForm(StaticForm):
    """The cone program, its limits of friction exchanged with ``rhs_for``, and how to read its solution.

    conditions : (n_rows, 6 n_interfaces) the rows of all conditions on resultants
    n_torsion  : how many of them belong to torsion
    """

    convex: ConvexProgram
    conditions: sp.csr_array
    n_torsion: int

    def motions(self, z: FloatArray) -> FloatArray:
        """Motions of the interfaces by torsion and by crushing, (n_interfaces, 2, 6)."""
        duals = z[len(z) - self.conditions.shape[0] :]
        split = self.n_torsion
        torsion = self.conditions[:split].T @ duals[:split]
        crushing = self.conditions[split:].T @ duals[split:]
        return np.stack([torsion.reshape(-1, 6), crushing.reshape(-1, 6)], axis=1)

    def rhs_for(self, limit: FloatArray, share: FloatArray, rest: FloatArray) -> FloatArray:
        """Right-hand side with limits l of the points, (n_points,), and R and V − R of the interfaces, (n_torsion,)."""
        n_points, n, rhs = self.convex.points.n_points, len(share), self.cone_program.rhs.copy()
        first = len(rhs) - self.conditions.shape[0] - 3 * n_points
        rhs[first : first + 3 * n_points : 3] = np.maximum(limit, LEAST_LIMIT)
        first += 3 * n_points
        rhs[first + 2 * n : first + 6 * n : 4] = np.maximum(share, LEAST_LIMIT)
        rhs[first + 6 * n : first + 9 * n : 3] = np.maximum(rest, LEAST_LIMIT)
        return rhs


def given_friction_form(convex: ConvexProgram) -> ConvexStaticForm:
    """The program without friction; its limits come with ``ConvexStaticForm.rhs_for``."""
    program, none, rows = convex.points, np.zeros(convex.points.n_points), ConeRows()
    form = gravity_form(replace(program, limits=replace(program.limits, friction=none, cohesion=none)))
    base, size = form.cone_program, form.expand.shape[1]
    _torsion(convex, rows)
    n_torsion = rows.n_rows
    crushing_cones(convex.crushing, rows)
    conditions = rows.resultants(convex.n_interfaces)
    load = np.append(program.live_load, np.zeros(base.matrix.shape[0] - len(program.live_load)))
    blocks = [
        [base.matrix, sp.csr_array((base.matrix.shape[0], rows.n_helpers)), sp.csr_array(load[:, None])],
        [-(conditions @ convex.resultants), -rows.helpers, None],
    ]
    matrix = sp.csc_array(sp.block_array(blocks))
    matrix.eliminate_zeros()
    matrix.sort_indices()
    cone_program = replace(
        base,
        cost=np.append(np.zeros(size + rows.n_helpers), -1.0),
        matrix=matrix,
        rhs=np.concatenate([base.rhs, rows.constants]),
        quadratic=None,
        further_cones=tuple(rows.cone_sizes.tolist()),
    )
    return ConvexStaticForm(program, form.expand, form.offset, cone_program, convex, conditions, n_torsion)


def _torsion(convex: ConvexProgram, rows: ConeRows) -> None:
    limits = convex.torsion
    n, row, theta = len(limits.interfaces), 6 * limits.interfaces, limits.thetas
    apart = rows.helper(2 * n).reshape(n, 2)
    k = rows.helper(n)
    for sign in (1.0, -1.0):
        twist = rows.take(1, n, np.zeros(n))
        rows.given.add(twist, row + MN, sign / limits.radii)
        rows.helping.add(twist, k, 1.0)
    curve, rest = rows.take(4, n, np.zeros((n, 4))), rows.take(3, n, np.zeros((n, 3)))
    rows.helping.add(curve, k, -0.5 * theta)
    rows.helping.add(curve + 3, k, 1.0 - 0.5 * theta)
    for axis, component in ((0, T1), (1, T2)):
        rows.given.add(curve + 1 + axis, row + component, 1.0)
        rows.helping.add(curve + 1 + axis, apart[:, axis], -1.0)
        rows.helping.add(rest + 1 + axis, apart[:, axis], 1.0)
