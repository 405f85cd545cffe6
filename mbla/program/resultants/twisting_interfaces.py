"""Interfaces whose shear and torsion are bounded by uniform pressure, in a reduced program: rows and given sizes.

Slip and twist of an interface are a motion ψ = (slip, slip, ρ twist) between the springs of its points and one of its
blocks, behind which stand two forces side by side: one for the share R of the shear strength V that acts as over the
full area, one for the rest S (:mod:`mbla.program.resultants.torsion`)::

    r'' + r' − Σ (t_1, t_2, (x_1 t_2 − x_2 t_1)/ρ) = 0

V, and how far the force point is off the middle, follow from the normal forces n of the points::

    V = μ Σ n + cA,    S_0 = max_k μ s_k·Σ n x
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.program.program import Program
from mbla.program.resultants.interface_motions import tidied
from mbla.program.resultants.shapes import interface_shapes, local_points
from mbla.program.resultants.torsion import TorsionLimits, reducing_slopes, torsion_limits


@dataclass(frozen=True)
class TwistingInterfaces:
    """Interfaces of a model with what bounds their torsion.

    limits : of those with friction or cohesion, forces of the deck
    places : (n_points, 2) of the points in their interfaces, from the centroid [m]
    interface_of_point : (n_points,)
    """

    limits: TorsionLimits
    places: FloatArray
    interface_of_point: IntArray

    @classmethod
    def of(cls, model: Model, contacts: Contacts) -> TwistingInterfaces:
        """By the joint laws of a model; ties are no interfaces."""
        laws = [model.joints[contacts.joint_names[joint]] for joint in contacts.joints]
        surfaces = np.arange(len(contacts)) < contacts.n_surfaces
        friction = np.array([law.friction for law in laws]) * surfaces
        cohesion = np.array([law.cohesion for law in laws]) * contacts.areas * surfaces
        limits = torsion_limits(interface_shapes(contacts), friction, cohesion)
        return cls(limits, local_points(contacts), contacts.interface_of_point)


@dataclass(frozen=True)
class TwistingOfProgram:
    """Interfaces of a program with torsion, m of them; p points at most, with weights of zero where there are less.

    resultants : (3 m, 3 n_points) from contact forces to T_1, T_2 and M/ρ
    motions    : (6 n_interfaces, 3 m) from ψ to motions of the interfaces of the model, dual to their resultants
    thetas     : (m,) θ
    points     : (m, p)
    cohesion   : (m,) cA
    pressing   : (m, p) of n in V
    offsets    : (m, k, p) of n in S_0, one of k
    """

    resultants: sp.csr_array
    motions: sp.csr_array
    thetas: FloatArray
    points: IntArray
    cohesion: FloatArray
    pressing: FloatArray
    offsets: FloatArray

    def only(self, chosen: IntArray) -> TwistingOfProgram:
        """What bounds some of the interfaces."""
        bounds = ("thetas", "points", "cohesion", "pressing", "offsets")
        return replace(self, **{name: getattr(self, name)[chosen] for name in bounds})


def twisting_of(program: Program, interfaces: TwistingInterfaces) -> TwistingOfProgram | None:
    """Interfaces of a spatial program, reduced or not, with torsion; None where there are none."""
    if program.components == 2:
        return None
    limits, full, forces = interfaces.limits, program.full, program.lift.forces
    place = np.full(int(interfaces.interface_of_point.max(initial=-1)) + 1, -1)
    place[limits.interfaces] = np.arange(len(limits.interfaces))
    owner = place[interfaces.interface_of_point]
    here = np.flatnonzero((owner >= 0) & (np.diff(forces[::3].indptr) > 0))
    chosen, owner = np.unique(owner[here], return_inverse=True)
    if not len(chosen):
        return None
    units = np.broadcast_to(full.scaling.units, interfaces.interface_of_point.shape)[here]
    x1, x2 = interfaces.places[here].T
    rho = limits.radii[chosen][owner]

    def sums(terms: list[tuple[int, int, FloatArray]], size: int) -> sp.csr_array:
        """Rows ``size`` an interface, of components of the points with factors."""
        row = np.concatenate([size * owner + row for row, _, _ in terms])
        column = np.concatenate([3 * here + component for _, component, _ in terms])
        values = np.concatenate([units * factor for _, _, factor in terms])
        map_ = sp.csr_array(sp.coo_array((values, (row, column)), shape=(size * len(chosen), forces.shape[0])))
        return sp.csr_array(map_ @ forces)

    one = np.ones(len(here))
    shear = sums([(0, 1, one), (1, 2, one), (2, 2, x1 / rho), (2, 1, -x2 / rho)], 3)
    pressing = sp.csr_array(sums([(0, 0, one)], 1)[:, ::3])
    unit = float(np.abs(pressing.data).max())
    moments = [sp.csr_array(sums([(0, 0, x)], 1)[:, ::3] / unit) for x in (x1, x2)]
    points, counts = _padded(pressing)
    slopes, friction = _slopes(limits, chosen), limits.friction[chosen]
    some = friction[:, None] * (np.arange(points.shape[1]) < counts[:, None])
    moment = np.stack([some * _taken(moment, points) for moment in moments])
    return TwistingOfProgram(
        resultants=_with_zeros(tidied(sp.csr_array(shear / unit)), pressing),
        motions=sp.csr_array(_motions(limits.interfaces[chosen], limits.radii[chosen], len(place)) / unit),
        thetas=limits.thetas[chosen],
        points=points,
        cohesion=limits.cohesion[chosen] / (full.scaling.force * unit),
        pressing=some * _taken(pressing, points) / unit,
        offsets=np.einsum("mkj,jmp->mkp", slopes, moment),
    )


def _with_zeros(resultants: sp.csr_array, pressing: sp.csr_array) -> sp.csr_array:
    """With a zero stored in each row of an interface at each of its points: one in the middle of an interface does not
    twist it, but its normal force bounds how it is twisted.

    pressing : (m, n_points)
    """
    own, each = resultants.tocoo(), pressing.tocoo()
    owner, point = (np.repeat(values, 3) for values in each.coords)
    rows = np.concatenate([own.coords[0], 3 * owner + np.tile(np.arange(3), each.nnz)])
    columns = np.concatenate([own.coords[1], 3 * point + 1])
    values = np.concatenate([own.data, np.zeros(3 * each.nnz)])
    return sp.csr_array(sp.coo_array((values, (rows, columns)), shape=resultants.shape))


def _motions(interfaces: IntArray, radii: FloatArray, n_interfaces: int) -> sp.csr_array:
    """(6 n_interfaces, 3 m): slips and rotation about the normal, from slips and ρ twist of some interfaces, (m,)."""
    m = len(interfaces)
    rows = (6 * interfaces[:, None] + np.arange(1, 4)).ravel()
    values = np.column_stack([np.ones(m), np.ones(m), 1.0 / radii]).ravel()
    return sp.csr_array(sp.coo_array((values, (rows, np.arange(3 * m))), shape=(6 * n_interfaces, 3 * m)))


def _padded(pressing: sp.csr_array) -> tuple[IntArray, IntArray]:
    """Points of each row, (m, p), filled up with its first, and how many they are, (m,)."""
    counts = np.diff(pressing.indptr).astype(np.int64)
    points = np.repeat(pressing.indices[pressing.indptr[:-1], None], int(counts.max()), axis=1).astype(np.int64)
    points[np.arange(points.shape[1]) < counts[:, None]] = pressing.indices
    return points, counts


def _taken(map_: sp.csr_array, points: IntArray) -> FloatArray:
    """Entries of each row at some points, (m, p)."""
    rows = np.broadcast_to(np.arange(len(points))[:, None], points.shape)
    return np.asarray(sp.csr_array(map_[rows, points]).toarray())


def _slopes(limits: TorsionLimits, chosen: IntArray) -> FloatArray:
    """Slopes s_k of the chosen interfaces, (m, k, 2), filled up with the first ones again."""
    slopes, counts = reducing_slopes(limits), np.diff(limits.start)[chosen]
    place = np.arange(int(counts.max())) % counts[:, None]
    return np.asarray(slopes[limits.start[chosen][:, None] + place])
