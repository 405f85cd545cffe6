"""What hangs together: blocks without any contact, and parts of the structure that no support holds."""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, IntArray
from mbla.model.model import Model


def isolated_blocks(n_blocks: int, bodies: IntArray) -> IntArray:
    """Blocks that occur in none of the contacts between bodies (n, 2), sorted."""
    touched = np.zeros(n_blocks, dtype=bool)
    touched[bodies[bodies < n_blocks]] = True
    return np.flatnonzero(~touched)


def held_blocks(model: Model) -> BoolArray:
    """Blocks that a support holds, wholly or in some of their ways, (n_blocks,)."""
    held = model.fixed.copy()
    held[model.guides.blocks] = True
    return held


def unsupported_parts(fixed: BoolArray, bodies: IntArray) -> tuple[IntArray, ...]:
    """Connected parts of free blocks without contact to a fixed block or the ground, each sorted.

    fixed  : (n_blocks,)
    bodies : (n, 2) bodies in contact; those from n_blocks on are ground
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    n_blocks = len(fixed)
    support = np.ones(max(n_blocks, int(bodies.max(initial=-1)) + 1), dtype=bool)
    support[:n_blocks] = fixed
    # Supports do not hang together with each other through their contacts: links between free blocks only.
    free_links = bodies[~support[bodies].any(axis=1)]
    graph = coo_array((np.ones(len(free_links)), (free_links[:, 0], free_links[:, 1])), shape=(n_blocks, n_blocks))
    n_parts, part = connected_components(graph, directed=False)
    held = np.zeros(n_parts, dtype=bool)
    a, b = bodies.T
    held[part[a[support[b] & ~support[a]]]] = True
    held[part[b[support[a] & ~support[b]]]] = True
    blocks = np.flatnonzero(~fixed & ~held[part])
    order = blocks[np.argsort(part[blocks], kind="stable")]
    if not len(order):
        return ()
    cuts = np.flatnonzero(np.diff(part[order])) + 1
    return tuple(sorted(np.split(order, cuts), key=lambda found: int(found[0])))
