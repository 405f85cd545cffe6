"""Ties among the joints of a structure that moves: their entries of A, constant forces and stretches at a pose."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.pose import Pose
from mbla.model.ties.moved import tie_lengths
from mbla.model.ties.ties import Ties
from mbla.solution.pushover.pose.structure import PushedStructure


@dataclass(frozen=True)
class TiesAtPose:
    """Ties that are left.

    contacts : with them
    built    : as built
    rows     : (n_ties,) of the ties of the model
    places, bodies : points of ties on free solids, and these solids
    """

    structure: PushedStructure
    contacts: Contacts
    built: Ties
    rows: IntArray
    places: IntArray
    bodies: IntArray

    @staticmethod
    def of(structure: PushedStructure, contacts: Contacts, rows: IntArray, row_of_solid: IntArray) -> TiesAtPose:
        """Those of some rows; ``row_of_solid`` is −1 of what is not free, at its end of what is outside."""
        built = structure.model.ties.take(rows)
        solid = np.append(structure.solids.label, -1)[built.bodies]  # OUTSIDE takes the last entry, here and below
        free = np.flatnonzero(row_of_solid[solid] >= 0)
        return TiesAtPose(structure, contacts, built, rows, free, solid[free])

    def at(self, pose: Pose) -> Ties:
        """There."""
        return self.structure.ties_at(pose).take(self.rows) if len(self.rows) else self.built

    def entries(self, ties: Ties, centres: FloatArray) -> FloatArray:
        """Of A, six rows of each place, side by side."""
        own = self.contacts.ties
        if own is None:
            return np.zeros(0)
        force = own.senses[ties.tie_of_point[self.places], None] * ties.pulls[self.places]
        arm = ties.places[self.places] - centres[self.bodies]
        return np.hstack([force, np.cross(arm, force)]).ravel()

    def prestress_load(self, ties: Ties, centres: FloatArray) -> FloatArray:
        """What ties do with the force that they always have, (n_solids, 6)."""
        own, total = self.contacts.ties, np.zeros((self.structure.n_solids, 6))
        if own is not None and own.offsets.any():
            shares = own.offsets[ties.tie_of_point[self.places], None]
            np.add.at(total, self.bodies, shares * self.entries(ties, centres).reshape(-1, 6))
        return total

    def offsets(self, ties: Ties) -> FloatArray:
        """(n_ties, 3) m: how much shorter those are that pull, and how much longer that push."""
        own = self.contacts.ties
        if own is None:
            return np.zeros((0, 3))
        lengths = tie_lengths(ties) - tie_lengths(self.built)
        fill = ties.of_fill
        if fill.any():
            moved = ((ties.places - self.built.places) * ties.pulls).sum(axis=1)
            lengths[fill] = -np.bincount(ties.tie_of_point, moved, len(ties))[fill]
        offsets = np.zeros((len(ties), 3))
        offsets[:, 0] = -own.senses * lengths
        return offsets
