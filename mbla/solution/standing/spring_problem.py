"""Weak springs that hold a stress-free assembly, the exact non-associative joint law, and its tangent.

Joints are stress-free where nothing has moved, k_N = 1 and k_T are their stiffnesses, v = Aᵀu their displacements::

    N = −k_N v_N within −f_t ... f_c,    τ = −k_T v_T,    T = τ min(1, (μN + c)/‖τ‖)
    A x(v) + f − κ W u = 0

with a load f and springs κ W, W the sizes of the blocks' loads. All of it is homogeneous: only k_T/k_N, and κ over k_N,
matter. The law and its tangent, which is not symmetric, are those of ``joint_law`` for the trial forces −k_N v_N, τ.
"""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.program.yield_conditions.limits import YieldLimits
from mbla.solution.linear_algebra.block_products import block_diagonal
from mbla.solution.linear_algebra.stiffness import Stiffness, stiffness_of
from mbla.solution.nonassociative.joint_law import JointState, joint_state, joint_tangents

BALANCED = 1e-9
"""Unbalanced force of a block, over its own load, that counts as equilibrium."""

NEARLY = 0.3
"""Share of what the springs carry that may be left unbalanced in a state that is only on the way: the next one, on
springs a tenth as strong, changes by ten times as much. Of 97 factorisations for a house of 1,105 blocks 30 went."""

DISPLACEMENT_ROUNDING = 64 * np.finfo(float).eps
"""Unbalanced force, per unit of the largest displacement, that rounding leaves: falling blocks go as far as 1/κ."""

PATTERN_FROM = 8
"""Tangents after which the pattern is determined: that takes as long as some two of them by products of sparse
matrices, each of which then takes three quarters of the time; many structures settle in six."""


class LatePattern:
    """The pattern of a program's stiffness, found once it pays."""

    def __init__(self, program: Program) -> None:
        self._program = program
        self._tangents = 0
        self._found: Stiffness | None = None

    def next(self) -> Stiffness | None:
        """The pattern for one more tangent; None for the first ones."""
        self._tangents += 1
        if self._found is None and self._tangents > PATTERN_FROM:
            self._found = stiffness_of(self._program)
        return self._found


@dataclass(frozen=True)
class SpringProblem:
    """A load on an assembly that springs hold.

    equilibrium_matrix : A, (n_rows, components n_points)
    load               : f, (n_rows,)
    springs            : W, (n_rows, n_rows), and the size of the load that it gives each row, (n_rows,)
    deadline           : time.monotonic() at which to stop, or None
    shear_stiffness    : k_T, with k_N = 1
    pattern            : of A C Aᵀ, for springs that are diagonal; None: products of sparse matrices each time
    on_the_way         : states are wanted ``NEARLY`` balanced only
    """

    equilibrium_matrix: sp.csr_array
    transpose: sp.csr_array
    load: FloatArray
    limits: YieldLimits
    springs: sp.csr_array
    sizes: FloatArray
    components: int
    deadline: float | None
    shear_stiffness: float = 1.0
    pattern: LatePattern | None = None
    on_the_way: bool = False

    @property
    def stiffnesses(self) -> FloatArray:
        """Stiffness of a point, k_N and then k_T for each tangent, of shape (components,)."""
        return np.append(1.0, np.full(self.components - 1, self.shear_stiffness))

    @property
    def late(self) -> bool:
        """Whether the time is up."""
        return self.deadline is not None and time.monotonic() > self.deadline


def spring_problem(
    equilibrium_matrix: sp.csr_array,
    load: FloatArray,
    limits: YieldLimits,
    springs: sp.csr_array,
    deadline: float | None,
) -> SpringProblem:
    """A problem with joints as stiff in shear as in compression.

    equilibrium_matrix : A, (n_rows, components n_points)
    load               : f, (n_rows,)
    springs            : W, (n_rows, n_rows)
    deadline           : time.monotonic() at which to stop, or None
    """
    components = equilibrium_matrix.shape[1] // max(len(limits.friction), 1) or 3
    return SpringProblem(
        equilibrium_matrix=equilibrium_matrix,
        transpose=sp.csr_array(equilibrium_matrix.T),
        load=load,
        limits=limits,
        springs=springs,
        sizes=springs.diagonal(),
        components=components,
        deadline=deadline,
    )


@dataclass(frozen=True)
class Joints:
    """Joints on their law, and unbalanced forces, (n_rows,)."""

    state: JointState
    unbalanced: FloatArray


def balanced(problem: SpringProblem, kappa: float, u: FloatArray, joints: Joints) -> bool:
    """Whether the joints and the springs balance the load of every block.

    u : (n_rows,) displacements
    """
    furthest = float(np.abs(u).max(initial=0.0))
    share = max(BALANCED, NEARLY * kappa * furthest) if problem.on_the_way else BALANCED
    return bool(
        np.all(np.abs(joints.unbalanced) <= np.maximum(share * problem.sizes, DISPLACEMENT_ROUNDING * furthest))
    )


def joints_at(problem: SpringProblem, kappa: float, u: FloatArray) -> Joints:
    """State of the joints at displacements u, (n_rows,)."""
    trial = -(problem.transpose @ u).reshape(-1, problem.components) * problem.stiffnesses
    state = joint_state(problem.limits, trial)
    unbalanced = problem.equilibrium_matrix @ state.forces.ravel() + problem.load - kappa * (problem.springs @ u)
    return Joints(state, unbalanced)


def stiffness_at(problem: SpringProblem, kappa: float, joints: Joints) -> sp.csc_matrix:
    """A C Aᵀ + κ W, (n_rows, n_rows)."""
    diagonal = block_diagonal(joint_stiffness(problem, joints))
    return sp.csc_matrix(problem.equilibrium_matrix @ diagonal @ problem.transpose + kappa * problem.springs)


def joint_stiffness(problem: SpringProblem, joints: Joints) -> FloatArray:
    """C = −dx/dv of every joint, (n_points, components, components)."""
    return joint_tangents(problem.limits.friction, joints.state) * problem.stiffnesses
