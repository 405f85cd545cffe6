"""Main parts: what falls, in a few words, where a mechanism spreads over a whole wall.

A facade that is pushed out of its plane opens a little in every joint, and its rigid parts, or those taken for one
(:mod:`mbla.results.collapse.clusters`), are many. To the eye it is one plate or two that turn. Here every block is
given to that of a few rigid motions, rest among them, which its own comes nearest to, and every motion is the one that
fits its blocks best (Lloyd 1982, doi:10.1109/TIT.1982.1056489), until nothing changes. As few are taken as explain
``ENOUGH`` of the motion: of the sum of squared velocities over the volume, that is, what would be its kinetic energy.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.model import Model
from mbla.results.collapse.clusters import FEW
from mbla.results.collapse.rigid_parts import PartMotion, part_motions

ENOUGH = 0.95
"""share of the motion that the main parts are to explain"""
MOST_DIVISIONS = 50


@dataclass(frozen=True)
class MainParts:
    """The main parts of a mechanism.

    of_block  : (n_blocks,) main part of each block, 0 at rest; numbered by falling weight
    motions   : of each, as ``part_motions`` has them
    explained : share of the motion that they explain; 1 where these are the parts as told
    """

    of_block: IntArray
    motions: tuple[PartMotion, ...]
    explained: float


def main_parts(model: Model, parts: IntArray, motions: tuple[PartMotion, ...], motion: FloatArray) -> MainParts:
    """Of a mechanism, (n_blocks, 6), fewer parts than it is told in where a few explain enough of it, else those.

    parts, motions : of each block, 0 at rest, and of each part
    """
    squares = _squares(model, motion)
    found, left = np.zeros(len(parts), dtype=np.int64), squares
    explained = 0.0
    for count in range(1, min(FEW + 1, len(motions))):
        worst = int(np.argmax(np.bincount(parts, weights=left)))  # what the last ones explain least begins the next
        found, left = _nearest(model, motion, np.where(parts == worst, count, found))
        explained = 1.0 - float(left.sum() / squares.sum())
        if explained >= ENOUGH:
            break
    if explained < ENOUGH:  # no few parts will do
        return MainParts(parts, motions, 1.0)
    found = _by_weight(model, found)
    return MainParts(found, part_motions(model, found, motion), explained)


def _nearest(model: Model, motion: FloatArray, label: IntArray) -> tuple[IntArray, FloatArray]:
    """Main part of each block, beginning with those given, and what is left of its motion; (n_blocks,) each."""
    squares, numbers = _squares(model, motion), range(1, int(label.max()) + 1)
    rests = squares
    for _ in range(MOST_DIVISIONS):
        left = np.stack([squares, *(_left(model, motion, label == number) for number in numbers)])
        nearest = np.argmin(left, axis=0)
        nearest[squares == 0.0] = 0
        rests = left[nearest, np.arange(len(label))]
        if np.array_equal(nearest, label):
            break
        label = nearest
    return label, rests


def _squares(model: Model, motion: FloatArray) -> FloatArray:
    """Squared velocity of each block over its volume, taken as that of a cube, (n_blocks,)."""
    blocks = model.blocks
    return np.asarray(
        blocks.volumes * ((motion[:, :3] ** 2).sum(axis=1) + blocks.sizes**2 / 6 * (motion[:, 3:] ** 2).sum(axis=1))
    )


def _left(model: Model, motion: FloatArray, chosen: FloatArray) -> FloatArray:
    """What of the motion of every block differs from the rigid motion that fits the chosen ones best, (n_blocks,)."""
    blocks = model.blocks
    if not chosen.any():
        return np.full(len(blocks), np.inf)
    origin = np.average(blocks.centroids[chosen], axis=0, weights=blocks.volumes[chosen])
    arms = blocks.centroids - origin
    weight, gyration = blocks.volumes[chosen], blocks.sizes[chosen] ** 2 / 6
    own, turns = motion[chosen, :3], motion[chosen, 3:]
    travel = np.average(own, axis=0, weights=weight)
    r = arms[chosen]
    inertia = np.einsum("b,bij->ij", weight, (r**2).sum(axis=1)[:, None, None] * np.eye(3) - r[:, :, None] * r[:, None])
    inertia += (weight * gyration).sum() * np.eye(3)
    spin = np.linalg.solve(inertia, weight @ (np.cross(r, own) + gyration[:, None] * turns))
    fitted = np.hstack([travel + np.cross(spin, arms), np.tile(spin, (len(blocks), 1))])
    return _squares(model, motion - fitted)


def _by_weight(model: Model, label: IntArray) -> IntArray:
    """The same, numbered by falling weight; numbers without blocks left out."""
    weights = np.bincount(label, weights=model.blocks.masses)
    weights[0] = 0.0
    used = [number for number in np.argsort(-weights, kind="stable").tolist() if number and (label == number).any()]
    numbers = np.zeros(len(weights), dtype=np.int64)
    numbers[used] = np.arange(1, len(used) + 1)
    return np.asarray(numbers[label])
