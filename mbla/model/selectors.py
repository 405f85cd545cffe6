"""Selectors: which blocks a part of the deck means."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mbla.arrays import IntArray
from mbla.deck.tree import KeyPath
from mbla.deck.types import Selector, SelectorTerm
from mbla.errors import Fault
from mbla.model.blocks import Blocks
from mbla.model.wording import vector


@dataclass(frozen=True)
class Roster:
    """The blocks that selectors choose from.

    members : blocks of each group, in order
    partial : groups of which an item could not be built; what a selector finds in them is not the deck's fault
    fault_at : see ``Deck.fault_at``
    """

    blocks: Blocks
    members: dict[str, IntArray]
    partial: frozenset[str]
    fault_at: Callable[[KeyPath, str], Fault]


def build_roster(blocks: Blocks, partial: frozenset[str], fault_at: Callable[[KeyPath, str], Fault]) -> Roster:
    """Roster of all blocks by group."""
    names, codes = np.unique(np.array(blocks.groups, dtype=np.str_), return_inverse=True)
    order = np.argsort(codes, kind="stable")
    parts = np.split(order, np.cumsum(np.bincount(codes, minlength=len(names)))[:-1])
    return Roster(blocks, dict(zip(names.tolist(), parts, strict=True)), partial, fault_at)


def select_blocks(selector: Selector, path: KeyPath, roster: Roster, faults: list[Fault]) -> IntArray | None:
    """Blocks that a selector means, ascending, each once, (n,).

    None where that cannot be said: a fault was added to ``faults``, or items it depends on could not be built.
    """
    if isinstance(selector, list):
        each = [_select(term, (*path, number), roster, faults) for number, term in enumerate(selector)]
    else:
        each = [_select(selector, path, roster, faults)]
    found = [blocks for blocks in each if blocks is not None]
    return np.unique(np.concatenate(found)).astype(np.int64) if len(found) == len(each) else None


def _select(term: str | SelectorTerm, path: KeyPath, roster: Roster, faults: list[Fault]) -> IntArray | None:
    if isinstance(term, str):
        return None if term in roster.partial else roster.members[term]
    if term.group is not None:
        if term.group in roster.partial:
            return None
        members = roster.members[term.group]
        if term.index is None:
            return members
        if term.index >= len(members):
            allowed = f"0 to {len(members) - 1}" if len(members) > 1 else "0 only"
            message = f"there is no such block: {term.group} has {len(members)}, index {allowed}"
            faults.append(roster.fault_at((*path, "index"), message))
            return None
        return members[term.index : term.index + 1]
    assert term.box is not None  # a rule of the deck: a group or a box
    if roster.partial:  # any block that could not be built might lie in it
        return None
    least, greatest = np.array(term.box)
    centroids = roster.blocks.centroids
    inside = np.flatnonzero(((centroids >= least) & (centroids <= greatest)).all(axis=1))
    if len(inside):
        return inside
    low, high = centroids.min(axis=0), centroids.max(axis=0)
    message = f"no centroid of a block lies in it; they lie between {vector(low)} and {vector(high)}"
    faults.append(roster.fault_at((*path, "box"), message))
    return None
