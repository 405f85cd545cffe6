"""From model, contacts and load case to the program of the convex contact model.

The convex contact model keeps the contact forces at the corners of the interfaces, each in its own cone: they hold the
force point of an interface inside its outline, exactly for any convex outline, and tie shear to where the pressure is.
Conditions on the six resultants of every interface are added: torsion, and crushing in place of the crushing of points.
An associative load factor is therefore never above that of the concave model, and equal where no interface twists.

Every condition lets its interface move by itself (see :mod:`mbla.program.resultants.conditions`). Its unknowns ψ stand
behind the velocities of the blocks, as if they were blocks too: rows "−W R x = cost" below the equilibrium matrix, R
being the map from contact forces to resultants, W = motionᵀ.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.program.assemble import assemble
from mbla.program.kinematic import KinematicForm, kinematic_form
from mbla.program.program import Program
from mbla.program.reductions.steps import ProgramSize
from mbla.program.resultants.conditions import ConditionRows, joined
from mbla.program.resultants.crushing import CrushingLimits, crushing_limits, crushing_rows, crushing_violation
from mbla.program.resultants.shapes import InterfaceShapes, interface_shapes, local_points
from mbla.program.resultants.torsion import TorsionLimits, torsion_limits, torsion_rows
from mbla.program.yield_conditions import YieldLimits


@dataclass(frozen=True)
class InterfaceStrengths:
    """Strengths of all interfaces, (n_interfaces,) each, in the unit of force of the program.

    friction, cohesion   : μ and cA that torsion has; zero where torsion is not limited
    tension, compression : f_t A and f_c A, the latter inf where it is unlimited
    """

    friction: FloatArray
    cohesion: FloatArray
    tension: FloatArray
    compression: FloatArray


@dataclass(frozen=True)
class ConvexProgram:
    """One load case with conditions on interfaces, non-dimensional as ``Program``.

    contact_model : ``convex`` with torsion, ``concave`` without
    points     : the program of the contact points alone, which do not crush
    shapes     : of the interfaces, in the deck's units
    strengths  : of the interfaces
    interface_of_point : (n_points,)
    resultants : (6 n_interfaces, 3 n_points) from contact forces to N, T1, T2 and moments about normal, tangent 1 and
                 tangent 2 at the centroid; lengths in the deck's units
    """

    contact_model: str
    points: Program
    shapes: InterfaceShapes
    strengths: InterfaceStrengths
    interface_of_point: IntArray
    resultants: sp.csr_array

    @cached_property
    def torsion(self) -> TorsionLimits:
        """What bounds the torsion of interfaces."""
        return torsion_limits(self.shapes, self.strengths.friction, self.strengths.cohesion)

    @cached_property
    def crushing(self) -> CrushingLimits:
        """What bounds the normal forces and moments of interfaces."""
        return crushing_limits(self.shapes, self.strengths.compression, self.strengths.tension)

    @cached_property
    def conditions(self) -> tuple[ConditionRows, ConditionRows]:
        """Torsion, crushing as rows."""
        n = self.n_interfaces
        return torsion_rows(self.torsion, n), crushing_rows(self.crushing, n)

    @cached_property
    def program(self) -> Program:
        """The program of the points with the unknowns of the conditions behind the velocities of the blocks."""
        rows, points = joined(self.conditions), self.points
        motion = -(rows.motion.T @ self.resultants)
        return replace(
            points,
            equilibrium_matrix=sp.csr_array(sp.vstack([points.equilibrium_matrix, motion])),
            dead_load=np.concatenate([points.dead_load, -rows.cost]),
            live_load=np.concatenate([points.live_load, np.zeros(len(rows.cost))]),
        )

    @property
    def n_interfaces(self) -> int:
        """Number of interfaces."""
        return len(self.shapes.radii)

    @property
    def n_block_rows(self) -> int:
        """Velocities of the free blocks; those of the conditions follow."""
        return len(self.points.dead_load)

    def resultants_of(self, forces: FloatArray) -> FloatArray:
        """Resultants of the interfaces, (n_interfaces, 6), from contact forces, (n_points, 3)."""
        return np.asarray((self.resultants @ forces.ravel()).reshape(-1, 6))

    def own_velocities(self, moved: FloatArray, motions: FloatArray) -> FloatArray:
        """What the motions of the interfaces leave of the velocities of their points, both (n_points, 3).

        motions : (n_interfaces, 2, 6), see ``flows``
        """
        return np.asarray(moved - (self.resultants.T @ motions.sum(axis=1).ravel()).reshape(-1, 3))

    def flows(self, velocities: FloatArray) -> FloatArray:
        """Motion of every interface by torsion and by crushing, (n_interfaces, 2, 6), in the program's units."""
        of_torsion, of_crushing = self.conditions
        psi = velocities[self.n_block_rows :]
        n_torsion = of_torsion.motion.shape[1]
        motions = (of_torsion.motion @ psi[:n_torsion], of_crushing.motion @ psi[n_torsion:])
        return np.stack([motion.reshape(-1, 6) for motion in motions], axis=1)

    def with_crushing_of(self, interfaces: BoolArray) -> ConvexProgram:
        """The program in which only some interfaces that can crush, (n_interfaces,), do: nothing limits the others."""
        compression = np.where(interfaces, self.strengths.compression, np.inf)
        return replace(self, strengths=replace(self.strengths, compression=compression))

    def in_unit_of_force(self, unit: float) -> ConvexProgram:
        """The program with forces in a unit given in its own; velocities and motions stay what they are."""
        if unit == 1.0:
            return self
        own = self.strengths
        cohesion, tension, compression = (force / unit for force in (own.cohesion, own.tension, own.compression))
        strengths = InterfaceStrengths(own.friction, cohesion, tension, compression)
        return replace(self, points=self.points.in_unit_of_force(unit), strengths=strengths)


