"""The exact non-associative law of interfaces and their points, and Newton's method on it.

Points as in ``joint_law``, by what the motion of their interface leaves of the motion of the blocks.
An interface slips by η and twists by ω against its friction, without opening::

    v = Aᵀu − Sᵀη,  η = (η_1, η_2, ρω),  S x = (T_1, T_2, M_n/ρ)
    y = nearest point to S x̄ − η/ρ of the set that friction allows at the normal forces of x

An interface that can crush moves by ω besides, dual to R x = (N, M_1/ρ, M_2/ρ)::

    v = Aᵀu − Sᵀη − Rᵀω,    z = nearest to R x̄ − ω/ρ of what fields of stress carry (``nearest_stress``)

Equilibrium A x + f_D + λ f_L = 0, the interfaces y = S x and z = R x, and f_L·u = 1 are solved for u, η, ω and λ by
semismooth Newton. With the tangent C of the points, P and Z of the interfaces, G the derivative of y by x::

    J = −(B + G) C Bᵀ − (P, Z)/ρ,    B = [A; −S; −R]

Then how badly a state fits that law.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.program.resultants import ConvexProgram
from mbla.program.resultants.conditions import RESULTANTS
from mbla.program.resultants.crushing import crushing_violation
from mbla.program.resultants.friction_limit import curve_size, curve_support, friction_limit, nearest
from mbla.program.yield_conditions import YieldLimits, yield_violation
from mbla.solution.linear_algebra.block_products import block_diagonal
from mbla.solution.linear_algebra.superlu import factorize
from mbla.solution.nonassociative.joint_law import CONVERGED, REGULARIZATION, joint_state, joint_tangents
from mbla.solution.nonassociative.law_state import LawState
from mbla.solution.resultants.stress_fields import StressFields, nearest_stress

MOST_STEPS = 80
"""Factorisations of one step."""

BACKTRACKS = 10
"""Halvings of a step before it is damped more instead."""

FIRST_DAMPING, MORE, LESS, MOST_DAMPING = 1e6, 1e3, 1e-2, 1e12
"""Multiples of the regularisation, 1e-12 of the stiffness, that damp a step which does not lessen what is unbalanced:
the first, by how much it grows and falls again, and the most. Open interfaces have no stiffness against slip, and
undamped steps ended at their first on walls of 6 and 10 courses; damped the former come to 1e-10."""


@dataclass(frozen=True)
class ConvexLaw:
    """What every step needs.

    slips    : (3 n_torsion, 3 n_points) S
    crushes  : (3 n_crushing, 3 n_points) R
    fields   : of what crushes
    program  : of the points, with motions of the interfaces, dual to S x and R x, behind the velocities of the blocks
    """

    convex: ConvexProgram
    slips: sp.csr_array
    crushes: sp.csr_array
    fields: StressFields
    program: Program

    def motions(self, own: FloatArray) -> FloatArray:
        """Motions of the interfaces from η and ω, (3 n_torsion + 3 n_crushing,)."""
        limits, n_interfaces = self.convex.torsion, self.convex.n_interfaces
        motions = np.zeros((n_interfaces, 2, 6))
        eta, omega = self.split(own)
        motions[limits.interfaces, 0, 1:3] = eta[:, :2]
        motions[limits.interfaces, 0, 3] = eta[:, 2] / limits.radii
        motions[self.convex.crushing.interfaces[:, None], 1, RESULTANTS] = omega * self.fields.scale
        return motions

    def own_of(self, motions: FloatArray) -> FloatArray:
        """η and ω, (3 n_torsion + 3 n_crushing,), from motions of the interfaces, (n_interfaces, 2, 6)."""
        limits = self.convex.torsion
        of_torsion = motions[limits.interfaces, 0, 1:4].copy()
        of_torsion[:, 2] *= limits.radii
        of_crushing = motions[self.convex.crushing.interfaces[:, None], 1, RESULTANTS] / self.fields.scale
        return np.concatenate([of_torsion.ravel(), of_crushing.ravel()])

    def split(self, own: FloatArray) -> tuple[FloatArray, FloatArray]:
        """η, (n_torsion, 3), and ω, (n_crushing, 3)."""
        both = own.reshape(-1, 3)
        return both[: len(self.convex.torsion.radii)], both[len(self.convex.torsion.radii) :]

    def crushed(self, wanted: FloatArray, near: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Forces z nearest to those wanted, (n, 3), how they follow, (n, 3, 3), and d, (n, 3), of all that can crush.

        near : d of something near it
        """
        limits = self.convex.crushing
        resultants = np.zeros((self.convex.n_interfaces, 6))
        resultants[self.convex.crushing.interfaces[:, None], RESULTANTS] = wanted / self.fields.scale
        outside = crushing_violation(limits, resultants) > 0.0
        shift = np.column_stack([limits.tension, np.zeros((len(wanted), 2))])
        forces, follows, d = nearest_stress(self.fields, wanted + shift, outside, near)
        return forces - shift, follows, d


