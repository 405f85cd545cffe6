"""Selectors: which blocks a part of the deck means; in `contacts.overrides` ``ground`` means ground planes."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from mbla.arrays import BoolArray, IntArray
from mbla.deck.sections.contacts import ContactOverride
from mbla.deck.sections.selectors import GROUND, OUTER_FIRST, Selector, SelectorTerm
from mbla.deck.suggestions import unknown
from mbla.errors import Fault, Finding, KeyPath, Message, Notice
from mbla.model.solids.blocks import Blocks
from mbla.model.wording import vector


def unplaced(path: KeyPath, message: Message) -> Fault:
    """Stands for the places of a deck where there is none: everything in it was checked before.

    Raises AssertionError.
    """
    raise AssertionError(f"no deck to find {path} in: {message}")


@dataclass(frozen=True)
class BlockSelection:
    """The blocks that selectors choose from, and what is found wrong with a deck that chooses.

    partial : groups of which an item could not be built; what a selector finds in them is not the deck's fault
    fault_at : see ``Deck.fault_at``
    faults, notices : each once
    """

    blocks: Blocks
    partial: frozenset[str] = frozenset()
    fault_at: Callable[[KeyPath, Message], Fault] = unplaced
    faults: list[Fault] = field(default_factory=list)
    notices: list[Notice] = field(default_factory=list)

    @cached_property
    def members(self) -> dict[str, IntArray]:
        """Blocks of each group by its name, (n,) each, in order."""
        names, codes = np.unique(np.array(self.blocks.groups, dtype=np.str_), return_inverse=True)
        order = np.argsort(codes, kind="stable")
        parts = np.split(order, np.cumsum(np.bincount(codes, minlength=len(names)))[:-1])
        return dict(zip(names.tolist(), parts, strict=True))

    def refuse(self, finding: Finding) -> None:
        """Add a fault, once: several load cases may have the same named load."""
        fault = self.fault_at(*finding)
        if fault not in self.faults:
            self.faults.append(fault)

    def remark(self, notice: Notice) -> None:
        """Add a notice, once."""
        if notice not in self.notices:
            self.notices.append(notice)


def select_blocks(selector: Selector, path: KeyPath, selection: BlockSelection) -> IntArray | None:
    """Blocks that a selector means, ascending, each once, (n,).

    None where that cannot be said: a fault was added to the selection, or items it depends on could not be built.
    """
    if isinstance(selector, list):
        each = [_select(term, (*path, number), selection) for number, term in enumerate(selector)]
    else:
        each = [_select(selector, path, selection)]
    found = [blocks for blocks in each if blocks is not None]
    return np.unique(np.concatenate(found)).astype(np.int64) if len(found) == len(each) else None


def _select(term: str | SelectorTerm, path: KeyPath, selection: BlockSelection) -> IntArray | None:
    if isinstance(term, str):
        return None if term in selection.partial else selection.members[term]
    # any block that could not be built might lie in a box
    if selection.partial and (term.group is None or term.group in selection.partial):
        return None
    blocks = selection.members[term.group] if term.group is not None else np.arange(len(selection.blocks))
    for narrow in (_with_index, _of_member, _at_positions, _in_box):
        narrowed = narrow(term, blocks, selection.blocks)
        if isinstance(narrowed, Finding):
            selection.refuse(narrowed.below(*path))
            return None
        blocks = narrowed
    return blocks


# Each step gives the blocks (n,) that are left, or the key of the selector that excludes the last ones, and why.


def _with_index(term: SelectorTerm, rows: IntArray, blocks: Blocks) -> IntArray | Finding:
    if term.index is None:
        return rows
    if term.index >= len(rows):
        allowed = f"0 to {len(rows) - 1}" if len(rows) > 1 else "0 only"
        words = f"there is no such block: {term.group} has {len(rows)}, index {allowed}"
        return Finding("empty-selector", words, "index")
    return rows[term.index : term.index + 1]


def _of_member(term: SelectorTerm, rows: IntArray, blocks: Blocks) -> IntArray | Finding:
    if term.member is None:
        return rows
    members = np.array(blocks.labels.members, dtype=object)[rows]
    found: IntArray = rows[members == term.member]
    if len(found):
        return found
    known = sorted({str(member) for member in members if member})
    if not known:
        return Finding("empty-selector", "these blocks have no members: leave it out", "member")
    return Finding("unknown-name", unknown("member", term.member, known, "these blocks have"), "member")


def _at_positions(term: SelectorTerm, rows: IntArray, blocks: Blocks) -> IntArray | Finding:
    """Negative positions count from the last one of each group, in each of the parts that are chosen besides."""
    outer: list[IntArray] = []
    for name in OUTER_FIRST:
        asked = term.position(name)
        if asked is None:
            continue
        positions = blocks.labels.position(name)[rows]
        if not (positions >= 0).any():
            return Finding("empty-selector", f"these blocks have no {name}: leave it out", name)
        ends = asked if isinstance(asked, tuple) else (asked, asked)
        counts = _counts(positions, [part[rows] for part in outer], rows, blocks) if min(ends) < 0 else 0
        first, last = (at + counts if at < 0 else at for at in ends)
        fits = (positions >= np.maximum(first, 0)) & (positions <= last)
        if not fits.any():
            known = positions[positions >= 0]
            words = f"there is none: they go from {known.min()} to {known.max()}"
            return Finding("empty-selector", words, name)
        rows = rows[fits]
        outer.append(blocks.labels.position(name))
    return rows


def _counts(positions: IntArray, outer: list[IntArray], rows: IntArray, blocks: Blocks) -> IntArray:
    """How many positions there are beside each block, (n,): in its group and in the same parts ``outer``, (n,) each."""
    _, groups = np.unique(np.array(blocks.groups)[rows], return_inverse=True)
    _, part = np.unique(np.column_stack([groups, *outer]), axis=0, return_inverse=True)
    most = np.full(part.max() + 1, -1)
    np.maximum.at(most, part.ravel(), positions)
    return np.asarray(most[part.ravel()] + 1)


def _in_box(term: SelectorTerm, rows: IntArray, blocks: Blocks) -> IntArray | Finding:
    if term.box is None:
        return rows
    least, greatest = np.array(term.box)
    centroids = blocks.centroids[rows]
    inside = ((centroids >= least) & (centroids <= greatest)).all(axis=1)
    if inside.any():
        return np.asarray(rows[inside])
    low, high = centroids.min(axis=0), centroids.max(axis=0)
    which = "a block" if term.group is None else "these blocks"
    words = f"no centroid of {which} lies in it; they lie between {vector(low)} and {vector(high)}"
    return Finding("empty-selector", words, "box")


def check_overrides(overrides: Sequence[ContactOverride], selection: BlockSelection) -> None:
    """Refuse the selectors of overrides that mean no block."""
    for number, override in enumerate(overrides):
        for side, selector in enumerate(override.between or ()):
            for below, term in _blocks_in(selector):
                select_blocks(term, ("contacts", "overrides", number, "between", side, *below), selection)


def bodies_selected(selector: Selector, selection: BlockSelection, n_grounds: int) -> BoolArray:
    """Bodies that a side of an override means, (n_blocks + n_grounds,)."""
    n_blocks = len(selection.blocks)
    chosen = np.zeros(n_blocks + n_grounds, dtype=bool)
    for below, term in _blocks_in(selector):
        blocks = select_blocks(term, below, selection)
        assert blocks is not None  # ``check_overrides`` found blocks for every one
        chosen[blocks] = True
    terms = selector if isinstance(selector, list) else [selector]
    chosen[n_blocks:] = GROUND in terms
    return chosen


def _blocks_in(selector: Selector) -> Iterator[tuple[KeyPath, str | SelectorTerm]]:
    """The terms of a selector that mean blocks, with their place below it.

    A group that happens to be called "ground" is not meant: the word stands for ground planes.
    """
    if isinstance(selector, list):
        yield from (((number,), term) for number, term in enumerate(selector) if term != GROUND)
    elif selector != GROUND:
        yield (), selector
