"""State of a stress-free assembly that weak springs hold, by the exact non-associative joint law.

Joints are stress-free where nothing has moved, k_N = 1 and k_T are their stiffnesses, v = Aᵀu their displacements::

    N = −k_N v_N within −f_t ... f_c,    τ = −k_T v_T,    T = τ min(1, (μN + c)/‖τ‖)
    A x(v) + f − κ W u = 0

with a load f and springs κ W, W the sizes of the blocks' loads. All of it is homogeneous: only k_T/k_N, and κ over k_N,
matter.

Semismooth Newton (Alart and Curnier 1991, doi:10.1016/0045-7825(91)90022-X) on this, whose tangent is not symmetric::

    −dx/dv:   open 0;   stick diag(k_N, k_T);   slip C_NN = k_N, C_TN = μ k_N θ, C_TT = k_T (l/‖τ‖)(I − θθᵀ), θ = τ/‖τ‖

Where Newton's method fails the limits of shear are held at l = μN + c of the last iterate. What is left is the minimum
of a convex function, which Newton's method with a line search always finds; limits and minima alternate until Newton's
method on the whole law takes over. More friction takes thrust off a joint, and less brings it back: where limits swing
to and fro in this way they move only part of the way to those of the minimum.

Where that does not end either, the assembly moves there in time: dashpots η W act beside the springs, ::

    A x(v) + f − κ W u − η W (u − u_before) = 0

a state on springs κ + η, which is easy where η is large; u_before moves up to u, and η falls from step to step.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import BoolArray, FloatArray
from mbla.program.yield_conditions.limits import YieldLimits
from mbla.solution.linear_algebra.superlu import factors_on_the_diagonal

BALANCED = 1e-9
"""Unbalanced force of a block, over its own load, that counts as equilibrium."""

ROUNDING = 64 * np.finfo(float).eps
"""Unbalanced force, per unit of the largest displacement, that rounding leaves: falling blocks go as far as 1/κ."""

NEWTON_STEPS = 40
BACKTRACKS = 8

MOST_UPHILL = 2
"""Steps in a row of Newton's method that need not come nearer to balance than any before."""

LAGS, TRY_EVERY = 9, 3
"""Times that the limits of shear are brought up to date at one κ; Newton's method is tried after every third."""

LEAST_MOVE = 0.1
"""Least share of their way that limits of shear move: it is halved where they turn back, and grows by half where not.
Limits that swing by −q each time come to rest where the share is below 2/(1 + q)."""

DASHPOT_STEPS, MOST_REFUSED = 60, 20
"""Steps in time at one κ, with those that are not found, and the most of these."""

DASHPOT, STRONGER, WEAKER, TRY_DASHPOTS_EVERY = 1.0, 4.0, 0.3, 4
"""η of the first step; what it is multiplied by where no state is found, and where one is; and the steps after which
Newton's method is tried without dashpots. Of nine walls with openings all were settled with these, two to five with
springs alone."""

CONVEX_STEPS = 30
LINE_STEPS = 20
FLAT = 0.5
"""Share of the slope along a search direction that may be left where a line search ends."""


