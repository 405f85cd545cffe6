"""Near misses that matter: those with nothing in between.

The top of a thin tile is near the bottom of the tile after next, but the tile between them fills the gap.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import IntArray, starts
from mbla.contacts.narrow_phase import Patches
from mbla.contacts.polygons import contains, inner_points
from mbla.contacts.ragged import rows_and_items


def without_covered(near_misses: Patches, contacts: Patches) -> Patches:
    """Near misses of which no inner point lies behind a contact on one of their two facets."""
    if not len(near_misses) or not len(contacts):
        return near_misses
    overlays = near_misses.overlays
    local = inner_points(near_misses.polygons)
    inside = overlays.origins + overlays.sizes[:, None] * np.einsum("ka,kai->ki", local, overlays.frames[:, 1:])
    covered = np.zeros(len(near_misses), dtype=bool)
    for side in (0, 1):
        miss, contact = _on_same_facet(overlays.facets[:, side], contacts.overlays.facets)
        on = contacts.overlays
        offset = (inside[miss] - on.origins[contact]) / on.sizes[contact, None]
        flat = np.einsum("kai,ki->ka", on.frames[contact, 1:], offset)
        covered[miss[contains(contacts.polygons[contact], flat)]] = True
    return near_misses.take(~covered)


def _on_same_facet(facets: IntArray, contact_facets: IntArray) -> tuple[IntArray, IntArray]:
    """Rows of near misses (by one facet each) and of contacts (by two) that share a facet; ground is no facet."""
    flat = contact_facets.ravel()
    order = np.argsort(flat, kind="stable")
    start = starts(np.bincount(flat + 1, minlength=int(max(flat.max(), facets.max())) + 2).astype(np.int64))
    counts = np.where(facets >= 0, np.diff(start)[facets + 1], 0)
    miss, position = rows_and_items(start[facets + 1], counts)
    return miss, order[position] // 2
