"""Interfaces with a motion of their own in a reduced program: which rows that makes, and what their crushing bounds.

An interface that crushes moves by ψ between the springs of its points and one of its blocks. With the resultants r of
the pieces that act there side by side, rows stand behind those of the blocks::

    Σ r − R x = 0,   R from the contact forces of the program to resultants about the centroid of the interface

so that its points have the velocities Aᵀu − Rᵀψ. R comes from the full model through all reductions: the points of a
planar program stand for several, and an interface and its image move alike there and are one.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.model.solids.convex import signed_areas
from mbla.model.solids.measures import connected_labels
from mbla.program.program import Program
from mbla.program.resultants.shapes import (
    SOLID,
    InterfaceShapes,
    interface_shapes,
    local_points,
    outer_boundaries,
)
from mbla.program.resultants.stress_blocks import Pieces, Plates, pieces_in_plane, pieces_in_space, with_conditions

NONE = 1e-12
"""Entry of R, over the largest, that is rounding."""


@dataclass(frozen=True)
class CrushingInterfaces:
    """Interfaces of a model, some of which crush as stress blocks.

    shapes      : of all interfaces
    outlines    : (n_corners, 2) outer boundaries, from the centroids [m], and where each starts, (n_interfaces + 1,)
    areas       : (n_interfaces,) [m²]
    places      : (n_points, 2) of the points in their interfaces, from the centroid [m]
    interface_of_point : (n_points,)
    compression : (n_interfaces,) f_c A, inf where it is unlimited [force of the deck]
    tension     : (n_interfaces,) f_t A [force of the deck]
    """

    shapes: InterfaceShapes
    outlines: tuple[FloatArray, IntArray]
    areas: FloatArray
    places: FloatArray
    interface_of_point: IntArray
    compression: FloatArray
    tension: FloatArray

    @classmethod
    def of(cls, model: Model, contacts: Contacts) -> CrushingInterfaces:
        """By the joint laws of a model; ties are no interfaces."""
        laws = [model.joints[contacts.joint_names[joint]] for joint in contacts.joints]
        strength = np.array([law.compressive_strength for law in laws])
        strength[contacts.n_surfaces :] = np.inf
        return cls.with_strengths(contacts, strength, np.array([law.tensile_strength for law in laws]))

    @classmethod
    def with_strengths(cls, contacts: Contacts, compressive: FloatArray, tensile: FloatArray) -> CrushingInterfaces:
        """With strengths of each interface, (n_interfaces,) [stress of the deck].

        Raises ValueError where one that can crush has holes.
        """
        shapes, outlines = interface_shapes(contacts), outer_boundaries(contacts)
        full = signed_areas(*outlines) <= contacts.areas * (1.0 + SOLID)
        if not (full | ~np.isfinite(compressive))[: contacts.n_surfaces].all():
            raise ValueError("an interface that can crush has holes: it has to come in pieces")
        return cls(
            shapes=shapes,
            outlines=outlines,
            areas=contacts.areas,
            places=local_points(contacts),
            interface_of_point=contacts.interface_of_point,
            compression=np.asarray(compressive * contacts.areas),
            tension=np.asarray(tensile * contacts.areas),
        )

    def outline(self, row: int) -> FloatArray:
        """Corners of an interface, (n_corners, 2) [m]; of a convex one those alone at which it turns."""
        corners, start = (self.shapes.corners, self.shapes.start) if self.shapes.convex[row] else self.outlines
        return corners[start[row] : start[row + 1]]

    @property
    def radii(self) -> FloatArray:
        """ρ = √A, (n_interfaces,) [m]."""
        return np.asarray(np.sqrt(self.areas))


@dataclass(frozen=True)
class CrushingOfProgram:
    """Interfaces of a program that crush.

    resultants : R, (components n, components n_points) in the unit of force of the program
    motions    : (6 n_interfaces, components n) from ψ to motions of the interfaces of the model, dual to their
                 resultants
    pieces     : each kind by itself, owners numbered by the rows of R
    points     : (n_points,) which belong to them
    """

    resultants: sp.csr_array
    motions: sp.csr_array
    pieces: tuple[Pieces, ...]
    points: BoolArray


def tidied(map_: sp.csr_array) -> sp.csr_array:
    """A map without entries that are rounding of zero."""
    found = sp.csr_array(map_)
    found.data[np.abs(found.data) < NONE * np.abs(found.data).max(initial=0.0)] = 0.0
    found.eliminate_zeros()
    return found


def crushing_of(program: Program, interfaces: CrushingInterfaces) -> CrushingOfProgram | None:
    """Interfaces of a program, reduced or not, that crush; None where there are none."""
    full, forces = program.full, program.lift.forces
    chosen = np.isfinite(interfaces.compression)
    here = chosen[interfaces.interface_of_point] & (np.diff(forces[::3].indptr) > 0)
    if not here.any():
        return None
    seen = _in_plane if program.components == 2 else _in_space
    map_, motions, owners, plates = seen(interfaces, full, forces, here)
    unit = float(np.abs(map_[:: program.components].data).max())
    map_ = tidied(sp.csr_array(map_ / unit))
    of_force = full.scaling.force * unit
    n = map_.shape[0] // program.components
    rows = np.flatnonzero(owners >= 0)
    tension = np.bincount(owners[rows], interfaces.tension[rows], n) / of_force
    strength = np.bincount(owners[rows], interfaces.compression[rows], n) / of_force + tension
    pieces = tuple(with_conditions(plate, kind, strength, tension) for kind, plate in plates if len(plate.owner))
    points = np.zeros(program.n_points, dtype=bool)
    points[np.unique(map_.indices) // program.components] = True
    return CrushingOfProgram(map_, sp.csr_array(motions / unit), pieces, points)


Seen = tuple[sp.csr_array, sp.csr_array, IntArray, tuple[tuple[str, Plates], ...]]
"""R, motions of the interfaces, the row of R to which each interface belongs, (n_interfaces,), −1 where none, and
pieces by their kind."""


def _in_space(interfaces: CrushingInterfaces, full: Program, forces: sp.csr_array, here: BoolArray) -> Seen:
    rows, owner_of_point = np.unique(interfaces.interface_of_point[here], return_inverse=True)
    owners = np.full(len(interfaces.areas), -1)
    owners[rows] = np.arange(len(rows))
    arms = interfaces.places[here] / interfaces.radii[interfaces.interface_of_point[here], None]
    map_ = _sums(owner_of_point, here, full, forces, [np.ones(len(arms)), *arms.T])
    outlines = [interfaces.outline(row) for row in rows.tolist()]
    flat, triangles = pieces_in_space(interfaces.shapes, outlines, rows, interfaces.radii)
    motions = _motions(owners, [(np.eye(2)[k], interfaces.radii) for k in (0, 1)])
    return map_, motions, owners, (("parallelogram", flat), ("triangle", triangles))


def _in_plane(interfaces: CrushingInterfaces, full: Program, forces: sp.csr_array, here: BoolArray) -> Seen:
    """An interface and its image share points of the program, and are one: widths along the plane add up."""
    points = np.flatnonzero(here)
    interface = interfaces.interface_of_point[points]
    stands_for = np.asarray(forces[3 * points].tocsr().indices // 2, dtype=np.int64)
    shear = forces[:, 1::2].tocsr()
    sheared = np.column_stack([shear[3 * points + row].sum(axis=1) for row in (1, 2)])
    direction = np.asarray(sheared / np.hypot(*sheared.T)[:, None], dtype=np.float64)
    rows, first, place = np.unique(interface, return_index=True, return_inverse=True)
    along = direction[first]
    s = np.asarray((interfaces.places[points] * along[place]).sum(axis=1))
    leader = np.full(forces.shape[1] // 2, -1)
    leader[stands_for[::-1]] = place[::-1]  # the first interface that has each point of the program
    group = connected_labels(np.column_stack([place, leader[stands_for]]), len(rows))
    turned = _turned(s, stands_for, place, leader, len(rows))
    along, s = np.asarray(along * turned[:, None]), s * turned[place]
    owners = np.full(len(interfaces.areas), -1)
    owners[rows] = group
    radii = np.sqrt(np.bincount(group, interfaces.areas[rows]))
    map_ = _sums(group[place], here, full, forces, [np.ones(len(s)), s / radii[group[place]]])
    outlines: list[list[FloatArray]] = [[] for _ in radii]
    for row, (a, b), owner in zip(rows.tolist(), along.tolist(), group.tolist(), strict=True):
        outlines[owner].append(interfaces.outline(row) @ np.array([[a, -b], [b, a]]))
    strips, ramps = pieces_in_plane(outlines, radii)
    ways = np.zeros((len(owners), 2))
    ways[rows] = along
    motions = _motions(owners, [(ways, radii[np.maximum(owners, 0)])])
    return map_, motions, owners, (("strip", strips), ("triangle", ramps))


def _motions(owners: IntArray, moments: list[tuple[FloatArray, FloatArray]]) -> sp.csr_array:
    """Opening and rotations in the plane of each interface, from ψ of the row to which it belongs.

    owners  : (n_interfaces,) −1 where none
    moments : directions, (2,) or (n_interfaces, 2), of the place that each moment takes normal forces by, and lengths
              ρ, (n_interfaces,), that it is over
    """
    seen, size = np.flatnonzero(owners >= 0), 1 + len(moments)
    first, column = 6 * seen, size * owners[seen]
    entries = [(first, column, np.ones(len(seen)))]
    for number, (way, radii) in enumerate(moments, start=1):
        one, two = np.broadcast_to(way, (len(owners), 2))[seen].T / radii[seen]
        entries += [(first + 4, column + number, two), (first + 5, column + number, -one)]
    row, place, values = (np.concatenate(parts) for parts in zip(*entries, strict=True))
    shape = (6 * len(owners), size * (int(owners.max()) + 1))
    return sp.csr_array(sp.coo_array((values, (row, place)), shape=shape))


def _turned(s: FloatArray, stands_for: IntArray, place: IntArray, leader: IntArray, n: int) -> FloatArray:
    """−1 for interfaces that see the plane the other way round than the first that has their points, else 1, (n,)."""
    of_first = np.zeros(len(leader))
    own = place == leader[stands_for]
    of_first[stands_for[own]] = s[own]
    return np.where(np.bincount(place, s * of_first[stands_for], n) < 0.0, -1.0, 1.0)


def _sums(
    owner: IntArray, here: BoolArray, full: Program, forces: sp.csr_array, arms: list[FloatArray]
) -> sp.csr_array:
    """Sums of normal forces with arms, one behind the other for each owner, from the forces of the program."""
    points, size = np.flatnonzero(here), len(arms)
    units = np.broadcast_to(full.scaling.units, here.shape)[points]
    row = np.concatenate([size * owner + k for k in range(size)])
    values = np.concatenate([units * arm for arm in arms])
    shape = (size * (int(owner.max()) + 1), forces.shape[0])
    return sp.csr_array(sp.csr_array(sp.coo_array((values, (row, np.tile(3 * points, size))), shape=shape)) @ forces)
