"""The parts of a mechanism as they are listed: few rigid motions that reproduce most of it.

Rigid parts (:mod:`mbla.results.collapse.rigid_parts`) are exact to the residual of a solution. The mechanism of a large
structure may have hundreds of them that differ by a thousandth, and a facade that is pushed out of its plane opens a
little in every joint: to the eye it is one plate or two that turn. Where there are more than ``MOST``, each is assigned
to the nearest of a few rigid motions, rest among them, and every motion is the one that fits its
parts best (Lloyd 1982, doi:10.1109/TIT.1982.1056489), until nothing changes. The fewest are taken that reproduce
``ENOUGH`` of the motion: of the sum of squared velocities over the volume, that is, of what would be its kinetic
energy. With the sums of a part about a common origin, for blocks of volume m and inertia J about their centroids ::

    A = Σ m [1, −x×]ᵀ[1, −x×] + diag(0, J),   b = Σ m [1, −x×]ᵀ v + (0, J ω),   c = Σ m v² + ω·J ω

its best rigid motion is u = A⁻¹ b, and what any motion u leaves of c is c − 2 b·u + u·A u.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, summed
from mbla.model.model import Model
from mbla.results.collapse.rigid_parts import PartMotion, numbered, part_motions

MOST = 12
"""rigid parts that are listed as they are; an arch that fails has three, a wall in bond up to ten"""
FEW = 4
"""parts that a reader can distinguish, which stand for more"""
ENOUGH = 0.95
"""share of the motion that these are to reproduce"""
MOST_DIVISIONS = 50

_Sums: TypeAlias = "tuple[FloatArray, FloatArray, FloatArray]"


@dataclass(frozen=True)
class Clusters:
    """The parts as they are listed.

    of_block  : (n_blocks,) part of each block, 0 at rest; numbered by falling weight
    motions   : of each, as ``part_motions`` has them
    explained : share of the motion that they reproduce; 1 where they are the rigid parts themselves
    """

    of_block: IntArray
    motions: tuple[PartMotion, ...]
    explained: float

    @property
    def neglected(self) -> float:
        """Speed within the parts over that of the motion, root of the mean square."""
        return math.sqrt(1.0 - self.explained)


def clusters_of(model: Model, parts: IntArray, motion: FloatArray) -> Clusters:
    """Of a motion, (n_blocks, 6), few parts where these reproduce enough of it, else its rigid parts, (n_blocks,)."""
    motions = part_motions(model, parts, motion)
    if len(motions) <= MOST:
        return Clusters(parts, motions, 1.0)
    sums = _part_sums(model, parts, motion)
    squares = sums[2]
    label, left = np.zeros(len(squares), dtype=np.int64), squares
    for count in range(1, FEW + 1):
        worst = int(np.argmax(left))  # what the last ones reproduce least begins the next
        label, left = _nearest(sums, np.where(np.arange(len(label)) == worst, count, label))
        explained = 1.0 - float(left.sum() / squares.sum())
        if explained >= ENOUGH:
            of_block = numbered(model, label[parts], 0)
            return Clusters(of_block, part_motions(model, of_block, motion), min(explained, 1.0))
    return Clusters(parts, motions, 1.0)  # no few parts will do


def _part_sums(model: Model, parts: IntArray, motion: FloatArray) -> _Sums:
    """A, b and c of every part, (n_parts, 6, 6), (n_parts, 6) and (n_parts,); lengths over the model's size."""
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
    squares = blocks.volumes * (velocity**2).sum(axis=1) + inertia * (rotation**2).sum(axis=1)
    count = int(parts.max()) + 1
    return summed(parts, matrices, count), summed(parts, vectors, count), summed(parts, squares, count)


def _nearest(sums: _Sums, label: IntArray) -> tuple[IntArray, FloatArray]:
    """Cluster of each part, beginning with those given, and the rest of its motion; (n_parts,) each."""
    squares, numbers = sums[2], range(1, int(label.max()) + 1)
    rests = squares
    for _ in range(MOST_DIVISIONS):
        left = np.stack([squares, *(_left(sums, label == number) for number in numbers)])
        nearest = np.argmin(left, axis=0)
        nearest[0] = 0  # at rest
        rests = left[nearest, np.arange(len(label))]
        if np.array_equal(nearest, label):
            break
        label = nearest
    return label, rests


def _left(sums: _Sums, chosen: BoolArray) -> FloatArray:
    """What of the motion of every part differs from the rigid motion that fits the chosen ones best, (n_parts,)."""
    matrices, vectors, squares = sums
    if not chosen.any():
        return np.full(len(squares), np.inf)
    fit = np.linalg.solve(matrices[chosen].sum(axis=0), vectors[chosen].sum(axis=0))
    return np.asarray(np.maximum(squares - 2.0 * vectors @ fit + (matrices @ fit) @ fit, 0.0))