def convex_law(convex: ConvexProgram) -> ConvexLaw:
    """The law of a program."""
    limits, crushing = convex.torsion, convex.crushing
    rows = (6 * limits.interfaces[:, None] + np.array([1, 2, 3])).ravel()
    scale = np.column_stack([np.ones((len(limits.radii), 2)), 1.0 / limits.radii]).ravel()
    slips = sp.csr_array(sp.diags_array(scale) @ convex.resultants[rows])
    rows = (6 * crushing.interfaces[:, None] + np.array(RESULTANTS)).ravel()
    fields = StressFields.of(convex.shapes, crushing.interfaces, crushing.strength)
    crushes = sp.csr_array(sp.diags_array(fields.scale.ravel()) @ convex.resultants[rows])
    program = with_motions(convex.points, sp.csr_array(sp.vstack([slips, crushes])))
    return ConvexLaw(convex, slips, crushes, fields, program)


@dataclass(frozen=True)
class ConvexStep:
    """One step of the exact law: velocities and slips (n_rows,), load factor, forces, unbalanced force."""

    velocities: FloatArray
    load_factor: float
    forces: FloatArray
    residual: float
    factorizations: int


def exact_convex_step(
    law: ConvexLaw, anchor: FloatArray, rho: float, velocities: FloatArray, load_factor: float
) -> ConvexStep:
    """Solve one step from forces ``anchor``, (n_points, 3), starting from velocities, slips and a load factor."""
    matrix = law.program.equilibrium_matrix
    stiffness = REGULARIZATION * (matrix.multiply(matrix)).sum(axis=1) / rho
    u, factor, damping = velocities, load_factor, 1.0
    trial = _Trial.at(law, anchor, rho, u, factor, np.zeros((len(law.convex.crushing.interfaces), 3)))
    best = ConvexStep(u, factor, trial.forces, trial.largest, 0)
    for count in range(1, MOST_STEPS + 1):
        step = trial.direction(law, rho, damping * stiffness)
        moved = None if step is None else _descent(law, anchor, rho, u, factor, step, trial)
        if step is None or moved is None:
            damping = max(damping * MORE, FIRST_DAMPING)
            if damping > MOST_DAMPING:
                return replace(best, factorizations=count)
            continue
        size, trial = moved
        damping = max(1.0, damping * LESS) if size == 1.0 else damping
        u, factor = u + size * step[:-1], factor + size * float(step[-1])
        best = ConvexStep(u, factor, trial.forces, trial.largest, count)
        if best.residual <= CONVERGED:
            break
    return best


def _descent(
    law: ConvexLaw, anchor: FloatArray, rho: float, u: FloatArray, factor: float, step: FloatArray, trial: _Trial
) -> tuple[float, _Trial] | None:
    """The largest of a few shares of a step that lessens what is unbalanced, and the trial there."""
    size, norm = 1.0, float(np.linalg.norm(trial.residual))
    for _ in range(BACKTRACKS):
        moved = _Trial.at(law, anchor, rho, u + size * step[:-1], factor + size * float(step[-1]), trial.closing)
        if np.linalg.norm(moved.residual) < (1.0 - 1e-4 * size) * norm:
            return size, moved
        size *= 0.5
    return None


