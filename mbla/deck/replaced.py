"""Keys of earlier versions, and what a deck writes in their place."""

from __future__ import annotations

from collections.abc import Mapping

from mbla.deck.tree import KeyPath

REPLACED: Mapping[KeyPath, str] = {
    ("contacts", "refine"): "contacts.points.per_edge",
    ("contacts", "inset"): "contacts.points.inset",
}
"""Path of the key -> the key that says the same now."""
