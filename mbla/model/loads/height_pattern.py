"""How an acceleration grows with height: s = x · a along a direction a, the factor a broken line over s."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.deck.tree import KeyPath
from mbla.deck.types import HeightPattern
from mbla.model.loads.load_kind import LoadSite
from mbla.model.ragged import items_of_rows


def pattern_factors(
    pattern: HeightPattern, points: FloatArray, blocks: IntArray, path: KeyPath, site: LoadSite
) -> FloatArray | None:
    """Factors at points, (n,) from (n, 3); base and top are the ends of the blocks unless the deck gives them.

    None, with a fault at ``path``, where the base it was given is not below the top found, or the reverse.
    """
    along = np.array(pattern.along) / np.abs(pattern.along).max()  # so that squares neither overflow nor vanish
    along /= np.linalg.norm(along)
    if pattern.points is not None:
        heights, factors = np.array(pattern.points).T
    else:
        reach = site.blocks.vertices[items_of_rows(site.blocks.vertex_start, blocks)] @ along
        base = reach.min() if pattern.base is None else pattern.base
        top = reach.max() if pattern.top is None else pattern.top
        if not base < top:
            site.refuse(path, f"its base, {base:g}, must be below its top, {top:g}")
            return None
        heights, factors = np.array([base, top]), np.array([0.0, 1.0])
    return np.asarray(np.interp(points @ along, heights, factors))
