"""Load `force` on one block.

A force F at a point p of a block with centroid x brings the moment (p - x) x F.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import IntArray
from mbla.deck.kinds.load_key import register_load
from mbla.deck.quantities import Force
from mbla.model.applied_load import AppliedLoad, wrenches_of
from mbla.model.loads.load_kind import Entry, LoadKind, LoadSite, one_block
from mbla.model.loads.on_soil import refuse_on_cells
from mbla.model.outside import outside
from mbla.model.wording import vector


def force_load(entry: Entry, blocks: IntArray | None, site: LoadSite) -> AppliedLoad | None:
    """A force at a point of one block, (1,), by default at its centroid."""
    if refuse_on_cells("force", blocks, (*entry.path, "on"), site):
        return None
    block, at = one_block(entry, blocks, site), entry.load.at
    if block is None:
        return None
    words = f"force {vector(entry.value)} {site.units.force} on {site.blocks.name(block)}"
    centroid = site.blocks.centroids[block]
    point = centroid if at is None else np.array(at)
    if at is not None:
        words += f" at {vector(at)} {site.units.length}"
        off = outside(point, block, site.blocks, site.units)
        if off is not None:
            site.warn("force-outside-block", f"the {words} acts {off.words}; its moment is kept")
    else:
        words += " at its centroid"
    wrenches = wrenches_of(np.array([entry.value]), point[None], centroid[None])
    return AppliedLoad(np.array([block]), wrenches, words, at_point=True)


register_load(
    LoadKind(
        name="force",
        section=tuple[Force, Force, Force],
        description="force on one block",
        after="acceleration",
        takes=("at", "follows"),
        needs_block=True,
        build=force_load,
        vector=lambda force: force,
        mirrored=True,
    )
)
