"""The control point of a pushover: whose displacement is counted, and in which direction."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.model import LoadCase, Model
from mbla.model.pose import Pose

MOVES = 1e-3
"""Speed of a block, over the greatest, from which it moves: for the control point that is not given."""


NO_SHARE = 1e-9
"""Live load on a block, over that on all, that is none, so that it has no place where it acts."""


@dataclass(frozen=True)
class Control:
    """Whose displacement is followed: the mean of points of blocks, along a direction.

    blocks, points : (m,), (m, 3) as built
    weights        : (m,), 1 in sum
    direction      : (3,), unit
    """

    blocks: IntArray
    points: FloatArray
    weights: FloatArray
    direction: FloatArray

    @staticmethod
    def of(model: Model, case: LoadCase, mechanism: FloatArray) -> Control:
        """What a load case asks for, of a settlement its support, else what moves in a mechanism, (n_blocks, 6)."""
        assert case.pushover is not None  # else nothing is pushed
        asked, control = case.pushover, Control.of_moving(model, case, mechanism)
        if len(asked.blocks):
            control = replace(control, blocks=asked.blocks, **_centre(model, asked.blocks))
        return replace(control, direction=asked.direction) if np.isfinite(asked.direction).all() else control

    @staticmethod
    def of_moving(model: Model, case: LoadCase, mechanism: FloatArray) -> Control:
        """Centre of the live load on what moves in a mechanism, (n_blocks, 6), along it: of masses their centroid."""
        assert case.pushover is not None  # else nothing is pushed
        speed = np.linalg.norm(mechanism[:, :3], axis=1)
        moves = np.flatnonzero(speed > MOVES * speed.max())
        loads = case.question.pushed(case.live_load)[moves, :3]
        along = loads.sum(axis=0)
        size = float(np.linalg.norm(along))
        if size > 0.0:  # by its share of the live load, where that acts: so the control point does the work of it
            along = along / size
            shares = loads @ along
            acts = np.abs(shares) > NO_SHARE * size
            every = case.pushover.live_levers + case.pushover.live_following_levers
            levers = every[moves].reshape(-1, 3, 3) @ along
            arms = np.where(acts[:, None], levers / np.where(acts, shares, 1.0)[:, None], 0.0)
            return Control(moves, model.blocks.centroids[moves] + arms, shares / size, along)
        own = _centre(model, moves)
        direction = own["weights"] @ mechanism[moves, :3]
        return Control(moves, direction=direction / np.linalg.norm(direction), **own)

    def displacement(self, model: Model, pose: Pose) -> float:
        """So far, m."""
        return float(self.weights @ pose.displacements(model.blocks, self.blocks, self.points) @ self.direction)

    def speed(self, model: Model, pose: Pose, mechanism: FloatArray) -> float:
        """Of the points, with velocities (n_blocks, 6)."""
        own, arms = mechanism[self.blocks], self.points - model.blocks.centroids[self.blocks]
        turned = np.einsum("nij,nj->ni", pose.rotation[self.blocks], arms)
        return float(self.weights @ (own[:, :3] + np.cross(own[:, 3:], turned)) @ self.direction)


def _centre(model: Model, blocks: IntArray) -> dict[str, FloatArray]:
    """Points and weights of which the mean is the common centroid of blocks."""
    masses = model.blocks.masses[blocks]
    masses = masses if masses.any() else model.blocks.volumes[blocks]
    return {"points": model.blocks.mass_centres[blocks], "weights": masses / masses.sum()}
