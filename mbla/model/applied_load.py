"""A load as forces and moments on blocks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray, IntArray, summed


@dataclass(frozen=True)
class Patches:
    """Rectangles and lines on which axles stand, each with an even part of the load.

    corners : (n, 4, 3) in order; of a line two pairs of them are the same
    forces  : (n, 3) on each
    blocks  : (n,) under the middle of each; on fill that carries most of the axle
    spreads : they stand on fill, and what lands of them acts on blocks below
    """

    corners: FloatArray
    forces: FloatArray
    blocks: IntArray
    spreads: bool = False


NO_PATCHES = Patches(np.zeros((0, 4, 3)), np.zeros((0, 3)), np.zeros(0, dtype=np.int64))


@dataclass(frozen=True)
class AppliedLoad:
    """One load on the blocks that it acts on.

    blocks    : (n,) ascending, each once
    wrenches  : (n, 15) force and moment about the centroid of each block, in the deck's units, and the lever a F of all
                forces that are not couples, arms from the centroid by rows: how the moment changes as the block turns
    words     : the load in words, for the listing
    on_masses : every mass on these blocks is accelerated: the forces are those of one acceleration, but for a pattern
    in_g      : that acceleration is the same for all, and the deck gives it in g
    follows   : in a pushover it turns with its block
    at_point  : it is one force at one point of each block; others are spread over their blocks
    of_water  : it is ground water in soil of cells, on these and on what they touch
    patches   : on which it stands, of axles that have an extent
    on_cells  : of an even pressure, what of each face of a cell of soil it presses on
    """

    blocks: IntArray
    wrenches: FloatArray
    words: str
    on_masses: bool = False
    in_g: bool = False
    follows: bool = False
    at_point: bool = False
    of_water: bool = False
    patches: Patches = NO_PATCHES
    on_cells: Patches = NO_PATCHES

    def times(self, factor: float) -> AppliedLoad:
        """The load with a factor, which is no acceleration in g any more."""
        words = f"{factor:.6g} times {self.words}"
        patches, on_cells = (replace(each, forces=factor * each.forces) for each in (self.patches, self.on_cells))
        wrenches = factor * self.wrenches
        return replace(self, wrenches=wrenches, words=words, in_g=False, patches=patches, on_cells=on_cells)


def joined_patches(parts: Sequence[Patches]) -> Patches:
    """All of some patches, one after the other."""
    if not parts:
        return NO_PATCHES
    corners, forces, blocks = (
        np.concatenate([getattr(part, name) for part in parts]) for name in ("corners", "forces", "blocks")
    )
    return Patches(corners, forces, blocks, parts[0].spreads)


def without_forces(words: str) -> AppliedLoad:
    """A load that acts on no block."""
    return AppliedLoad(np.zeros(0, dtype=np.int64), np.zeros((0, 15)), words)


def wrenches_of(forces: FloatArray, points: FloatArray, centroids: FloatArray) -> FloatArray:
    """Forces at points as forces, moments about centroids, (p - x) x F, and levers; all (n, 3), the result (n, 15)."""
    arms = points - centroids
    levers = arms[:, :, None] * forces[:, None, :]
    return np.hstack([forces, np.cross(arms, forces), levers.reshape(-1, 9)])


def without_levers(wrenches: FloatArray) -> FloatArray:
    """Of forces at the centroids and couples, (n, 6): (n, 15)."""
    return np.hstack([wrenches, np.zeros((len(wrenches), 9))])


def sum_on_blocks(blocks: IntArray, wrenches: FloatArray) -> tuple[IntArray, FloatArray]:
    """Blocks, each once, ascending, and the sums of the wrenches on them, from (n,) and (n, 15)."""
    unique, row = np.unique(blocks, return_inverse=True)
    return unique, summed(row, wrenches, len(unique))
