"""Forces repaired so that they prove a load factor at or below the collapse value.

Forces in equilibrium with λ and within the yield conditions do. The solver's forces are inside their cones but balance
the loads only to its tolerance. They are corrected in the metric of the cones' own barrier, so that a force near the
border of its cone moves little: the least Δ in

    A Δx + f_L Δλ = −(A x + f_D + λ f_L),    weighted by the barrier's Hessian at x

stays inside all cones if it is short (Dikin's ellipsoid; Nesterov and Nemirovskii 1994, theorem 2.1.1). It is found by
normal equations, or by an augmented system where these have no digits left.

Conditions on interfaces are further cones: their slacks s stand beside the forces, in balance in the rows of their
unknowns ψ (:mod:`mbla.program.conditions`).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.process.stopwatch import stage
from mbla.program.program import Program
from mbla.program.yield_conditions import YieldLimits, yield_violation
from mbla.solution.associative.condition_cones import ConditionCones
from mbla.solution.linear_algebra.block_products import block_diagonal
from mbla.solution.linear_algebra.bordered_system import PROGRESS, ROUNDS, bordered_solver
from mbla.solution.proof.augmented_step import augmented_solver
from mbla.solution.proof.metrics import force_blocks, force_metric, roots

EQUILIBRIUM_TOLERANCE = 1e-9
"""Residual, relative to the mean load of a block, that counts as equilibrium: where all joints of a sliding plane are
on their cones at once, double precision does not get far below 1e-10."""

BALANCED = 1e-13
"""Residual at which no repair is needed."""

INSIDE = 1e-13
"""Excess over a yield condition, relative to the mean load of a block, that is rounding."""

FORCE_ROUNDING = 16 * np.finfo(float).eps
"""Share of the largest force that is rounding in a yield condition or in equilibrium: joints of a strength of millions
of block loads bear forces of which no more digits are left."""

RUNAWAY = 1e9
"""Growth of the forces that is no repair any more."""

MARGIN = 1e-12
"""Share of the largest normal force, or of what a light block has to balance, by which forces are put inside."""

NO_FORCE = 1e-18
"""Share of the largest force below which a normal force counts as zero next to a shear."""

STEEP = 10.0
"""Friction up to which the metric follows the cone: beyond it shear could move so much more freely than normal force
that nothing is left of the latter in double precision."""


@stage("repair")
def repaired_forces(
    program: Program, forces: FloatArray, load_factor: float, slacks: FloatArray | None = None
) -> tuple[FloatArray, float] | None:
    """Forces near the given ones that balance the loads within all conditions, and the load factor they carry.

    forces : (n_points, components), non-dimensional as ``program``, like the load factor. None where no repair is found
    slacks : (n_slacks,) of the conditions on interfaces, where the program has such: without them there is none
    """
    if slacks is None and program.conditions is not None:
        return None
    none = np.zeros(0)
    best, least = _repaired(program, _Forces(forces, none if slacks is None else slacks, load_factor), NORMAL)
    if slacks is None:
        return best
    for share in NEGLIGIBLE:
        if least <= GOOD_EQUILIBRIUM:
            break
        found = _by_what_counts(program, _Forces(forces, slacks, load_factor), share)
        best, least = min((best, least), found, key=lambda each: each[1])
    return best


def _by_what_counts(program: Program, given: _Forces, share: float) -> tuple[tuple[FloatArray, float] | None, float]:
    """The repair without the points whose normal force is below a share of the largest, by the augmented system.

    Interfaces without force are at the apex of their conditions, where nothing is left of the digits of their slacks.
    """
    normal, c = np.abs(given.x[:, 0]), program.components
    kept = normal >= share * normal.max(initial=0.0)
    if kept.all():
        best, least = _repaired(program, given, AUGMENTED)
        return best, least
    assert program.conditions is not None
    numbers = np.flatnonzero(np.repeat(kept, c))
    conditions, rows = program.conditions.of_points(numbers)
    limits = YieldLimits(**{name: values[kept] for name, values in vars(program.limits).items()})
    matrix = sp.csr_array(program.equilibrium_matrix[:, numbers])
    less = replace(program, equilibrium_matrix=matrix, limits=limits, conditions=conditions, reduction=None)
    best, least = _repaired(less, _Forces(given.x[kept], given.s[rows], given.factor), AUGMENTED)
    if best is None:
        return None, np.inf
    forces = np.zeros_like(given.x)
    forces[kept] = best[0]
    return (forces, best[1]), least


@dataclass(frozen=True)
class _Forces:
    """Forces x, (n_points, components), slacks s, (n_slacks,), and load factor; or changes of these."""

    x: FloatArray
    s: FloatArray
    factor: float

    def plus(self, change: _Forces, share: float = 1.0) -> _Forces:
        return _Forces(self.x + share * change.x, self.s + share * change.s, self.factor + share * change.factor)

    @property
    def rounding(self) -> float:
        return FORCE_ROUNDING * max(float(np.abs(self.x).max(initial=0.0)), float(np.abs(self.s).max(initial=0.0)))


@dataclass(frozen=True)
class _Way:
    """How steps are found.

    rounds    : of them at most
    distance  : from the border of its cone, over its size, that a slack is moved to before
    augmented : by the augmented system, and no further than slacks stay inside
    """

    rounds: int
    distance: float
    augmented: bool


NORMAL, AUGMENTED = _Way(ROUNDS, 1e-10, augmented=False), _Way(12, 1e-13, augmented=True)

GOOD_EQUILIBRIUM = 1e-11
"""Residual at which no other way is tried where there are conditions on interfaces: near the apex of these an interface
is beyond what it carries by many times what is unbalanced."""

NEGLIGIBLE = (0.0, 1e-9, 1e-7)
"""Shares of the largest normal force below which points are left out, in turn."""

BORDER = 0.999
"""Share of the way to the border of a cone that a step goes."""


def _repaired(program: Program, given: _Forces, way: _Way) -> tuple[tuple[FloatArray, float] | None, float]:
    """The best forces and load factor, and what they leave unbalanced; None and infinity without."""
    further, now, best, least = ConditionCones.of(program), given, None, np.inf
    for _ in range(way.rounds + 1):
        off = float(np.abs(further.unbalanced(now.x, now.s, now.factor)).max(initial=0.0))
        excess = max(
            float(yield_violation(now.x, program.limits).max(initial=0.0)), further.lack(now.s).max(initial=0.0)
        )
        if excess <= max(INSIDE, now.rounding) and off <= min(least, max(EQUILIBRIUM_TOLERANCE, now.rounding)):
            enough = off <= max(BALANCED, now.rounding) or off > PROGRESS * least
            best, least = (now.x, now.factor), off
            if enough:
                break
        now = _Forces(_pulled_inside(program, now.x), further.pulled_inside(now.s, way.distance), now.factor)
        step = _static_correction(program, further, now, way)
        if step is None:
            break
        longest = BORDER * further.cones.step_to_boundary(now.s, step.s) if way.augmented else 1.0
        now = now.plus(step, min(1.0, longest))
        if np.abs(now.x).max(initial=0.0) > RUNAWAY * (1.0 + np.abs(given.x).max(initial=0.0)):
            break
    return best, least


def carried_loads(program: Program, x: FloatArray) -> FloatArray:
    """Size of what each row of equilibrium has to balance: contact forces, counted without sign, and dead load."""
    sizes = np.repeat(np.linalg.norm(x, axis=1), program.components)
    return np.asarray(abs(program.equilibrium_matrix) @ sizes + np.abs(program.dead_load))


def least_carried(program: Program, x: FloatArray) -> FloatArray:
    """What the lighter of the blocks at each contact point has to balance, as a force there, (n_points,)."""
    matrix = program.equilibrium_matrix.tocoo()
    share = carried_loads(program, x)[matrix.row] / np.maximum(np.abs(matrix.data), 1e-300)
    least = np.full(program.n_points, np.inf)
    np.minimum.at(least, matrix.col // program.components, share)
    return least


def _pulled_inside(program: Program, x: FloatArray) -> FloatArray:
    """The nearest simple change that puts every force strictly inside: normal force off its ends, shear shortened.

    By little relative to what the lighter block has to balance: much of its load may be little relative to the others'.
    """
    inside, limits = x.copy(), program.limits
    largest = np.minimum(max(float(np.abs(x[:, 0]).max(initial=0.0)), 1e-288), least_carried(program, x))
    frictional = limits.friction > 0
    apex = np.divide(limits.cohesion, limits.friction, out=np.full_like(limits.cohesion, np.inf), where=frictional)
    lower, upper = -np.minimum(limits.tension, apex), limits.compression
    room = np.minimum(MARGIN * largest, 0.25 * (upper - lower))
    inside[:, 0] = np.clip(x[:, 0], lower + room, upper - room)
    shear = np.linalg.norm(x[:, 1:], axis=1)
    allowed = np.maximum((limits.cohesion + limits.friction * inside[:, 0]) * (1 - 1e-10), 0.0)
    factor = np.divide(allowed, shear, out=np.ones_like(shear), where=shear > allowed)
    inside[:, 1:] *= factor[:, None]
    return inside


def _static_correction(program: Program, further: ConditionCones, now: _Forces, way: _Way) -> _Forces | None:
    """Least change of forces, slacks and load factor, in the barrier's metric, that restores equilibrium."""
    limits, x = program.limits, now.x
    least = NO_FORCE * max(float(np.abs(x).max(initial=0.0)), 1e-280)  # a steeper cone has none: no digits are left
    needed = 2.0 * np.linalg.norm(x[:, 1:], axis=1) / np.maximum(x[:, 0], least)
    limits = replace(limits, friction=np.minimum(limits.friction, np.maximum(STEEP, needed)))
    free = 1e-4 * max(abs(now.factor), 1e-3)
    step = (_augmented if way.augmented else _normal)(further, limits, now, free)
    if step is None:
        return None
    solve, forces_of = step
    change = _Forces(np.zeros_like(x), np.zeros_like(now.s), 0.0)
    for _ in range(4):  # refinement: the metric spans many decades
        moved = now.plus(change)
        y = solve(-further.unbalanced(moved.x, moved.s, moved.factor))
        if not np.isfinite(y).all():
            return None
        change = change.plus(forces_of(y))
    return change


