"""Few parts of a mechanism of many: blocks whose motions are alike, and the main ones of these.

Rigid parts (:mod:`mbla.results.collapse.rigid_parts`) are exact to the residual of a solution, and the mechanism of a
large structure may have hundreds of them that differ by a thousandth. Two that touch are merged where

- their interfaces move by at most a share of the largest contact speed, and
- their motions as rigid bodies differ by no more than that over the lighter of both (root of the mean square).

The second keeps a chain of parts, each of which moves a little against the next, from becoming one: a cluster has one
motion, and what joins it must share that. Whatever is at rest has none, and what joins it must hardly move. With the
sums of a part about a common origin, for blocks of mass m and inertia J about their centroids ::

    A = Σ m [1, −x×]ᵀ[1, −x×] + diag(0, J),   b = Σ m [1, −x×]ᵀ v + (0, J ω),   c = Σ m v² + ω·J ω

its best rigid motion is A⁻¹ b and what that leaves is c − b·A⁻¹ b, so that merging is adding (Ward 1963,
doi:10.1080/01621459.1963.10500845, merges by the same increase of the sum of squares). The mass is the volume here.

A facade that is pushed out of its plane opens a little in every joint, and its rigid parts, or those taken for one
(:mod:`mbla.results.collapse.clusters`), are many. To the eye it is one plate or two that turn. Here every block is
given to that of a few rigid motions, rest among them, which its own comes nearest to, and every motion is the one that
fits its blocks best (Lloyd 1982, doi:10.1109/TIT.1982.1056489), until nothing changes. As few are taken as explain
``ENOUGH`` of the motion: of the sum of squared velocities over the volume, that is, what would be its kinetic energy.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, summed
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.results.collapse.rigid_parts import PartMotion, part_motions
from mbla.solution.verification.statics import contact_velocities

SHARES = (0.02, 0.05, 0.1, 0.2)
"""shares of the largest contact speed, of which the least is taken that leaves few parts: a fiftieth of what moves
fastest is hard to see in a picture, and what moves a fifth still is no part of its own in a few words"""
FEW = 4
"""parts that a reader keeps apart; an arch that fails has three"""
MOST_ROUNDS = 10
"""times that all pairs are looked at: motions of clusters change as they grow, and little after the first round"""


@dataclass(frozen=True)
class Clusters:
    """Rigid parts as they are told.

    of_block : (n_blocks,) cluster of each block, 0 at rest; numbered as parts are, by falling weight
    merged   : share of the largest contact speed up to which parts were taken for one; 0 where none were
    """

    of_block: IntArray
    merged: float


def clusters_of(model: Model, contacts: Contacts, parts: IntArray, motion: FloatArray) -> Clusters:
    """Few clusters, by the least of ``SHARES`` that leaves ``FEW``, from rigid parts and a motion, (n_blocks, 6)."""
    found = Clusters(parts, 0.0)
    for share in SHARES if int(parts.max(initial=0)) > 1 else ():
        count = int(found.of_block.max(initial=0)) + 1  # a larger share goes on from what a smaller one left
        owner = _merged(model, contacts, found.of_block, motion, count, share)
        if len(np.unique(owner)) < count:
            found = Clusters(_renumbered(found.of_block, owner, model), share)
        if int(found.of_block.max(initial=0)) <= FEW:
            break
    return found


def _merged(
    model: Model, contacts: Contacts, parts: IntArray, motion: FloatArray, count: int, share: float
) -> IntArray:
    """Cluster of each part, by its lowest part, (count,)."""
    speeds, pairs = _pair_speeds(model, contacts, parts, motion)
    limit = share * speeds.max(initial=0.0)
    near = np.flatnonzero(speeds <= limit)
    near = near[np.argsort(speeds[near], kind="stable")]
    sums = _Sums(model, parts, motion, count)
    owner = np.arange(count)
    for _ in range(MOST_ROUNDS):
        joined = False
        for a, b in pairs[near].tolist():
            first, second = sorted((_root(owner, a), _root(owner, b)))
            if first != second and sums.apart(first, second) <= limit:
                sums.join(first, second)
                owner[second] = first
                joined = True
        if not joined:
            break
    return np.array([_root(owner, part) for part in range(count)])


def _root(owner: IntArray, part: int) -> int:
    while owner[part] != part:
        owner[part] = owner[owner[part]]
        part = int(owner[part])
    return part


def _pair_speeds(model: Model, contacts: Contacts, parts: IntArray, motion: FloatArray) -> tuple[FloatArray, IntArray]:
    """Largest contact speed between each two parts that touch, (n,), and the parts, (n, 2)."""
    of_body = np.append(parts, np.zeros(len(model.grounds), dtype=np.int64))
    pairs = np.sort(of_body[contacts.bodies], axis=1)[contacts.interface_of_point]
    speeds = np.linalg.norm(contact_velocities(model, contacts, motion), axis=1)
    different = pairs[:, 0] != pairs[:, 1]
    found, row = np.unique(pairs[different], axis=0, return_inverse=True)
    largest = np.zeros(len(found))
    np.maximum.at(largest, row.ravel(), speeds[different])
    return largest, found


_BlockSums: TypeAlias = "tuple[FloatArray, FloatArray, FloatArray]"


def _block_sums(model: Model, motion: FloatArray) -> _BlockSums:
    """A, b and c of every block, (n_blocks, 6, 6), (n_blocks, 6) and (n_blocks,); lengths over the model's size."""
    blocks = model.blocks
    arms = blocks.centroids - np.average(blocks.centroids, axis=0, weights=blocks.volumes)
    size = float(np.abs(arms).max(initial=0.0)) or 1.0  # lengths in it, so that A is well scaled
    velocity, rotation = motion[:, :3], motion[:, 3:] * size
    arms, inertia = arms / size, blocks.volumes * (blocks.sizes / size) ** 2 / 6.0  # of a cube
    to_block = np.zeros((len(blocks), 3, 6))
    to_block[:, :, :3] = np.eye(3)
    to_block[:, :, 3:] = np.cross(np.eye(3), arms[:, None, :]).transpose(0, 2, 1)  # −x ×
    matrices = blocks.volumes[:, None, None] * np.einsum("bij,bik->bjk", to_block, to_block)
    matrices[:, 3:, 3:] += inertia[:, None, None] * np.eye(3)
    vectors = blocks.volumes[:, None] * np.einsum("bij,bi->bj", to_block, velocity)
    vectors[:, 3:] += inertia[:, None] * rotation
    return matrices, vectors, blocks.volumes * (velocity**2).sum(axis=1) + inertia * (rotation**2).sum(axis=1)


