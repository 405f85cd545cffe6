"""Where loads have landed: their sums on blocks, several as one, and shares of them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mbla.arrays import FloatArray, IntArray, summed
from mbla.model.applied_load import sum_on_blocks, wrenches_of
from mbla.model.fill.dispersal import Spread
from mbla.model.loads.load_kind import LoadSite


def on_blocks(landed: Sequence[Spread], forces: FloatArray, site: LoadSite) -> tuple[IntArray, FloatArray]:
    """Blocks, each once, ascending, and the wrenches on them, (n, 15), of forces (m, 3) by where each lands, (m,)."""
    under = np.concatenate([each.blocks for each in landed])
    shared = np.concatenate([each.shares[:, None] * force for each, force in zip(landed, forces, strict=True)])
    points = np.concatenate([each.points for each in landed])
    return sum_on_blocks(under, wrenches_of(shared, points, site.blocks.centroids[under]))


def most_laden(landed: Spread | None) -> int:
    """The block that carries most of a load; -1 for none."""
    return -1 if landed is None or not len(landed.blocks) else int(landed.blocks[np.argmax(landed.shares)])


def together(parts: Sequence[Spread]) -> Spread:
    """Where equal parts of a load land, as one; a part that lands on no block goes beyond."""
    shares = np.concatenate([each.shares for each in parts]) / len(parts)
    points = np.concatenate([each.points for each in parts])
    blocks, row = np.unique(np.concatenate([each.blocks for each in parts]), return_inverse=True)
    total = summed(row, shares, len(blocks))
    means = summed(row, shares[:, None] * points, len(blocks)) / total[:, None]
    beyond = float(np.mean([each.beyond if len(each.blocks) else 1.0 for each in parts]))
    met = float(np.mean([each.met if len(each.blocks) else 0.0 for each in parts]))
    return Spread(blocks, total, means, beyond, met, np.unique(np.concatenate([each.others for each in parts])))


def share_of(forces: FloatArray, shares: Sequence[float]) -> float:
    """Share of the sum of forces (n, 3), by the share of each, (n,)."""
    sizes = np.linalg.norm(forces, axis=1)
    return float(sizes @ np.array(shares) / sizes.sum()) if sizes.any() else 0.0
