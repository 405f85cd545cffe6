"""Elastic joints of a program, a step of them, and what they remember from step to step.

A contact point is a spring of stiffness k_N across the joint and k_T along it, in series with the rigid law of the
joint: no force in an open joint beyond its tensile strength f_t, Coulomb friction with cohesion, compression up to f_c,
sliding that lifts by the point's own dilatancy δ = tan ψ. In one implicit step of length h, with the velocities v = Aᵀu
of the contacts, positive products instead of the alternatives of the law, and l = μ n + c::

    A x + f_D + λ f_L = 0,  f_L·u = 1
    y − z = v_N + (n − n̄)/(k_N h) − δ s,    N y = σ with N = n + f_t,    (f_c − n) z = σ
    w     = v_T + (t − t̄)/(k_T h),          l s + t·w = σ,    l w + s t = 0,    ‖t‖ < l, ‖w‖ < s

At σ = 0 these are the alternatives: a joint is closed or without force, sticks or slides against its friction. What a
joint remembers are the normal force n̄ that its gap would have without the law, and its shear t̄.

Interfaces that crush or twist have a motion and a law of their own beside it
(:mod:`mbla.solution.law.interface_law`), where a structure has such: the unknowns of all blocks are followed by theirs.

Units are those of the program. Arrays of components stand first: (components − 1, n_points) for shear.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.program.program import Program
from mbla.program.stiffness_shares import brittle_of
from mbla.solution.law.crossing import Crossing
from mbla.solution.law.interface_law import InterfaceLaw, InterfaceState
from mbla.solution.law.interface_rows import InterfaceRows, with_resultants, with_rows
from mbla.solution.linear_algebra.stiffness import Stiffness, stiffness_of

AT_FRICTION = 1e-9
"""Share of its limit by which the shear of a joint at its friction may lie below it, by rounding."""

LEAST_LIMIT = 1e-9
"""Least limit of shear, in mean loads of a block: the cone of a joint without friction has no inside."""


@dataclass(frozen=True)
class ElasticJoints:
    """Contact points of a program with their law and stiffness, all (n_points,).

    program   : whose points they are, with the rows of interfaces behind those of the blocks
    matrix    : the pattern of A C Aᵀ, with the resultants of interfaces behind the points
    dilatancy : tangent of the angle
    normal    : k_N, with mean 1
    shear     : k_T
    rows      : of interfaces with a motion of their own
    brittle   : (n_points, 2) which carry nothing once they have given way at f_c, and at −f_t
    """

    program: Program
    matrix: Stiffness
    dilatancy: FloatArray
    normal: FloatArray
    shear: FloatArray
    brittle: BoolArray
    rows: tuple[InterfaceRows, ...] = ()

    @cached_property
    def laws(self) -> tuple[InterfaceLaw, ...]:
        """Of interfaces with a motion of their own, one behind the other."""
        return tuple(law for rows in self.rows for law in rows.laws)

    @staticmethod
    def of(
        program: Program,
        shares: FloatArray,
        ratio: FloatArray | float,
        dilatancy: FloatArray | None = None,
        interfaces: Sequence[InterfaceRows] = (),
        coupled: sp.coo_array | None = None,
    ) -> ElasticJoints:
        """Joints of a program.

        shares     : (n_points,) of the stiffness, mean 1
        ratio      : k_T over k_N, of all or (n_points,)
        dilatancy  : (n_points,) tangents of its angles; default: none
        interfaces : of the program that have a law of their own
        coupled    : (n_rows, n_rows) entries of the matrix besides, as those of masses
        """
        slope, brittle = np.zeros(program.n_points) if dilatancy is None else dilatancy, brittle_of(program)
        program = with_rows(program, interfaces)
        matrix = stiffness_of(with_resultants(program, interfaces), coupled)
        return ElasticJoints(program, matrix, slope, shares, ratio * shares, brittle, tuple(interfaces))

    @property
    def without_live_load(self) -> ElasticJoints:
        """The same joints under the dead load alone, as any load case has them."""
        matrix = replace(self.matrix, program=self.matrix.program.without_live_load())
        return replace(self, program=self.program.without_live_load(), matrix=matrix)

    @property
    def without_laws(self) -> ElasticJoints:
        """The same joints, of interfaces without a motion of their own."""
        n = len(self.program.dead_load) - sum(rows.resultants.shape[0] for rows in self.rows)
        matrix = sp.csr_array(self.program.equilibrium_matrix[:n])
        loads = self.program.dead_load[:n], self.program.live_load[:n]
        program = replace(self.program, equilibrium_matrix=matrix, dead_load=loads[0], live_load=loads[1])
        return replace(self, program=program, matrix=stiffness_of(program), rows=())

    @cached_property
    def friction(self) -> FloatArray:
        """μ, (n_points,)."""
        return np.maximum(self.program.limits.friction, 0.0)

    @cached_property
    def crushable(self) -> IntArray:
        """Numbers of the points with a compressive strength."""
        return np.flatnonzero(np.isfinite(self.program.limits.compression))

    @cached_property
    def dilates(self) -> bool:
        """Whether any joint lifts as it slides."""
        return bool(self.dilatancy.any())

    def limit(self, normal: FloatArray) -> FloatArray:
        """Limit of shear l at normal forces n, (n_points,)."""
        return np.maximum(self.friction * normal + self.program.limits.cohesion, LEAST_LIMIT)

    def margin(self, normal: FloatArray) -> FloatArray:
        """N = n + f_t, (n_points,), at least what rounding leaves of f_t."""
        tension = self.program.limits.tension
        return np.asarray(np.maximum(normal + tension, np.spacing(tension)))

    def room(self, normal: FloatArray) -> FloatArray:
        """f_c − n of the points that can crush, (n_crushable,)."""
        return np.asarray(self.program.limits.compression[self.crushable] - normal[self.crushable])

    @property
    def n_products(self) -> float:
        """Products of the law, over which smoothing takes σ each."""
        return 2.0 * self.program.n_points + sum(
            law.conditions.weight * law.conditions.n_conditions for law in self.laws
        )

    def velocities(self, u: FloatArray) -> FloatArray:
        """Of the contacts, (components, n_points), from those of the blocks, (n_rows,)."""
        return self.matrix.velocities(u).T[:, : self.program.n_points]

    def motions(self, u: FloatArray) -> tuple[FloatArray, ...]:
        """Of what carries the resultants of each law, (components, m) each."""
        if not self.laws:
            return ()
        return self._by_law(self.matrix.velocities(u).T[:, self.program.n_points :])

    def _by_law(self, values: FloatArray) -> tuple[FloatArray, ...]:
        ends = np.cumsum([law.rows.shape[1] // self.program.components for law in self.laws])
        return tuple(np.split(values, ends[:-1], axis=1))

    @cached_property
    def crossings(self) -> tuple[Crossing | None, ...]:
        """Of each law whose bounds hang on normal forces, how it meets the blocks; None of others."""
        columns, size = sp.csc_array(self.matrix.program.equilibrium_matrix), self.program.components
        ends = size * self.program.n_points + np.cumsum([law.rows.shape[1] for law in self.laws])
        return tuple(
            None
            if law.conditions.points is None
            else Crossing.of(self.matrix, law.conditions.points, columns[:, end - law.rows.shape[1] : end])
            for law, end in zip(self.laws, ends.tolist(), strict=True)
        )

    def carried(self, normal: FloatArray, shear: FloatArray, resultants: Sequence[FloatArray] = ()) -> FloatArray:
        """A x, (n_rows,): what contact forces, and resultants of interfaces, do to the blocks and interfaces."""
        forces = np.empty((len(normal), 1 + len(shear)))
        forces[:, 0], forces[:, 1:] = normal, shear.T
        every = np.concatenate([forces, *(one.T for one in resultants)]) if resultants else forces
        return np.asarray(self.matrix.program.equilibrium_matrix @ every.ravel())

    def unbalanced(self, state: StepState) -> FloatArray:
        """Forces that a state leaves without balance, (n_rows,)."""
        program = self.program
        carried = self.carried(state.normal, state.shear, [one.resultants for one in state.interfaces])
        return carried + program.dead_load + state.factor * program.live_load


@dataclass(frozen=True)
class StepState:
    """Unknowns of a step, or a change of them.

    u, factor     : velocities of the blocks, (n_rows,), and load factor
    normal        : (n_points,) n
    opening       : (n_points,) y
    shear, slip   : (components − 1, n_points) t and w
    speed         : (n_points,) s
    crushing      : (n_crushable,) z
    interfaces    : of each law of interfaces
    """

    u: FloatArray
    factor: float
    normal: FloatArray
    opening: FloatArray
    shear: FloatArray
    slip: FloatArray
    speed: FloatArray
    crushing: FloatArray
    interfaces: tuple[InterfaceState, ...] = ()

    @property
    def forces(self) -> FloatArray:
        """N and T, (n_points, components)."""
        return together(self.normal, self.shear)

    def plus(self, change: StepState, length: float) -> StepState:
        """The state a length along a direction."""
        others = {key: mine + length * getattr(change, key) for key, mine in vars(self).items() if key != "interfaces"}
        of_laws = tuple(one.plus(turn, length) for one, turn in zip(self.interfaces, change.interfaces, strict=True))
        return StepState(**others, interfaces=of_laws)


@dataclass(frozen=True)
class Memory:
    """What joints remember from before a step: n̄, (n_points,), and t̄, (components − 1, n_points).

    interfaces : Ψ̄ of each law of interfaces, (components, m)
    """

    normal: FloatArray
    shear: FloatArray
    interfaces: tuple[FloatArray, ...] = ()

    @property
    def forces(self) -> FloatArray:
        """n̄ and t̄, (n_points, components)."""
        return together(self.normal, self.shear)

    def yielding(self, joints: ElasticJoints, normal: FloatArray) -> tuple[int, int]:
        """Numbers of contact points that are open, and of others that are at their friction.

        normal : (n_points,) normal forces after the step that is remembered
        """
        opened: BoolArray = self.normal < -joints.program.limits.tension
        slide = ~opened & (lengths(self.shear) >= (1.0 - AT_FRICTION) * joints.limit(normal))
        return int(opened.sum()), int(slide.sum())

    @staticmethod
    def stress_free(joints: ElasticJoints) -> Memory:
        """Of joints that just touch."""
        n, components = joints.program.n_points, joints.program.components
        none = tuple(np.zeros((components, law.rows.shape[1] // components)) for law in joints.laws)
        return Memory(np.zeros(n), np.zeros((components - 1, n)), none)

    def after(
        self, joints: ElasticJoints, moved: FloatArray, normal: FloatArray, motions: Sequence[FloatArray] = ()
    ) -> Memory:
        """After the joints have moved.

        moved   : (components, n_points) displacements of the contacts
        normal  : (n_points,) normal forces after it, which limit the shear: smoothing of the law must not make it creep
        motions : of what carries the resultants of each law of interfaces, (components, m)
        """
        trial = self.shear - joints.shear * moved[1:]
        shear = within(trial, joints.limit(normal))
        gap = self.normal - joints.normal * moved[0]
        if joints.dilates:
            gap = gap + joints.normal * joints.dilatancy * lengths(trial - shear) / joints.shear
        yields = joints.crushable[~joints.brittle[joints.crushable, 0]]
        gap[yields] = np.minimum(gap[yields], joints.program.limits.compression[yields])
        own = zip(joints.laws, self.interfaces, motions, strict=True)
        return Memory(gap, shear, tuple(was + by if law.conditions.remembers else was for law, was, by in own))


def together(normal: FloatArray, shear: FloatArray) -> FloatArray:
    """Of each point its components, (n_points, components)."""
    return np.column_stack([normal, shear.T])


def lengths(vectors: FloatArray) -> FloatArray:
    """Of vectors, (components, n), each: (n,)."""
    return np.asarray(np.abs(vectors[0]) if len(vectors) == 1 else np.sqrt((vectors * vectors).sum(axis=0)))


def within(vectors: FloatArray, limit: FloatArray, share: FloatArray | float = 1.0) -> FloatArray:
    """Vectors, (components, n), cut to a share of a limit, (n,), where they are longer."""
    size, most = lengths(vectors), share * limit
    return np.asarray(vectors * np.divide(most, size, out=np.ones_like(size), where=size > most))


def smoothed_margin(above: FloatArray, product: FloatArray) -> FloatArray:
    """The margin m > 0 of smoothed joints, (m − a) m = product, for the one a that they have without products, (n,)."""
    root = np.sqrt(above * above + 4.0 * product)
    return np.asarray(np.where(above > 0.0, 0.5 * (above + root), 2.0 * product / (root + np.abs(above))))