@dataclass(frozen=True)
class _Trial:
    """Forces at given velocities, what they leave unbalanced, the tangents there, and how interfaces close."""

    forces: FloatArray
    residual: FloatArray
    tangent: sp.csr_array
    by_own: sp.csr_array
    by_forces: sp.csr_array
    closing: FloatArray

    @classmethod
    def at(
        cls, law: ConvexLaw, anchor: FloatArray, rho: float, u: FloatArray, factor: float, near: FloatArray
    ) -> _Trial:
        """At velocities and slips u, (n_rows,), and a load factor, for a step from forces ``anchor``, (n_points, 3).

        near : (n_crushing, 3), see ``ConvexLaw.crushed``
        """
        program, convex = law.program, law.convex
        n_blocks, limits = convex.n_block_rows, convex.torsion
        points = joint_state(program.limits, anchor - (program.equilibrium_matrix.T @ u).reshape(-1, 3) / rho)
        forces = points.forces
        size = friction_limit(limits, convex.resultants_of(forces))
        eta, omega = law.split(u[n_blocks:])
        wanted = (law.slips @ anchor.ravel()).reshape(-1, 3) - eta / rho
        found = nearest(wanted, size, limits.thetas)
        balance = program.equilibrium_matrix @ forces.ravel() + program.dead_load + factor * program.live_load
        wanted_stress = (law.crushes @ anchor.ravel()).reshape(-1, 3) - omega / rho
        crushed, follows, closing = law.crushed(wanted_stress, near)
        balance[n_blocks:] += np.concatenate([found.point.ravel(), crushed.ravel()])
        n = len(limits.radii)
        by_sizes = _columns(found.by_total, n) @ size.of_total + _columns(found.by_share, n) @ size.of_share
        return cls(
            forces=forces,
            residual=np.append(balance, program.live_load @ u - 1.0),
            tangent=block_diagonal(joint_tangents(program.limits.friction, points) / rho),
            by_own=block_diagonal(np.concatenate([found.by_point, follows]) / rho),
            by_forces=sp.csr_array(by_sizes @ convex.resultants),
            closing=closing,
        )

    @property
    def largest(self) -> float:
        return float(np.abs(self.residual).max(initial=0.0))

    def direction(self, law: ConvexLaw, rho: float, stiffness: FloatArray) -> FloatArray | None:
        """Newton's step of velocities, slips and load factor, (n_rows + 1,); None where it cannot be solved for.

        stiffness : (n_rows,) of springs that hold every row
        """
        program, n_blocks = law.program, law.convex.n_block_rows
        matrix, live = program.equilibrium_matrix, program.live_load
        above, below = (sp.csr_array((n, matrix.shape[1])) for n in (n_blocks, 3 * len(law.convex.crushing.interfaces)))
        left = sp.csr_array(matrix + sp.vstack([above, self.by_forces, below]))
        own = sp.block_diag([sp.csr_array((n_blocks, n_blocks)), self.by_own])
        jacobian = -(left @ self.tangent @ matrix.T) - own - sp.diags_array(stiffness)
        system = sp.block_array([[jacobian, sp.csr_array(live[:, None])], [sp.csr_array(live[None, :]), None]])
        solve = factorize(system)
        if solve is None:
            return None
        step = solve(-self.residual)
        return step if np.isfinite(step).all() else None


def _columns(vectors: FloatArray, n: int) -> sp.csr_array:
    """Vectors (n, 3) as the blocks of a (3 n, n) matrix."""
    rows, columns = np.arange(3 * n), np.repeat(np.arange(n), 3)
    return sp.csr_array(sp.coo_array((vectors.ravel(), (rows, columns)), shape=(3 * n, n)))


