"""Load `moment`: a couple on one block; where on it does not matter."""

from __future__ import annotations

import numpy as np

from mbla.arrays import IntArray
from mbla.deck.tree import KeyPath
from mbla.deck.types import Load
from mbla.errors import Message
from mbla.model.loads.load_kind import AppliedLoad, LoadSite
from mbla.model.wording import vector


def moment_load(load: Load, blocks: IntArray | None, path: KeyPath, site: LoadSite) -> AppliedLoad | None:
    """A moment on one block."""
    assert load.moment is not None  # what makes it this kind
    assert blocks is not None  # a rule of the deck: a moment says on which block it acts
    if len(blocks) != 1:
        message = f"a moment acts on one block, {len(blocks)} are selected: give an index, or one moment for each"
        site.refuse((*path, "on"), Message("one-block-only", message))
        return None
    words = f"moment {vector(load.moment)} {site.units.force} {site.units.length} on {site.blocks.name(int(blocks[0]))}"
    return AppliedLoad(blocks, np.array([[0.0, 0.0, 0.0, *load.moment]]), words)
