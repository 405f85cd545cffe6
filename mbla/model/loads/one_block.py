"""The one block that a force or a moment acts on."""

from __future__ import annotations

from mbla.arrays import IntArray
from mbla.errors import Finding
from mbla.model.loads.entry import Entry
from mbla.model.loads.load_site import LoadSite


def one_block(entry: Entry, blocks: IntArray | None, site: LoadSite) -> int | None:
    """Of blocks (n,) that are selected; None, and a fault of the deck, where they are several."""
    assert blocks is not None  # a rule of the deck: these loads say on which block they act
    if len(blocks) == 1:
        return int(blocks[0])
    what = entry.kind
    message = f"a {what} acts on one block, {len(blocks)} are selected: give an index, or one {what} for each"
    site.refuse(Finding("one-block-only", message, *entry.path, "on"))
    return None
