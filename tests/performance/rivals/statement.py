"""The published statement as a user would write it from the contacts, in N and m, in space or in a plane.

Portioli et al. 2014, doi:10.1016/j.compstruc.2014.07.010::

    max λ   subject to   A x + f_D + λ f_L = 0,   n ≥ 0,   ‖t‖ ≤ μ n   at every contact point

It shares no code with the program stage of mbla. The plane is x–z, as in the walls and arches of the standard set.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model

IN_PLANE = (0, 2, 4)
"""Of force and moment x, y, z: the components that a plane structure has."""

SAME_PLACE = 1e-9
"""Relative to the size of the structure: points of an interface that lie one behind the other."""


@dataclass(frozen=True)
class Statement:
    """In the deck's units; the unknown forces are x = (all n, all t1, all t2), without t2 in a plane.

    matrix     : A, (rows, components × n_points); rows are 6 or 3 for each free block
    dead, live : (rows,)
    friction   : (n_points,) μ
    components : 3, or 2 in a plane
    unit       : (rows,) size of each row: the mean block weight, times the mean block size in rows of moments
    """

    matrix: sp.csr_array
    dead: FloatArray
    live: FloatArray
    friction: FloatArray
    components: int
    unit: FloatArray

    @property
    def weight(self) -> float:
        """Mean load of a block."""
        return float(self.unit[0])

    def residual(self, forces: FloatArray, load_factor: float) -> float:
        """Largest lack of balance, tension or excess of shear over friction, over the mean block weight."""
        balance = np.abs(self.matrix @ forces + self.dead + load_factor * self.live) / self.unit
        n, *t = forces.reshape(self.components, -1)
        excess = np.linalg.norm(t, axis=0) - self.friction * n
        return float(max(balance.max(), excess.max() / self.weight, -n.min() / self.weight, 0.0))

    def scaled(self) -> Statement:
        """The same with the mean weight and the mean block size as units; load factors stay as they are."""
        by = sp.diags_array(1.0 / self.unit)
        matrix = sp.csr_array(by @ self.matrix) * self.weight
        ones = np.ones_like(self.unit)
        return Statement(matrix, self.dead / self.unit, self.live / self.unit, self.friction, self.components, ones)


def statement_of(model: Model, contacts: Contacts, load_case: LoadCase, *, planar: bool) -> Statement:
    """Equilibrium of the free blocks under the contact forces; planar: as seen along y."""
    friction = np.array([model.joints[name].friction for name in contacts.joint_names])
    interface = contacts.interface_of_point
    kept = _one_of_each_place(contacts) if planar else np.arange(len(interface))
    interface, frames = interface[kept], contacts.frames[kept]
    directions = [frames[:, 0], frames[:, 1], frames[:, 2]]
    if planar:
        directions = [frames[:, 0], np.cross(frames[:, 0], [0.0, 1.0, 0.0])]
    rows = list(IN_PLANE) if planar else list(range(6))
    columns = [_columns(model, contacts, kept, along)[:, rows] for along in directions]
    free = model.free
    size = float(model.blocks.sizes[free].mean())
    weight = float(np.linalg.norm(load_case.dead_load[free, :3], axis=1).mean())
    unit = weight * np.where(np.asarray(rows) < 3, 1.0, size)
    return Statement(
        matrix=_assembled(model, contacts.bodies[interface], columns),
        dead=load_case.dead_load[free][:, rows].ravel(),
        live=load_case.live_load[free][:, rows].ravel(),
        friction=friction[contacts.joints[interface]],
        components=len(directions),
        unit=np.tile(unit, len(free)),
    )


def _one_of_each_place(contacts: Contacts) -> IntArray:
    """One contact point of those that coincide seen along y, in the order of the points."""
    place = contacts.points[:, [0, 2]]
    size = float(np.ptp(place, axis=0).max())
    place = np.round(place / (SAME_PLACE * size))
    keys = np.column_stack([contacts.interface_of_point, place])
    return np.sort(np.unique(keys, axis=0, return_index=True)[1])


def _columns(model: Model, contacts: Contacts, kept: IntArray, along: FloatArray) -> FloatArray:
    """(2 × n_points, 6): force and moment of a unit force along a direction on body b, and of its reaction on a."""
    bodies = contacts.bodies[contacts.interface_of_point[kept]]
    points = contacts.points[kept]
    centroids = np.vstack([model.blocks.centroids, np.zeros((len(model.grounds), 3))])
    both = []
    for side, sign in ((1, 1.0), (0, -1.0)):
        arm = points - centroids[bodies[:, side]]
        both.append(sign * np.hstack([along, np.cross(arm, along)]))
    return np.concatenate(both)


def _assembled(model: Model, bodies: IntArray, columns: list[FloatArray]) -> sp.csr_array:
    """A from the columns of every direction; rows of bodies that do not move are left out."""
    free = model.free
    row_of_body = np.full(len(model.blocks) + len(model.grounds), -1)
    row_of_body[free] = np.arange(len(free))
    block = np.concatenate([row_of_body[bodies[:, 1]], row_of_body[bodies[:, 0]]])
    n_points, n_rows = len(bodies), columns[0].shape[1]
    point = np.tile(np.arange(n_points), 2)
    moves = block >= 0
    rows = (n_rows * block[moves, None] + np.arange(n_rows)).ravel()
    values = np.concatenate([column[moves].ravel() for column in columns])
    places = [np.repeat(point[moves] + n_points * j, n_rows) for j in range(len(columns))]
    shape = (n_rows * len(free), n_points * len(columns))
    entries = (values, (np.tile(rows, len(columns)), np.concatenate(places)))
    return sp.csr_array(sp.coo_array(entries, shape=shape))
