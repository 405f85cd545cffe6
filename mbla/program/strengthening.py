"""The cheapest capacities of ties with which a structure carries every load case: one cone program, in velocities.

With the loads q_c = f_D + λ_c f_L of case c at its required load factor, forces x_c of its joints and tensions τ_c::

    min Σ w_j T_j    s.t.  A x_c + C τ_c + q_c = 0,  x_c within its yield conditions,  0 ≤ τ_c ≤ T,  T ≤ T̄

w_j is the cost of a unit of capacity of tie j. Its dual has velocities u_c and elongation rates e_cj; T are the dual
variables of its last rows, which price every candidate::

    max Σ_c [q_c·u_c − dissipation of the joints(u_c)] − Σ T̄_j t_j
    s.t. e_cj ≥ −(Cᵀu_c)_j,  e_cj ≥ 0,  Σ_c e_cj ≤ w_j + t_j,  t_j ≥ 0

Where it has no upper bound no capacities suffice.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.assembly.rigid_bodies import RigidBodies
from mbla.model.model import LoadCase
from mbla.program.assemble import assemble
from mbla.program.kinematic import ConeProgram, KinematicForm, kinematic_form
from mbla.program.program import Program
from mbla.program.reductions.restrict import chosen_limits


@dataclass(frozen=True)
class StrengthenedCase:
    """One load case, non-dimensional, its loads those at the required load factor.

    program    : of the joints, and of the ties that are there; its dead load is q, its live load nothing
    pulls      : (n_rows, k) C, of candidates
    ways       : from the velocities of the program to those of the free blocks, of which guides leave fewer
    """

    program: Program
    pulls: sp.csr_array
    ways: sp.csr_array

    def motion(self, velocities: FloatArray) -> FloatArray:
        """Of all blocks, (n_blocks, 6), for which a unit of power is one of the program, from (n_rows,)."""
        program = self.program
        full = np.zeros((program.facts.n_blocks, 6))
        full[program.facts.free] = (self.ways @ velocities * program.scaling.row).reshape(-1, 6)
        return full


def strengthened_case(
    bodies: RigidBodies, load_case: LoadCase, required: float, first: int, count: int, unit: float
) -> StrengthenedCase:
    """A load case at a load factor.

    bodies : with all candidates among its contacts
    first  : number of the first candidate among the ties of the model; ``count`` of them
    unit   : of force of the program, N
    """
    contacts = bodies.contacts
    program = assemble(bodies.model, contacts, bodies.load_case(load_case), own=False)
    program = program.in_unit_of_force(unit / program.scaling.force)
    ties, n_points = contacts.ties, len(contacts.points)
    rows = np.zeros(0, dtype=np.int64) if ties is None else ties.rows
    points = n_points - len(rows) + np.flatnonzero(rows >= first)
    numbers = rows[rows >= first] - first
    joints = np.setdiff1d(np.arange(n_points), points)
    matrix = sp.csc_array(program.equilibrium_matrix)
    pulls = sp.csc_array((matrix.shape[0], count))
    if len(points):
        place = sp.csr_array((np.ones(len(points)), (np.arange(len(points)), numbers)), shape=(len(points), count))
        pulls = matrix[:, 3 * points] @ place
    own = (3 * joints[:, None] + np.arange(3)).ravel()
    loads = program.dead_load + required / program.scaling.live * program.live_load
    alone = replace(
        program,
        equilibrium_matrix=sp.csr_array(matrix[:, own]),
        limits=chosen_limits(program.limits, joints),
        dead_load=loads,
        live_load=np.zeros_like(loads),
        reduction=None,
    )
    return StrengthenedCase(alone, sp.csr_array(pulls), program.lift.velocities)


@dataclass(frozen=True)
class StrengtheningForm:
    """The cone program of several cases, and how its solution is read.

    forms   : of the joints of each case
    costs   : (k,) w in the unit of the program
    """

    cases: tuple[StrengthenedCase, ...]
    forms: tuple[KinematicForm, ...]
    costs: FloatArray
    cone_program: ConeProgram

    def velocities(self, x: FloatArray) -> list[FloatArray]:
        """Of each case, (n_rows,)."""
        ends = np.cumsum([len(case.program.dead_load) for case in self.cases])
        return np.split(x[: ends[-1]], ends[:-1])

    def capacities(self, z: FloatArray) -> FloatArray:
        """T, (k,), in the unit of force of the program."""
        first = self._coupling
        return np.maximum(z[first : first + len(self.costs)], 0.0)

    def use(self, x: FloatArray) -> FloatArray:
        """Sum of elongations over the cost of each candidate, (k,): 1 where it is worth its cost, less where not."""
        both = zip(self.cases, self.velocities(x), strict=True)
        return np.asarray(sum(np.maximum(-(case.pulls.T @ u), 0.0) for case, u in both) / self.costs)

    def forces(self, z: FloatArray) -> list[FloatArray]:
        """Forces of the joints of each case, (n_points, 3)."""
        found, line, cone = [], 0, self.cone_program.n_half_lines
        for form in self.forms:
            own = form.cone_program
            n = 3 * own.n_cones
            parts = [np.zeros(1), z[line : line + own.n_half_lines], z[cone : cone + n]]
            found.append(form.contact_forces(np.concatenate(parts)))
            line, cone = line + own.n_half_lines, cone + n
        return found

    @property
    def _coupling(self) -> int:
        lines = sum(form.cone_program.n_half_lines for form in self.forms)
        return lines + 2 * len(self.cases) * len(self.costs)


def strengthening_form(cases: Sequence[StrengthenedCase], costs: FloatArray, most: FloatArray) -> StrengtheningForm:
    """The program of all cases.

    costs  : (k,) of a unit of capacity; most : (k,) in the unit of force of the programs, inf without a limit
    """
    n, k, every = len(cases), len(costs), range(len(cases))
    forms = tuple(kinematic_form(case.program, case.program.limits) for case in cases)
    parts = [form.cone_program for form in forms]
    limited, one = np.flatnonzero(np.isfinite(most)), sp.eye_array(k, format="csr")
    sizes = [len(case.program.dead_load) for case in cases]
    local = [part.matrix.shape[1] - size for part, size in zip(parts, sizes, strict=True)]
    own = [sp.csr_array(part.matrix)[1:] for part in parts]  # the first row is the power of the live load
    ends = [part.n_half_lines for part in parts]
    widths = {f"u{c}": sizes[c] for c in every} | {f"e{c}": k for c in every}
    widths |= {"t": len(limited)} | {f"m{c}": local[c] for c in every}
    lines: list[Row] = [{f"u{c}": own[c][: ends[c], : sizes[c]], f"m{c}": own[c][: ends[c], sizes[c] :]} for c in every]
    lines += [{f"u{c}": -sp.csr_array(case.pulls.T), f"e{c}": -one} for c, case in enumerate(cases)]
    lines += [{f"e{c}": -one} for c in every]
    lines += [{f"e{c}": one for c in every} | {"t": -one[:, limited]}]
    lines += [{"t": -sp.eye_array(len(limited), format="csr")}] if len(limited) else []
    cones: list[Row] = [{f"u{c}": own[c][ends[c] :, : sizes[c]], f"m{c}": own[c][ends[c] :, sizes[c] :]} for c in every]
    matrix = _stacked([*lines, *cones], widths)
    cost = [part.cost[:size] for part, size in zip(parts, sizes, strict=True)]
    cost += [np.zeros(n * k), most[limited], *(part.cost[size:] for part, size in zip(parts, sizes, strict=True))]
    rhs, first = np.zeros(matrix.shape[0]), sum(ends) + 2 * n * k
    rhs[first : first + k] = costs
    program = ConeProgram(
        cost=np.concatenate(cost),
        matrix=matrix,
        rhs=rhs,
        n_half_lines=sum(_height(row) for row in lines),
        n_cones=sum(part.n_cones for part in parts),
        n_equations=0,
        n_local=sum(local),
    )
    return StrengtheningForm(tuple(cases), forms, costs, program)


Row = dict[str, sp.csr_array]
"""Blocks of a row of the matrix by the unknowns that they belong to."""


def _height(row: Row) -> int:
    return int(next(iter(row.values())).shape[0])


def _stacked(rows: Sequence[Row], widths: dict[str, int]) -> sp.csc_array:
    """The matrix, with zeros where a row has no block; ``widths`` of the unknowns in their order."""
    blocks = [[row.get(name, sp.csr_array((_height(row), width))) for name, width in widths.items()] for row in rows]
    matrix = sp.csc_array(sp.block_array(blocks))
    matrix.eliminate_zeros()
    matrix.sort_indices()
    return matrix