class _Sums:
    """A, b, c and the volume of every cluster; cluster 0 is at rest and takes no sums."""

    def __init__(self, model: Model, parts: IntArray, motion: FloatArray, count: int) -> None:
        of_blocks = (*_block_sums(model, motion), model.blocks.volumes)
        self.matrices, self.vectors, self.squares, self.volumes = (summed(parts, each, count) for each in of_blocks)
        self.left = _left_of(self.matrices, self.vectors, self.squares)

    def apart(self, first: int, second: int) -> float:
        """Speed by which two clusters differ over the lighter one."""
        if first == 0:
            return float(np.sqrt(self.squares[second] / self.volumes[second]))
        both = (self._of_both(values, first, second) for values in (self.matrices, self.vectors, self.squares))
        more = max(float(_left_of(*both)[0]) - self.left[first] - self.left[second], 0.0)
        return float(np.sqrt(more / min(self.volumes[first], self.volumes[second])))

    def join(self, first: int, second: int) -> None:
        """The first takes the second in."""
        for values in (self.matrices, self.vectors, self.squares, self.volumes):
            values[first] += values[second]
        if first:
            own = (values[first : first + 1] for values in (self.matrices, self.vectors, self.squares))
            self.left[first] = _left_of(*own)[0]

    @staticmethod
    def _of_both(values: FloatArray, first: int, second: int) -> FloatArray:
        return values[first : first + 1] + values[second : second + 1]