Step = tuple[Callable[[FloatArray], FloatArray], Callable[[FloatArray], _Forces]]
"""Unknowns that take away what is unbalanced, from (n_rows + n_unknowns,), and the change of forces that they mean."""


def _normal(further: ConditionCones, limits: YieldLimits, now: _Forces, free: float) -> Step | None:
    """By normal equations: multipliers of the rows, and the change of the load factor."""
    matrix, held, live = further.moving.equilibrium_matrix, further.held, further.moving.live_load
    weights, of_slacks = force_metric(limits, now.x), further.cones.inverse_hessian(now.s)
    moving, lacking = matrix.T, held.T
    normal = further.with_slacks(matrix @ weights @ moving, of_slacks)
    solve = bordered_solver(normal, live, free * free)  # not **, which raises beyond numbers

    def forces_of(y: FloatArray) -> _Forces:
        x = (weights @ (moving @ y[:-1])).reshape(now.x.shape)
        return _Forces(x, of_slacks @ (lacking @ y[:-1]), float(y[-1]))

    return None if solve is None else (solve, forces_of)


def _augmented(further: ConditionCones, limits: YieldLimits, now: _Forces, free: float) -> Step | None:
    """By the augmented system: changes of load factor, forces and slacks in units of their metric."""
    matrix, held, live = further.moving.equilibrium_matrix, further.held, further.moving.live_load
    of_points = block_diagonal(roots(force_blocks(limits, now.x)))
    of_slacks = further.cones.root_of_inverse_hessian(now.s)
    rows = sp.hstack([sp.csr_array(free * live[:, None]), matrix @ of_points, held @ of_slacks])
    solve = augmented_solver(sp.csr_array(rows))

    def forces_of(y: FloatArray) -> _Forces:
        factor, x, s = np.split(y, [1, 1 + now.x.size])
        return _Forces((of_points @ x).reshape(now.x.shape), of_slacks @ s, free * float(factor[0]))

    return None if solve is None else (solve, forces_of)