def assemble_convex(model: Model, contacts: Contacts, load_case: LoadCase, contact_model: str) -> ConvexProgram:
    """Build the program of one load case with conditions on interfaces: crushing, and torsion where that is asked for.

    contact_model : ``convex`` with torsion; ``concave`` without: shear is that of the points alone
    """
    program = assemble(model, contacts, load_case, own=False)  # interface resultants are in the common unit
    laws = [model.joints[contacts.joint_names[joint]] for joint in contacts.joints]
    scale = contacts.areas / program.scaling.force
    shear = float(contact_model == "convex")
    return ConvexProgram(
        contact_model=contact_model,
        points=replace(program, limits=without_crushing(program.limits, contacts)),
        shapes=interface_shapes(contacts),
        strengths=InterfaceStrengths(
            friction=shear * np.array([law.friction for law in laws]),
            cohesion=shear * np.array([law.cohesion for law in laws]) * scale,
            tension=np.array([law.tensile_strength for law in laws]) * scale,
            compression=np.array([law.compressive_strength for law in laws]) * scale,
        ),
        interface_of_point=contacts.interface_of_point,
        resultants=resultants_map(contacts),
    )


def near_crushing(convex: ConvexProgram, forces: FloatArray) -> BoolArray:
    """Interfaces that forces, (n_points, 3), bring beyond what they carry or near to it, (n_interfaces,)."""
    found, resultants = np.zeros(convex.n_interfaces, dtype=bool), convex.resultants_of(forces)
    rows = convex.crushing.interfaces
    carried = resultants[rows, 0] + convex.crushing.tension
    found[rows] = crushing_violation(convex.crushing, resultants) > -NEAR * np.maximum(carried, 0.0)
    return found


NEAR = 0.02
"""Share of the normal force that an interface has left from which on it is far from crushing."""