@dataclass(frozen=True)
class SpringProblem:
    """A load on an assembly that springs hold.

    equilibrium_matrix : A, (n_rows, components n_points)
    load               : f, (n_rows,)
    springs            : W, (n_rows, n_rows), and the size of the load that it gives each row, (n_rows,)
    deadline           : time.monotonic() at which to stop, or None
    shear_stiffness    : k_T, with k_N = 1
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
    """A problem with joints as stiff in shear as in compression."""
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
class _Joints:
    """Joints on their law: trial shear, its norm and limit; whether N follows v_N; forces; unbalanced forces."""

    shear: FloatArray
    size: FloatArray
    limit: FloatArray
    follows: BoolArray
    forces: FloatArray
    unbalanced: FloatArray


def spring_state(problem: SpringProblem, kappa: float, starts: Sequence[FloatArray]) -> FloatArray | None:
    """Displacements, (n_rows,), in equilibrium on springs κ; None where they are not found.

    starts : displacements to start from, of which those nearest to balance are taken
    """
    start = min(starts, key=lambda u: float(np.linalg.norm(_joints(problem, kappa, u, None).unbalanced)))
    found, u = _newton(problem, kappa, start)
    if not found:
        found, u = _by_lagged_limits(problem, kappa, u)
    if not found:
        found, u = _by_dashpots(problem, kappa, u)
    return u if found else None


def _by_lagged_limits(problem: SpringProblem, kappa: float, u: FloatArray) -> tuple[bool, FloatArray]:
    """Minima under limits of shear that follow the normal forces; whether they led there, and the last minimum."""
    limit, share, before = _joints(problem, kappa, u, None).limit, 1.0, np.zeros(len(problem.limits.friction))
    for lag in range(1, LAGS + 1):
        if problem.late:
            break
        u = _convex_minimum(problem, kappa, u, limit)
        misfit = _joints(problem, kappa, u, None).limit - limit
        share = max(0.5 * share, LEAST_MOVE) if misfit @ before < 0.0 else min(1.5 * share, 1.0)
        limit, before = limit + share * misfit, misfit
        if lag % TRY_EVERY == 0:
            found, near = _newton(problem, kappa, u)
            if found:
                return True, near
    return False, u


def _by_dashpots(problem: SpringProblem, kappa: float, u: FloatArray) -> tuple[bool, FloatArray]:
    """Steps in time with ever weaker dashpots; whether they led there, and the last state."""
    eta, steps, refused = DASHPOT, 0, 0
    while steps + refused < DASHPOT_STEPS and refused < MOST_REFUSED and not problem.late:
        held = replace(problem, load=problem.load + eta * (problem.springs @ u))
        found, near = _newton(held, kappa + eta, u)
        if not found:
            eta, refused = STRONGER * eta, refused + 1
            continue
        u, eta, steps = near, WEAKER * eta, steps + 1
        if eta < kappa or steps % TRY_DASHPOTS_EVERY == 0:
            found, near = _newton(problem, kappa, u)
            if found:
                return True, near
    return False, u


def joint_forces(problem: SpringProblem, u: FloatArray) -> FloatArray:
    """Contact forces at displacements u, (n_points, components)."""
    return _joints(problem, 0.0, u, None).forces


def _newton(problem: SpringProblem, kappa: float, u: FloatArray) -> tuple[bool, FloatArray]:
    """Newton's method on the whole law; whether it converged, and the iterate nearest to balance.

    Steps are shortened until they come nearer to balance. At a kink of the law none may: then the shortened step that
    is left nearest is taken all the same, a few times in a row, for on its other side the way often goes on.
    """
    now = _joints(problem, kappa, u, None)
    nearest, least, uphill = u, float(np.linalg.norm(now.unbalanced)), 0
    for _ in range(NEWTON_STEPS):
        if _balanced(problem, u, now):
            return True, u
        step = None if problem.late else _direction(problem, kappa, now, lagged=False)
        if step is None:
            return False, nearest
        u, now = _backtracked(problem, kappa, u, step, float(np.linalg.norm(now.unbalanced)))
        norm = float(np.linalg.norm(now.unbalanced))
        if norm < least:
            nearest, least, uphill = u, norm, 0
        elif (uphill := uphill + 1) > MOST_UPHILL:
            return False, nearest
    return _balanced(problem, u, now), u


def _backtracked(
    problem: SpringProblem, kappa: float, u: FloatArray, step: FloatArray, norm: float
) -> tuple[FloatArray, _Joints]:
    """The first of ever shorter steps that comes nearer to balance, or else the one that comes nearest."""
    size, best = 1.0, (np.inf, u, _joints(problem, kappa, u, None))
    for _ in range(BACKTRACKS):
        trial = _joints(problem, kappa, u + size * step, None)
        here = float(np.linalg.norm(trial.unbalanced))
        if here < best[0]:
            best = (here, u + size * step, trial)
        if here < (1.0 - 1e-4 * size) * norm:
            break
        size *= 0.5
    return best[1], best[2]


def _convex_minimum(problem: SpringProblem, kappa: float, u: FloatArray, limit: FloatArray) -> FloatArray:
    """Equilibrium under given limits of shear, (n_points,), from u; the unbalanced force is the negative gradient."""
    now = _joints(problem, kappa, u, limit)
    for _ in range(CONVEX_STEPS):
        if _balanced(problem, u, now):
            break
        step = _direction(problem, kappa, now, lagged=True)
        if step is None:
            break
        descent = float(now.unbalanced @ step)
        if not descent > 0.0:
            break

        def slope_at(size: float, u: FloatArray = u, step: FloatArray = step) -> float:
            return -float(_joints(problem, kappa, u + size * step, limit).unbalanced @ step)

        u = u + _line_minimum(slope_at, descent) * step
        now = _joints(problem, kappa, u, limit)
    return u


def _line_minimum(slope_at: Callable[[float], float], descent: float) -> float:
    """Size of a step at which a convex function, of slope −descent at zero, is nearly flat; 1 wherever that will do."""
    lower, lower_slope, upper, size = 0.0, -descent, np.inf, 1.0
    for _ in range(LINE_STEPS):
        slope = slope_at(size)
        if slope <= FLAT * descent and (upper == np.inf or slope >= -FLAT * descent):
            break
        if slope > 0.0:
            upper, upper_slope = size, slope
        else:
            lower, lower_slope = size, slope
        share = -lower_slope / (upper_slope - lower_slope)
        size = lower + (upper - lower) * min(max(share, 0.1), 0.9)
    return size


def _balanced(problem: SpringProblem, u: FloatArray, joints: _Joints) -> bool:
    rounding = ROUNDING * float(np.abs(u).max(initial=0.0))
    return bool(np.all(np.abs(joints.unbalanced) <= np.maximum(BALANCED * problem.sizes, rounding)))


def _joints(problem: SpringProblem, kappa: float, u: FloatArray, limit: FloatArray | None) -> _Joints:
    """State of the joints at displacements u, with their own limits of shear or given ones, (n_points,)."""
    limits = problem.limits
    trial = -(problem.transpose @ u).reshape(-1, problem.components)
    normal = np.clip(trial[:, 0], -limits.tension, limits.compression)
    shear = problem.shear_stiffness * trial[:, 1:]
    size = np.linalg.norm(shear, axis=1)
    if limit is None:
        limit = np.maximum(limits.friction * normal + limits.cohesion, 0.0)
    forces = np.column_stack([normal, shear * np.minimum(1.0, limit / np.maximum(size, 1e-300))[:, None]])
    unbalanced = problem.equilibrium_matrix @ forces.ravel() + problem.load - kappa * (problem.springs @ u)
    return _Joints(shear, size, limit, normal == trial[:, 0], forces, unbalanced)


def _direction(problem: SpringProblem, kappa: float, joints: _Joints, *, lagged: bool) -> FloatArray | None:
    """Newton's step, None where the tangent is singular."""
    matrix = _stiffness(problem, kappa, joints, lagged)
    factors = factors_on_the_diagonal(matrix, 0.01)
    if factors is None:
        return None
    step = factors.solve(joints.unbalanced)
    step = step + factors.solve(joints.unbalanced - matrix @ step)  # springs are 1e-12 of the joints
    return step if np.isfinite(step).all() else None


