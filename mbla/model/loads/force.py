"""Loads `force` and `moment` on one block.

A force F at a point p of a block with centroid x brings the moment (p - x) x F; where a couple acts does not matter.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import IntArray
from mbla.deck.sections.loads import Load
from mbla.deck.text.tree import KeyPath
from mbla.errors import Finding
from mbla.model.loads.load_kind import AppliedLoad, LoadSite, without_levers, wrenches_of
from mbla.model.outside import outside
from mbla.model.wording import vector


def force_load(load: Load, blocks: IntArray | None, path: KeyPath, site: LoadSite) -> AppliedLoad | None:
    """A force at a point of one block, (1,), at its centroid unless given."""
    assert load.force is not None  # what makes it this kind
    block = _one_block("force", blocks, path, site)
    if block is None:
        return None
    words = f"force {vector(load.force)} {site.units.force} on {site.blocks.name(block)}"
    centroid = site.blocks.centroids[block]
    point = centroid if load.at is None else np.array(load.at)
    if load.at is not None:
        words += f" at {vector(load.at)} {site.units.length}"
        off = outside(point, block, site.blocks, site.units)
        if off is not None:
            site.warn("force-outside-block", f"the {words} acts {off.words}; its moment is kept")
    else:
        words += " at its centroid"
    return AppliedLoad(np.array([block]), wrenches_of(np.array([load.force]), point[None], centroid[None]), words)


def moment_load(load: Load, blocks: IntArray | None, path: KeyPath, site: LoadSite) -> AppliedLoad | None:
    """A moment on one block, (1,)."""
    assert load.moment is not None  # what makes it this kind
    block = _one_block("moment", blocks, path, site)
    if block is None:
        return None
    words = f"moment {vector(load.moment)} {site.units.force} {site.units.length} on {site.blocks.name(block)}"
    return AppliedLoad(np.array([block]), without_levers(np.array([[0.0, 0.0, 0.0, *load.moment]])), words)


def _one_block(what: str, blocks: IntArray | None, path: KeyPath, site: LoadSite) -> int | None:
    """The one block that a force or a moment acts on; None, and a fault of the deck, where several are selected."""
    assert blocks is not None  # a rule of the deck: both say on which block they act
    if len(blocks) == 1:
        return int(blocks[0])
    message = f"a {what} acts on one block, {len(blocks)} are selected: give an index, or one {what} for each"
    site.refuse(Finding("one-block-only", message, *path, "on"))
    return None
