"""A proximal step of the convex contact model: forces as unknowns, limits of friction given.

    min ½ ρ ‖x − x̄‖² − λ   s.t.   A x + f_D + λ f_L = 0,   −f_t ≤ N,   ‖T‖ ≤ l at the points
                                   (R − ½ θ k, T − T', (1 − ½ θ) k) and (V − R, T') in cones,   k ≥ |M_n|/ρ
                                   the stress block of every interface that can crush

with l, R and V from the normal forces of x̄, so that sliding and twisting do not dilate. The dual variables are the
velocities of the blocks, and the motions of the interfaces.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.program.kinematic import ConeProgram
from mbla.program.resultants.assemble import ConvexProgram
from mbla.program.resultants.conditions import MN, T1, T2, Entries
from mbla.program.resultants.crushing import RESULTANTS, Corners, Edges
from mbla.program.static import LEAST_LIMIT


@dataclass(frozen=True)
class ConvexStaticForm:
    """The cone program of proximal steps, and how to read its solution.

    conditions : (n_rows, 6 n_interfaces) the rows of all conditions on resultants
    n_torsion  : how many of them belong to torsion
    """

    convex: ConvexProgram
    cone_program: ConeProgram
    conditions: sp.csr_array
    n_torsion: int

    def forces(self, x: FloatArray) -> FloatArray:
        """Contact forces, (n_points, 3)."""
        return x[: 3 * self.convex.points.n_points].reshape(-1, 3)

    def load_factor(self, x: FloatArray) -> float:
        """Load factor of the program."""
        return float(x[-1])

    def velocities(self, z: FloatArray) -> FloatArray:
        """Velocities of the free blocks, (n_block_rows,)."""
        return z[: self.convex.n_block_rows]

    def motions(self, z: FloatArray) -> FloatArray:
        """Motions of the interfaces by torsion and by crushing, (n_interfaces, 2, 6)."""
        duals = z[len(z) - self.conditions.shape[0] :]
        split = self.n_torsion
        torsion = self.conditions[:split].T @ duals[:split]
        crushing = self.conditions[split:].T @ duals[split:]
        return np.stack([torsion.reshape(-1, 6), crushing.reshape(-1, 6)], axis=1)


@dataclass
class _Rows:
    """Rows G r + H y + g in cones, as they come."""

    resultants: Entries
    helpers: Entries
    constants: list[FloatArray]
    sizes: list[IntArray]
    n_rows: int = 0
    n_helpers: int = 0

    def take(self, size: int, count: int, constants: FloatArray) -> IntArray:
        """First rows of ``count`` further cones of one size with constants (count, size)."""
        first = self.n_rows + size * np.arange(count)
        self.n_rows += size * count
        self.constants.append(constants.ravel())
        self.sizes.append(np.full(count, size))
        return first

    def helper(self, count: int) -> IntArray:
        """Further helping unknowns."""
        self.n_helpers += count
        return np.arange(self.n_helpers - count, self.n_helpers)


def convex_proximal_form(convex: ConvexProgram, rho: float) -> ConvexStaticForm:
    """The proximal step; its anchor and limits come with ``convex_proximal_data``."""
    program, limits = convex.points, convex.points.limits
    rows = _Rows(Entries.none(), Entries.none(), [], [])
    _torsion(convex, rows)
    n_torsion = rows.n_rows
    _corners(convex.crushing.corners, rows)
    _edges(convex.crushing.edges, rows)
    n_interfaces, size = convex.resultants.shape[0] // 6, 3 * program.n_points
    conditions = rows.resultants.matrix((rows.n_rows, 6 * n_interfaces))
    helpers = rows.helpers.matrix((rows.n_rows, rows.n_helpers))
    identity = sp.eye_array(size, format="csr")
    crushable = np.flatnonzero(np.isfinite(limits.compression))
    normal = sp.vstack([identity[::3], -identity[3 * crushable]])
    n_normal = normal.shape[0]
    shear = sp.diags_array(np.tile([0.0, 1.0, 1.0], program.n_points), format="csr")
    n_conditions = rows.n_rows
    matrix = sp.block_array(
        [
            [program.equilibrium_matrix, None, sp.csr_array(program.live_load[:, None])],
            [-normal, sp.csr_array((n_normal, rows.n_helpers)), None],
            [-shear, None, None],
            [-(conditions @ convex.resultants), -helpers, sp.csr_array((n_conditions, 1))],
        ]
    )
    room = np.concatenate([limits.tension, limits.compression[crushable]])
    constants = np.concatenate([*rows.constants, np.zeros(0)])
    tidy = sp.csc_array(matrix)
    tidy.eliminate_zeros()
    tidy.sort_indices()
    cone_program = ConeProgram(
        cost=np.append(np.zeros(size + rows.n_helpers), -1.0),
        matrix=tidy,
        rhs=np.concatenate([-program.dead_load, room, np.zeros(size), constants]),
        n_half_lines=n_normal,
        n_cones=program.n_points,
        n_equations=len(program.dead_load),
        quadratic=np.concatenate([np.full(size, rho), np.zeros(rows.n_helpers + 1)]),
        further_cones=tuple(np.concatenate([*rows.sizes, np.zeros(0)]).astype(np.int64).tolist()),
    )
    return ConvexStaticForm(convex, cone_program, conditions, n_torsion)


def convex_proximal_data(
    form: ConvexStaticForm, rho: float, anchor: FloatArray, limit: FloatArray, share: FloatArray, rest: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Cost and right-hand side of a step from forces x̄, (n_points, 3), with limits l, R and V − R."""
    program, rhs = form.convex.points, form.cone_program.rhs.copy()
    first = len(rhs) - form.conditions.shape[0] - 3 * program.n_points
    rhs[first : first + 3 * program.n_points : 3] = np.maximum(limit, LEAST_LIMIT)
    first += 3 * program.n_points
    n = len(share)
    rhs[first + 2 * n : first + 6 * n : 4] = np.maximum(share, LEAST_LIMIT)
    rhs[first + 6 * n : first + 9 * n : 3] = np.maximum(rest, LEAST_LIMIT)
    cost = form.cone_program.cost.copy()
    cost[: anchor.size] = -rho * anchor.ravel()
    return cost, rhs