def _left_of(matrices: FloatArray, vectors: FloatArray, squares: FloatArray) -> FloatArray:
    """What is left of c when the best rigid motion of each cluster is taken off, (n,); 0 where there is no volume."""
    filled = matrices.any(axis=(1, 2))
    left = np.zeros(len(matrices))
    motions = np.linalg.solve(matrices[filled], vectors[filled, :, None])[:, :, 0]
    left[filled] = np.maximum(squares[filled] - (vectors[filled] * motions).sum(axis=1), 0.0)
    return left


def _renumbered(parts: IntArray, owner: IntArray, model: Model) -> IntArray:
    """Clusters by falling weight, then by their first part; 0 stays what is at rest, whether any block is or not."""
    label = owner[parts]
    moving = np.unique(label[label > 0])
    weights = np.bincount(label, weights=model.blocks.masses, minlength=len(owner))[moving]
    largest = float(weights.max(initial=0.0)) or 1.0
    number = np.zeros(len(owner), dtype=np.int64)
    number[moving[np.lexsort((moving, -np.round(weights / largest, 9)))]] = np.arange(1, len(moving) + 1)
    return np.asarray(number[label], dtype=np.int64)


# --- Main parts: what falls, in a few words, where a mechanism spreads over a whole wall ----------------------------


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
    sums = _block_sums(model, motion)
    squares = sums[2]
    found, left = np.zeros(len(parts), dtype=np.int64), squares
    explained = 0.0
    for count in range(1, min(FEW + 1, len(motions))):
        worst = int(np.argmax(np.bincount(parts, weights=left)))  # what the last ones explain least begins the next
        found, left = _nearest(sums, np.where(parts == worst, count, found))
        explained = 1.0 - float(left.sum() / squares.sum())
        if explained >= ENOUGH:
            break
    if explained < ENOUGH:  # no few parts will do
        return MainParts(parts, motions, 1.0)
    found = _by_weight(model, found)
    return MainParts(found, part_motions(model, found, motion), explained)


def _nearest(sums: _BlockSums, label: IntArray) -> tuple[IntArray, FloatArray]:
    """Main part of each block, beginning with those given, and what is left of its motion; (n_blocks,) each."""
    squares, numbers = sums[2], range(1, int(label.max()) + 1)
    rests = squares
    for _ in range(MOST_DIVISIONS):
        left = np.stack([squares, *(_left(sums, label == number) for number in numbers)])
        nearest = np.argmin(left, axis=0)
        nearest[squares == 0.0] = 0
        rests = left[nearest, np.arange(len(label))]
        if np.array_equal(nearest, label):
            break
        label = nearest
    return label, rests


def _left(sums: _BlockSums, chosen: BoolArray) -> FloatArray:
    """What of the motion of every block differs from the rigid motion that fits the chosen ones best, (n_blocks,)."""
    matrices, vectors, squares = sums
    if not chosen.any():
        return np.full(len(squares), np.inf)
    fit = np.linalg.solve(matrices[chosen].sum(axis=0), vectors[chosen].sum(axis=0))
    return np.asarray(np.maximum(squares - 2.0 * vectors @ fit + (matrices @ fit) @ fit, 0.0))


def _by_weight(model: Model, label: IntArray) -> IntArray:
    """The same, numbered by falling weight; numbers without blocks left out."""
    weights = np.bincount(label, weights=model.blocks.masses)
    weights[0] = 0.0
    used = [number for number in np.argsort(-weights, kind="stable").tolist() if number and (label == number).any()]
    numbers = np.zeros(len(weights), dtype=np.int64)
    numbers[used] = np.arange(1, len(used) + 1)
    return np.asarray(numbers[label])
