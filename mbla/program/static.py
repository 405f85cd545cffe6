"""Static forms: cone programs with the contact forces as unknowns.

*Gravity state:* the least forces that carry the dead load alone, unique by their distance from none::

    min ½ ‖x‖²     s.t.   A x + f_D = 0,   ‖T‖ ≤ μ N + c,   −f_t ≤ N ≤ f_c

*Given mechanism:* every force that is compatible with it, with the law without normality. At a contact point that
moves, the joint law fixes the force or leaves it one unknown; at a point at rest it leaves the entire cone. With d the
direction of the shear at a sliding point (against the sliding velocity)::

    min or max λ   s.t.   A x + f_D + λ f_L = 0
    N = −f_t where the point opens, N = f_c where it crushes, −f_t ≤ N ≤ f_c elsewhere
    T = (μ N + c) d where it slides, ‖T‖ ≤ μ N + c elsewhere

What is fixed is eliminated, x = E y + x₀, which leaves a program with an inside as far as there is one: with the fixed
forces as equations the same program stops between 1e-7 and 1e-4 of equilibrium, without them at 1e-13.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

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
class StaticForm:
    """A cone program in forces, and how to read its solution.

    expand, offset : x = expand @ y + offset for the unknowns y of the program, behind which the load factor may stand
    """

    program: Program
    expand: sp.csr_array
    offset: FloatArray
    cone_program: ConeProgram

    def forces(self, y: FloatArray) -> FloatArray:
        """Contact forces, (n_points, components)."""
        return np.asarray(self.expand @ y[: self.expand.shape[1]] + self.offset).reshape(-1, self.program.components)

    def load_factor(self, y: FloatArray) -> float:
        """Load factor of the program under a given mechanism: the last of its unknowns y, (n_unknowns,)."""
        return float(y[-1])

    def velocities(self, z: FloatArray) -> FloatArray:
        """Velocities of the free blocks, (n_rows,), from the dual variables of equilibrium."""
        return z[: len(self.program.dead_load)]


def gravity_form(program: Program) -> StaticForm:
    """The least forces that carry the dead load alone."""
    every, size = np.arange(program.n_points), program.components * program.n_points
    expand = sp.eye_array(size, format="csr")
    form = _form(program, expand, np.zeros(size), (every, np.flatnonzero(Crushing.applies(program.limits)), every))
    return replace(form, cone_program=replace(form.cone_program, cost=np.zeros(size), quadratic=np.ones(size)))


def fixed_mechanism_form(program: Program, motion: PointMotion) -> StaticForm:
    """The forces compatible with what the contact points do, as a cone program whose cost is the load factor.

    Its optimum is the least load factor under the mechanism, that of the negative cost the greatest.
    """
    limits, unknowns = program.limits, _Unknowns.of(program, motion)
    expand, offset = _expansion(program, motion, unknowns)
    has_cone = np.zeros(program.n_points, dtype=bool)
    has_cone[unknowns.shear] = True
    cut_off = unknowns.normal[(TensionCutOff.applies(limits) | ~has_cone)[unknowns.normal]]
    crushable = unknowns.normal[Crushing.applies(limits)[unknowns.normal]]
    return _form(program, expand, offset, (cut_off, crushable, unknowns.shear), load=program.live_load)


def _form(
    program: Program,
    expand: sp.csr_array,
    offset: FloatArray,
    limited: tuple[IntArray, IntArray, IntArray],
    load: FloatArray | None = None,
) -> StaticForm:
    """Forces x = expand @ y + offset in equilibrium with the dead load, and with λ times a load, within limits.

    limited : points with N + f_t ≥ 0, with f_c − N ≥ 0, and with c + μ N ≥ ‖T‖
    """
    limits, c, (cut_off, crushable, _) = program.limits, program.components, limited
    lines = sp.vstack([expand[c * cut_off], -expand[c * crushable]])
    room = [limits.tension[cut_off] + offset[c * cut_off], limits.compression[crushable] - offset[c * crushable]]
    shear, limit = _shear_limits(program, limited[2], expand, offset)
    matrix = sp.vstack([program.equilibrium_matrix @ expand, -lines, -shear])
    if load is not None:
        column = np.concatenate([load, np.zeros(matrix.shape[0] - len(load))])
        matrix = sp.hstack([matrix, sp.csr_array(column[:, None])])
    matrix = sp.csc_array(matrix)
    matrix.eliminate_zeros()
    matrix.sort_indices()
    n_lines, planar = lines.shape[0], c == 2
    cone_program = ConeProgram(
        cost=np.append(np.zeros(expand.shape[1]), [1.0] * (load is not None)),
        matrix=matrix,
        rhs=np.concatenate([-program.dead_load - program.equilibrium_matrix @ offset, *room, limit]),
        n_half_lines=n_lines + (len(limit) if planar else 0),
        n_cones=0 if planar else len(limit) // 3,
        n_equations=len(program.dead_load),
    )
    return StaticForm(program, expand, offset, cone_program)


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


def _shear_limits(
    program: Program, points: IntArray, expand: sp.csr_array, offset: FloatArray
) -> tuple[sp.csr_array, FloatArray]:
    """Rows and offsets of c + μ N ≥ ‖T‖ at the points: cones, or pairs of half-lines in a plane."""
    limits, c = program.limits, program.components
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