def resultants_map(contacts: Contacts) -> sp.csr_array:
    """The map from contact forces to the resultants of the interfaces, (6 n_interfaces, 3 n_points)."""
    arms = local_points(contacts)
    arms[np.abs(arms) < 1e-14 * np.hypot(*arms.T).max(initial=0.0)] = 0.0
    x1, x2 = arms.T
    interface = contacts.interface_of_point
    point = np.arange(len(interface))
    one = np.ones(len(interface))
    # N, T1, T2; M_n = x1 T2 − x2 T1; M_1 = x2 N; M_2 = −x1 N
    terms = [(0, 0, one), (1, 1, one), (2, 2, one), (3, 2, x1), (3, 1, -x2), (4, 0, x2), (5, 0, -x1)]
    rows = np.concatenate([6 * interface + row for row, _, _ in terms])
    columns = np.concatenate([3 * point + column for _, column, _ in terms])
    values = np.concatenate([value for _, _, value in terms])
    shape = (6 * len(contacts), 3 * len(interface))
    return sp.csr_array(sp.coo_array((values, (rows, columns)), shape=shape))


STABILISING, AT_MOST = 1e-9, 1e-7
"""Weight of ½ ‖x‖² in the stabilised form, per free block, and its greatest value. Unknowns of conditions fill the KKT
matrix so that its factors, taken without pivoting, break down at 400 blocks without it. Velocities are small (the
square of their norm is about one over the number of blocks), so that the load factor moves by less than 1e-8."""


OF_CRUSHING = 1e-4
"""Share of that weight on multipliers of crushing: with all of it the load factor of eight blocks with a strength of
8 MPa moved by 5e-5."""


def convex_form(convex: ConvexProgram, stabilised: float = 0.0, *, reduce_dry: bool = True) -> KinematicForm:
    """The kinematic form of the program, its conditions as further rows.

    stabilised : share of the small quadratic term; without it, unbounded programs have rays. In another unit of force 1
                 over that unit: velocities are the same in every unit, powers are not
    """
    form = kinematic_form(convex.program, convex.program.limits, reduce_dry=reduce_dry)
    base = form.cone_program
    rows = joined(convex.conditions)
    n_others = base.matrix.shape[1] - len(convex.program.dead_load)
    cones = sp.hstack(
        [
            sp.csr_array((rows.cones.shape[0], convex.n_block_rows)),
            -rows.cones,
            sp.csr_array((rows.cones.shape[0], n_others)),
        ]
    )
    matrix = sp.csc_array(sp.vstack([base.matrix, cones]))
    matrix.eliminate_zeros()
    matrix.sort_indices()
    cone_program = replace(
        base,
        matrix=matrix,
        rhs=np.concatenate([base.rhs, np.zeros(rows.cones.shape[0])]),
        further_cones=tuple(rows.cone_sizes.tolist()),
        quadratic=stabilised * _stabilising(convex, matrix.shape[1]) if stabilised else None,
    )
    return replace(form, cone_program=cone_program)


def _stabilising(convex: ConvexProgram, n_unknowns: int) -> FloatArray:
    """Weights of the quadratic term: those of crushing, whose multipliers are large, hardly count."""
    weights = np.full(n_unknowns, min(STABILISING * len(convex.points.facts.free), AT_MOST))
    first = convex.n_block_rows + convex.conditions[0].motion.shape[1]
    weights[first : first + convex.conditions[1].motion.shape[1]] *= OF_CRUSHING
    return weights


def without_crushing(limits: YieldLimits, contacts: Contacts) -> YieldLimits:
    """Limits of points that do not crush by themselves; ties keep theirs."""
    return replace(limits, compression=np.where(contacts.tie_points, limits.compression, np.inf))


def size_of_convex(convex: ConvexProgram) -> ProgramSize:
    """Unknowns of the conditions are velocities too, and their cones count in addition to the friction cones."""
    program = convex.program
    unknowns = len(program.dead_load)
    conditions = sum(int(np.count_nonzero(rows.cone_sizes > 1)) for rows in convex.conditions)
    return ProgramSize(
        unknowns=unknowns,
        cones=program.n_points + conditions,
        entries=int(program.equilibrium_matrix.nnz),
        largest=unknowns,
    )
