"""Greatest values of a structure in time, from every step of the deck, and where it comes to stay."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.model.pose import Pose
from mbla.solution.time_history.as_built import CornersAsBuilt
from mbla.solution.time_history.history import Peaks

FALLEN, TILTED = 0.5, float(np.cos(np.radians(60.0)))
"""Of the height of a block, by which it is lower when it has fallen; cosine of the tilt from which it has, too: a block
that turns over on the ground is lower by less. A cell of soil is no block: of it the height is that of its soil as a
whole, and its tilt does not count."""


@dataclass
class Greatest:
    """So far.

    rest    : pose of the blocks at rest
    down    : (3,) direction of the dead load
    corners : of all interfaces
    last    : shifts of the last poses, by which the residual displacement still varies
    """

    model: Model
    rest: Pose
    down: FloatArray
    corners: CornersAsBuilt
    last: deque[FloatArray]
    displacements: FloatArray
    times: FloatArray
    rotations: FloatArray
    openings: FloatArray
    slips: FloatArray
    falling: FloatArray

    @staticmethod
    def of(model: Model, contacts: Contacts, rest: Pose, down: FloatArray, window: int) -> Greatest:
        """Before the first step; how much the residual displacement varies is taken of as many poses as ``window``."""
        n, corners = len(model.blocks), CornersAsBuilt.of(model.blocks, contacts)
        opening, slip = (np.maximum(each, 0.0) for each in corners.apart(rest))
        last: deque[FloatArray] = deque([rest.shift], maxlen=max(window, 1))
        moved, times, turned = np.zeros((3, n))
        return Greatest(model, rest, down, corners, last, moved, times, turned, opening, slip, np.full(n, np.nan))

    def after(self, found: Peaks, last: FloatArray) -> Greatest:
        """The same after values that are on record, and the last poses, (m, n_blocks, 3)."""
        return replace(
            self,
            displacements=found.displacements.copy(),
            times=found.times.copy(),
            rotations=found.rotations,
            openings=found.openings,
            slips=found.slips,
            falling=found.falling.copy(),
            last=deque(last, maxlen=self.last.maxlen),
        )

    def add(self, there: Pose, time: float) -> None:
        """A pose of the blocks."""
        moved = there.shift - self.rest.shift
        size = np.linalg.norm(moved, axis=1)
        more = size > self.displacements
        self.displacements[more], self.times[more] = size[more], time
        turn = np.einsum("nij,nij->n", there.rotation, self.rest.rotation)
        self.rotations = np.maximum(self.rotations, np.arccos(np.clip(0.5 * (turn - 1.0), -1.0, 1.0)))
        opening, slip = self.corners.apart(there)
        self.openings, self.slips = np.maximum(self.openings, opening), np.maximum(self.slips, slip)
        upright = ((self.down @ there.rotation) * (self.down @ self.rest.rotation)).sum(axis=1)
        fallen = (moved @ self.down > FALLEN * self.heights) | self._of_its_own & (upright < TILTED)
        self.falling[fallen & np.isnan(self.falling)] = time
        self.last.append(there.shift)

    @cached_property
    def heights(self) -> FloatArray:
        """Of the blocks along the dead load, (n_blocks,); of a cell that of its soil."""
        blocks = self.model.blocks
        along, first = blocks.vertices @ self.down, blocks.vertex_start[:-1]
        low, high = np.maximum.reduceat(along, first), np.minimum.reduceat(along, first)
        for soil in self.model.soils:
            low[soil.blocks], high[soil.blocks] = low[soil.blocks].max(), high[soil.blocks].min()
        return np.asarray(low - high)

    @cached_property
    def _of_its_own(self) -> BoolArray:
        """Blocks that are no cells of soil, (n_blocks,)."""
        return np.asarray(self.model.soil_of_block < 0)

    def result(self, there: Pose) -> Peaks:
        """With the residual displacements, and the pose of the blocks that is the last of all."""
        shifts = np.stack(self.last) - self.rest.shift
        wanders = np.linalg.norm(shifts - shifts[-1], axis=2).max(axis=0)
        return Peaks(
            displacements=self.displacements.copy(),
            times=self.times.copy(),
            rotations=self.rotations,
            residuals=np.linalg.norm(shifts[-1], axis=1),
            ends=np.hstack([there.shift, there.rotation_vectors]),
            wanders=wanders,
            openings=self.openings,
            slips=self.slips,
            falling=self.falling.copy(),
        )