def _torsion(convex: ConvexProgram, rows: _Rows) -> None:
    limits = convex.torsion
    n, row, theta = len(limits.interfaces), 6 * limits.interfaces, limits.thetas
    apart = rows.helper(2 * n).reshape(n, 2)
    k = rows.helper(n)
    for sign in (1.0, -1.0):
        twist = rows.take(1, n, np.zeros(n))
        rows.resultants.add(twist, row + MN, sign / limits.radii)
        rows.helpers.add(twist, k, 1.0)
    curve, rest = rows.take(4, n, np.zeros((n, 4))), rows.take(3, n, np.zeros((n, 3)))
    rows.helpers.add(curve, k, -0.5 * theta)
    rows.helpers.add(curve + 3, k, 1.0 - 0.5 * theta)
    for axis, component in ((0, T1), (1, T2)):
        rows.resultants.add(curve + 1 + axis, row + component, 1.0)
        rows.helpers.add(curve + 1 + axis, apart[:, axis], -1.0)
        rows.helpers.add(rest + 1 + axis, apart[:, axis], 1.0)


def _corners(corners: Corners, rows: _Rows) -> None:
    """Bounds of Q;  (L + 1, L − 1, 2 g);  (φ(g + h), φ(g − h), 2 L);  (Q_1 + Q_2, Q_1 − Q_2, 2 h)."""
    n, owner = len(corners.interfaces), corners.owner
    phi = corners.strength**0.25
    g, h, q = rows.helper(n), rows.helper(n), rows.helper(2 * n).reshape(n, 2)
    bound = rows.take(1, len(owner), corners.bounds[:, 0])
    _add_forms(rows.resultants, bound, corners.interfaces[owner], corners.bounds)
    rows.helpers.add(bound, q[owner, corners.side], -1.0)
    lead = corners.lead[:, 0]
    alpha = rows.take(3, n, np.column_stack([lead + 1.0, lead - 1.0, np.zeros(n)]))
    beta = rows.take(3, n, np.column_stack([np.zeros((n, 2)), 2.0 * lead]))
    gamma = rows.take(3, n, np.zeros((n, 3)))
    for place, factor in ((alpha, 1.0), (alpha + 1, 1.0), (beta + 2, 2.0)):
        _add_forms(rows.resultants, place, corners.interfaces, factor * corners.lead)
    rows.helpers.add(alpha + 2, g, 2.0)
    for row, sign in ((0, 1.0), (1, -1.0)):
        rows.helpers.add(beta + row, g, phi)
        rows.helpers.add(beta + row, h, sign * phi)
        rows.helpers.add(gamma + row, q[:, 0], 1.0)
        rows.helpers.add(gamma + row, q[:, 1], sign)
    rows.helpers.add(gamma + 2, h, 2.0)


def _edges(edges: Edges, rows: _Rows) -> None:
    place = rows.take(4, len(edges.interfaces), edges.cones[:, :, 0])
    forms = edges.cones.reshape(-1, 4)
    _add_forms(rows.resultants, (place[:, None] + np.arange(4)).ravel(), np.repeat(edges.interfaces, 4), forms)


def _add_forms(resultants: Entries, row: IntArray, interface: IntArray, forms: FloatArray) -> None:
    """Rows G r of linear forms, (n, 4); their constants come with ``take``."""
    for place, resultant in enumerate(RESULTANTS, start=1):
        resultants.add(row, 6 * interface + resultant, forms[:, place])
