"""How far corners of interfaces that touched as built have come apart, and slid: from the poses alone."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray, starts
from mbla.contacts.contacts import Contacts
from mbla.model.pose import Pose
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.ragged import ranges


@dataclass(frozen=True)
class CornersAsBuilt:
    """Contact points as built, each as a material point of both of its bodies.

    bodies  : (n, 2) blocks, then grounds
    first   : where each interface begins among them
    points  : (n, 3) m; frames : (n, 3, 3)
    """

    blocks: Blocks
    bodies: IntArray
    first: IntArray
    points: FloatArray
    frames: FloatArray

    @staticmethod
    def of(blocks: Blocks, contacts: Contacts, interfaces: IntArray | None = None) -> CornersAsBuilt:
        """Those of interfaces of an assembly; of all unless given."""
        own = np.arange(len(contacts)) if interfaces is None else interfaces
        counts = np.diff(contacts.point_start)[own]
        rows = ranges(contacts.point_start[:-1][own], counts)
        bodies = contacts.bodies[np.repeat(own, counts)]
        return CornersAsBuilt(blocks, bodies, starts(counts)[:-1], contacts.points[rows], contacts.frames[rows])

    def apart(self, pose: Pose) -> tuple[FloatArray, FloatArray]:
        """Opening, positive where open, and slip of each interface at a pose of the blocks: its largest, (n,) m."""
        if not len(self.points):
            return np.zeros(len(self.first)), np.zeros(len(self.first))
        ends, n = [], len(self.blocks)
        for side in (0, 1):
            moved, body = np.zeros_like(self.points), self.bodies[:, side]
            on = body < n
            moved[on] = pose.displacements(self.blocks, body[on], self.points[on])
            ends.append(moved)
        turn = np.concatenate([pose.rotation, np.eye(3)[None]])[np.minimum(self.bodies[:, 0], n)]
        apart = np.einsum("nji,nj->ni", turn, ends[1] - ends[0])
        along = np.einsum("nij,nj->ni", self.frames, apart)
        slips = np.linalg.norm(along[:, 1:], axis=1)
        return np.maximum.reduceat(along[:, 0], self.first), np.maximum.reduceat(slips, self.first)
