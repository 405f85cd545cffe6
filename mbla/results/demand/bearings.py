"""Bearings: the resultant of each pressed interface on each of its two bodies, and how far it may be spread.

An even pressure whose middle is the centre of pressure reaches as far on either side of it as the interface does on the
nearer one, as in Meyerhof's effective area of footings. It is the least concentrated that balance allows, and what
joints that crush carry.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, row_of_item, starts
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.results.collapse.thrust import points_to_draw, thrust_of


@dataclass(frozen=True)
class Bearings:
    """Resultants on blocks, sorted by blocks; pressed ones alone.

    start   : (n_blocks + 1,) rows of each block
    interfaces : (m,)
    places  : (m, 3) m, centres of pressure
    forces  : (m, 3) N on the block
    pressures : (m,) N, the part of the force across the interface
    """

    start: IntArray
    interfaces: IntArray
    places: FloatArray
    forces: FloatArray
    pressures: FloatArray

    @property
    def owner(self) -> IntArray:
        """Block of each, (m,)."""
        return row_of_item(self.start)


def bearings_of(model: Model, contacts: Contacts, contact_forces: FloatArray) -> Bearings:
    """On all blocks.

    contact_forces : (n_points, 3)  N, T1, T2 [N], compression positive
    """
    n_blocks, thrust = len(model.blocks), thrust_of(model, contacts, contact_forces)
    places = points_to_draw(contacts, thrust)
    pressed = np.flatnonzero(thrust.carried)
    owner, interface = contacts.bodies[pressed].T.ravel(), np.tile(pressed, 2)
    forces = np.concatenate([-thrust.forces[pressed], thrust.forces[pressed]])
    known = owner < n_blocks
    order = np.flatnonzero(known)[np.argsort(owner[known], kind="stable")]
    start = starts(np.bincount(owner[order], minlength=n_blocks).astype(np.int64))
    rows = interface[order]
    return Bearings(start, rows, places[rows], forces[order], thrust.normal_forces[rows])


def widths_along(contacts: Contacts, interfaces: IntArray, places: FloatArray, directions: FloatArray) -> FloatArray:
    """How far an even pressure about places reaches, (n,) m, along unit directions (n, 3): twice the nearer side."""
    from_middle = np.empty((len(interfaces), 2))
    counts = np.diff(contacts.point_start)[interfaces]
    owner = np.repeat(np.arange(len(counts)), counts)
    row = (
        np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts) + contacts.point_start[interfaces][owner]
    )
    along = np.einsum("ri,ri->r", contacts.points[row] - places[owner], directions[owner])
    for side, sign in enumerate((1.0, -1.0)):
        from_middle[:, side] = 0.0
        np.maximum.at(from_middle[:, side], owner, sign * along)
    return np.asarray(2.0 * from_middle.min(axis=1))


def greatest_pressure(
    contacts: Contacts, bearings: Bearings, strengths: FloatArray, judged: BoolArray, apart: BoolArray
) -> FloatArray:
    """Greatest even pressure on the joints of each block, (n_blocks,) Pa; nan where not judged.

    A joint with a compressive strength presses by no more than that. One without presses on ``HINGE`` of it at least:
    on its very edge the pressure would have no limit, and no unit has such an edge.

    strengths : (n_interfaces,) Pa, compressive ones of joints
    apart     : (n_interfaces,) those that count
    """
    found = np.zeros(len(judged))
    chosen = np.flatnonzero(apart[bearings.interfaces])
    rows = bearings.interfaces[chosen]
    frames = contacts.frames[contacts.point_start[rows]]
    across = [widths_along(contacts, rows, bearings.places[chosen], frames[:, way]) for way in (1, 2)]
    full = [widths_along(contacts, rows, contacts.centroids[rows], frames[:, way]) for way in (1, 2)]
    share = across[0] * across[1] / (full[0] * full[1])  # of an outline that is no rectangle, as of one
    least = np.where(np.isfinite(strengths[rows]), EDGE, HINGE)
    pressures = bearings.pressures[chosen] / (np.clip(share, least, 1.0) * contacts.areas[rows])
    np.maximum.at(found, bearings.owner[chosen], np.minimum(pressures, strengths[rows]))
    return np.where(judged, found, np.nan)


HINGE = 0.1
"""least share of a joint without a compressive strength on which it presses; an assumption: a hinge may lie a twentieth
of the depth inside of the edge"""
EDGE = 1e-6
"""least share of others, which is beyond their strength"""
