"""Load `moment` on one block: where a couple acts does not matter."""

from __future__ import annotations

import numpy as np

from mbla.arrays import IntArray
from mbla.deck.kinds.load_key import register_load
from mbla.deck.quantities import Moment
from mbla.model.applied_load import AppliedLoad, without_levers
from mbla.model.loads.load_kind import Entry, LoadKind, LoadSite, one_block
from mbla.model.loads.on_soil import refuse_on_cells
from mbla.model.wording import vector


def moment_load(entry: Entry, blocks: IntArray | None, site: LoadSite) -> AppliedLoad | None:
    """A moment on one block, (1,)."""
    if refuse_on_cells("moment", blocks, (*entry.path, "on"), site):
        return None
    block = one_block(entry, blocks, site)
    if block is None:
        return None
    words = f"moment {vector(entry.value)} {site.units.force} {site.units.length} on {site.blocks.name(block)}"
    return AppliedLoad(np.array([block]), without_levers(np.array([[0.0, 0.0, 0.0, *entry.value]])), words)


register_load(
    LoadKind(
        name="moment",
        section=tuple[Moment, Moment, Moment],
        description="moment on one block",
        after="force",
        takes=("follows",),
        needs_block=True,
        build=moment_load,
        mirrored=True,
    )
)
