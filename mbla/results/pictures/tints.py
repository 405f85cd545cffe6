"""Tints of the parts that move: neighbours get different ones, however many parts there are."""

from __future__ import annotations

import numpy as np

from mbla.arrays import IntArray
from mbla.results.pictures.scene import Scene


def tint_of_part(scene: Scene, parts: IntArray, n_tints: int) -> IntArray:
    """Tint of each part, (n_parts,), heaviest first: its own, or of too many parts the first that no neighbour has.

    parts : (n_blocks,) part of each block, 0 at rest
    """
    count = int(parts.max(initial=0)) + 1
    if count - 1 <= n_tints:
        return np.maximum(np.arange(count) - 1, 0)
    node = np.append(parts, np.zeros(len(scene.model.grounds), dtype=np.int64))
    pairs = np.unique(np.sort(node[scene.contacts.bodies], axis=1), axis=0)
    neighbours: list[list[int]] = [[] for _ in range(count)]
    for first, second in pairs.tolist():
        if 0 < first < second:
            neighbours[second].append(first)
    tints = np.zeros(count, dtype=np.int64)
    for part in range(1, count):
        taken = {int(tints[other]) for other in neighbours[part]}
        free = [tint for tint in range(n_tints) if tint not in taken]
        tints[part] = free[0] if free else part % n_tints
    return tints