def with_motions(program: Program, motions: sp.csr_array) -> Program:
    """The program with motions of interfaces behind the velocities of the blocks: v = Aᵀu − motionsᵀ w.

    motions : (n_motions, 3 n_points)
    """
    none = np.zeros(motions.shape[0])
    return replace(
        program,
        equilibrium_matrix=sp.csr_array(sp.vstack([program.equilibrium_matrix, -motions])),
        dead_load=np.concatenate([program.dead_load, none]),
        live_load=np.concatenate([program.live_load, none]),
    )


def state_without_dilatancy(
    convex: ConvexProgram, forces: FloatArray, velocities: FloatArray, motions: FloatArray, load_factor: float
) -> LawState:
    """A state with its residual, the largest of three.

    Excess over the conditions of points and interfaces, in mean block loads; closing velocity of points by their own
    motion over the largest contact speed; share of the power balance that the law leaves unexplained.

    forces     : (n_points, 3)  non-dimensional, compression positive
    velocities : (n_rows,) of the blocks, non-dimensional
    motions    : (n_interfaces, 2, 6) by torsion and by crushing, non-dimensional
    """
    program, limits = convex.points, convex.torsion
    moved = (program.equilibrium_matrix.T @ velocities).reshape(-1, 3)
    own = moved - (convex.resultants.T @ motions.sum(axis=1).ravel()).reshape(-1, 3)
    speed = max(float(np.linalg.norm(moved, axis=1).max(initial=0.0)), 1e-300)
    closing = float(np.where(np.isfinite(program.limits.compression), 0.0, -own[:, 0]).max(initial=0.0)) / speed
    of_points, at_points = _unexplained_at_points(program.limits, forces, own)

    resultants = convex.resultants_of(forces)
    size = friction_limit(limits, resultants)
    r, motion = resultants[limits.interfaces], motions[limits.interfaces, 0]
    slip, twist = np.hypot(motion[:, 1], motion[:, 2]), np.abs(motion[:, 3]) * limits.radii
    rest = np.maximum(size.total - size.share, 0.0)
    of_torsion = size.share * curve_support(slip, twist, limits.thetas) + rest * slip
    beyond = np.maximum(np.hypot(r[:, 1], r[:, 2]) - rest, 0.0)
    twisting = curve_size(beyond, np.abs(r[:, 3]) / limits.radii, limits.thetas) - size.share
    rows, of_crushing = convex.crushing.interfaces, np.zeros(convex.n_interfaces)
    fields = StressFields.of(convex.shapes, rows, convex.crushing.strength)
    crushed = motions[rows[:, None], 1, RESULTANTS]
    of_crushing[rows] = fields.power(-crushed / fields.scale) + convex.crushing.tension * crushed[:, 0]

    unexplained = at_points + float(np.abs(of_torsion + (r * motion).sum(axis=1)).sum())
    unexplained += float(np.abs(of_crushing + (resultants * motions[:, 1]).sum(axis=1)).sum())
    dead_power = abs(float(program.dead_load @ velocities))
    balance = max(abs(load_factor), dead_power, of_points + float(of_torsion.sum()), 1e-300)
    excess = [yield_violation(forces, program.limits), twisting, crushing_violation(convex.crushing, resultants)]
    worst = max(float(part.max(initial=0.0)) for part in excess)
    return LawState(forces, velocities, load_factor, max(worst, closing, unexplained / balance), motions)


def _unexplained_at_points(limits: YieldLimits, forces: FloatArray, own: FloatArray) -> tuple[float, float]:
    """Power dissipated by sliding, and power that opening, sliding and crushing of points leave unexplained."""
    sliding = np.hypot(own[:, 1], own[:, 2])
    strength = limits.friction * forces[:, 0] + limits.cohesion
    capacity = np.where(np.isfinite(limits.compression), limits.compression, forces[:, 0])
    unexplained = np.abs(strength * sliding + (forces[:, 1:] * own[:, 1:]).sum(axis=1))
    unexplained += np.abs((forces[:, 0] + limits.tension) * np.maximum(own[:, 0], 0.0))
    unexplained += np.abs((capacity - forces[:, 0]) * np.maximum(-own[:, 0], 0.0))
    return float(np.abs(strength) @ sliding), float(unexplained.sum())
