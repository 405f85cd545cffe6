"""The static form for one given mechanism: every force that is compatible with it, with the law without normality.

At a contact point that moves, the joint law fixes the force or leaves it one unknown; at a point at rest it leaves the
whole cone. With d the direction of the shear at a sliding point (against the sliding velocity)::

    min or max λ   s.t.   A x + f_D + λ f_L = 0
    N = −f_t where the point opens, N = f_c where it crushes, −f_t ≤ N ≤ f_c elsewhere
    T = (μ N + c) d where it slides, ‖T‖ ≤ μ N + c elsewhere

What is fixed is eliminated, x = E y + x₀, which leaves a program with an inside as far as there is one: with the fixed
forces as equations the same program stops between 1e-7 and 1e-4 of equilibrium, without them at 1e-13.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.program.kinematic import ConeProgram
from mbla.program.program import Program
from mbla.program.yield_conditions import Crushing, TensionCutOff


@dataclass(frozen=True)
class PointMotion:
    """What the contact points do in a mechanism.

    opens, crushes, slides : (n_points,); a point that opens or crushes may slide too
    shear                  : (n_points, components − 1) unit direction of the shear on body b where the point slides
    """

    opens: BoolArray
    crushes: BoolArray
    slides: BoolArray
    shear: FloatArray


@dataclass(frozen=True)
class FixedMechanismForm:
    """The cone program for the least load factor under a given mechanism; the negative of its cost is the greatest.

    expand, offset : x = expand @ y + offset for the unknowns y of the program but its last, the load factor
    """

    program: Program
    expand: sp.csr_array
    offset: FloatArray
    cone_program: ConeProgram

    def forces(self, y: FloatArray) -> FloatArray:
        """Contact forces, (n_points, components)."""
        return np.asarray(self.expand @ y[:-1] + self.offset).reshape(-1, self.program.components)

    def load_factor(self, y: FloatArray) -> float:
        """Load factor of the program."""
        return float(y[-1])


def fixed_mechanism_form(program: Program, motion: PointMotion) -> FixedMechanismForm:
    """The forces compatible with what the contact points do, as a cone program whose cost is the load factor."""
    unknowns = _Unknowns.of(program, motion)
    expand, offset = _expansion(program, motion, unknowns)
    lines, room = _half_lines(program, unknowns, expand, offset)
    shear, limit = _shear_limits(program, unknowns, expand, offset)
    equations = sp.hstack([program.equilibrium_matrix @ expand, sp.csr_array(program.live_load[:, None])])
    limits = sp.vstack([lines, shear])
    matrix = sp.csc_array(sp.vstack([equations, sp.hstack([-limits, sp.csr_array((limits.shape[0], 1))])]))
    matrix.eliminate_zeros()
    matrix.sort_indices()
    planar = program.components == 2
    cone_program = ConeProgram(
        cost=np.append(np.zeros(expand.shape[1]), 1.0),
        matrix=matrix,
        rhs=np.concatenate([-program.dead_load - program.equilibrium_matrix @ offset, room, limit]),
        n_half_lines=len(room) + (len(limit) if planar else 0),
        n_cones=0 if planar else len(limit) // 3,
        n_equations=len(program.dead_load),
    )
    return FixedMechanismForm(program, expand, offset, cone_program)


@dataclass(frozen=True)
class _Unknowns:
    """Points by what is unknown of their force.

    normal : points whose normal force is unknown
    shear  : points whose shear is unknown: not sliding, and able to carry any
    follow : sliding points: their shear follows from the normal force, or is fixed with it
    """

    normal: IntArray
    shear: IntArray
    follow: IntArray

    @staticmethod
    def of(program: Program, motion: PointMotion) -> _Unknowns:
        limits = program.limits
        held = motion.opens | motion.crushes
        fixed = np.where(motion.opens, -limits.tension, np.where(motion.crushes, limits.compression, 0.0))
        strong = np.where(held, limits.cohesion + limits.friction * fixed, limits.cohesion + limits.friction) > 0.0
        return _Unknowns(
            normal=np.flatnonzero(~held),
            shear=np.flatnonzero(~motion.slides & strong),
            follow=np.flatnonzero(motion.slides),
        )


def _expansion(program: Program, motion: PointMotion, unknowns: _Unknowns) -> tuple[sp.csr_array, FloatArray]:
    """E and x₀ of x = E y + x₀: unknown normal forces first, then the unknown shear, point by point."""
    limits, c = program.limits, program.components
    normal, shear, follow = unknowns.normal, unknowns.shear, unknowns.follow
    column = np.full(program.n_points, -1)
    column[normal] = np.arange(len(normal))
    carried = follow[column[follow] >= 0]
    components = np.arange(1, c)
    rows = [c * normal, _of_shear(carried, c), _of_shear(shear, c)]
    columns = [column[normal], np.repeat(column[carried], c - 1), len(normal) + np.arange((c - 1) * len(shear))]
    slopes = limits.friction[carried, None] * motion.shear[carried]
    values = [np.ones(len(normal)), slopes.ravel(), np.ones((c - 1) * len(shear))]
    shape = (c * program.n_points, len(normal) + (c - 1) * len(shear))
    entries = (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))
    offset = np.zeros((program.n_points, c))
    offset[motion.opens, 0] = -limits.tension[motion.opens]
    crushes = motion.crushes & ~motion.opens
    offset[crushes, 0] = limits.compression[crushes]
    strength = np.maximum(limits.cohesion + limits.friction * offset[:, 0], 0.0)
    offset[np.ix_(follow, components)] = strength[follow, None] * motion.shear[follow]
    return sp.csr_array(sp.coo_array(entries, shape=shape)), offset.ravel()


def _of_shear(points: IntArray, components: int) -> IntArray:
    """Rows of the shear components of the given points."""
    return np.asarray((components * points[:, None] + np.arange(1, components)).ravel())


def _half_lines(
    program: Program, unknowns: _Unknowns, expand: sp.csr_array, offset: FloatArray
) -> tuple[sp.csr_array, FloatArray]:
    """Rows and offsets of N + f_t ≥ 0 where no cone says it, and of f_c − N ≥ 0."""
    limits, c = program.limits, program.components
    has_cone = np.zeros(program.n_points, dtype=bool)
    has_cone[unknowns.shear] = True
    cut_off = unknowns.normal[(TensionCutOff.applies(limits) | ~has_cone)[unknowns.normal]]
    crushable = unknowns.normal[Crushing.applies(limits)[unknowns.normal]]
    rows = sp.vstack([expand[c * cut_off], -expand[c * crushable]])
    room = np.concatenate(
        [limits.tension[cut_off] + offset[c * cut_off], limits.compression[crushable] - offset[c * crushable]]
    )
    return sp.csr_array(rows), room


def _shear_limits(
    program: Program, unknowns: _Unknowns, expand: sp.csr_array, offset: FloatArray
) -> tuple[sp.csr_array, FloatArray]:
    """Rows and offsets of c + μ N ≥ ‖T‖ where shear is unknown: cones, or pairs of half-lines in a plane."""
    limits, c, points = program.limits, program.components, unknowns.shear
    slope = sp.diags_array(limits.friction[points], format="csr")
    strength = sp.csr_array(slope @ expand[c * points])
    limit = limits.cohesion[points] + limits.friction[points] * offset[c * points]
    n = len(points)
    if c == 2:
        both = sp.csr_array(sp.vstack([strength + expand[c * points + 1], strength - expand[c * points + 1]]))
        return both, np.tile(limit, 2)
    stacked = sp.csr_array(sp.vstack([strength, expand[3 * points + 1], expand[3 * points + 2]]))
    rows = stacked[np.arange(3 * n).reshape(3, n).T.ravel()]
    return rows, np.column_stack([limit, np.zeros((n, 2))]).ravel()