def _stiffness(problem: SpringProblem, kappa: float, joints: _Joints, lagged: bool) -> sp.csc_matrix:
    """A C Aᵀ + κ W."""
    blocks = _joint_stiffness(problem, joints, lagged)
    n, size = len(blocks), problem.components * len(blocks)
    diagonal = sp.csr_array(sp.bsr_array((blocks, np.arange(n), np.arange(n + 1)), shape=(size, size)))
    return sp.csc_matrix(problem.equilibrium_matrix @ diagonal @ problem.transpose + kappa * problem.springs)


def _joint_stiffness(problem: SpringProblem, joints: _Joints, lagged: bool) -> FloatArray:
    """C = −dx/dv of every joint, (n_points, components, components); with limits held where lagged."""
    n, tangents = joints.shear.shape
    slips = joints.size > joints.limit
    direction = joints.shear / np.maximum(joints.size, 1e-300)[:, None]
    share = np.where(slips, joints.limit / np.maximum(joints.size, 1e-300), 1.0)
    across = np.eye(tangents) - np.where(slips, 1.0, 0.0)[:, None, None] * direction[:, :, None] * direction[:, None, :]
    stiffness = np.zeros((n, 1 + tangents, 1 + tangents))
    stiffness[:, 0, 0] = joints.follows
    stiffness[:, 1:, 1:] = problem.shear_stiffness * share[:, None, None] * across
    if not lagged:
        coupled = slips & joints.follows
        stiffness[coupled, 1:, 0] = problem.limits.friction[coupled, None] * direction[coupled]
    return stiffness
