"""What a kind of load gets and gives.

A kind is a function ``(load, blocks, path, site) -> AppliedLoad | None``; where it gives None, it left a fault with
the site. Combinations name loads: these stand in for the entries that refer to them, with the product of their
factors.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeAlias

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, summed
from mbla.deck.sections.loads import Load
from mbla.deck.sections.vehicles import Vehicle
from mbla.deck.text.tree import KeyPath
from mbla.deck.units import Units
from mbla.errors import Finding, Notice
from mbla.model.fill import FillBody
from mbla.model.model import Ground
from mbla.model.selectors import Roster
from mbla.model.solids.blocks import NO_MASSES, Blocks, PointMasses


@dataclass(frozen=True)
class LoadSite:
    """What loads act on: blocks to choose from, with a place for complaints; those that do not move; the deck's units.

    fixed   : (n_blocks,) blocks that do not move
    resolve_file : path of a file named by the value at a key path of the deck
    grounds : planes of rigid ground
    named   : loads of the deck by name
    tolerance, overlap : greatest gap and greatest overlap of contacts, relative to block size
    fill    : fills by name, through which loads spread
    vehicles : of the deck by name
    masses  : that blocks carry, each by itself
    """

    roster: Roster
    fixed: BoolArray
    units: Units
    resolve_file: Callable[[KeyPath, str], Path]
    grounds: tuple[Ground, ...] = ()
    named: Mapping[str, Sequence[Load]] = field(default_factory=dict)
    tolerance: float = 1e-3
    overlap: float = 1e-3
    fill: Mapping[str, FillBody] = field(default_factory=dict)
    vehicles: Mapping[str, Vehicle] = field(default_factory=dict)
    masses: PointMasses = NO_MASSES

    @property
    def blocks(self) -> Blocks:
        """All blocks of the model."""
        return self.roster.blocks

    def refuse(self, finding: Finding) -> None:
        """Add a fault, once."""
        self.roster.refuse(finding)

    def warn(self, identifier: str, message: str) -> None:
        """Add a warning, once."""
        self.roster.remark(Notice("warning", identifier, message))


@dataclass(frozen=True)
class AppliedLoad:
    """One load on the blocks that it acts on.

    blocks   : (n,) ascending, each once
    wrenches : (n, 15) force and moment about the centroid of each block, in the deck's units, and the lever a F of all
               forces that are not couples, arms from the centroid by rows: how the moment changes as the block turns
    words    : the load in words, for the listing
    follows  : in a pushover it turns with its block
    """

    blocks: IntArray
    wrenches: FloatArray
    words: str
    follows: bool = False


LoadKind: TypeAlias = Callable[[Load, IntArray | None, KeyPath, LoadSite], AppliedLoad | None]
"""Arguments: the load; the blocks that its ``on`` selects, None where it has none; its place in the deck; the site."""


def wrenches_of(forces: FloatArray, points: FloatArray, centroids: FloatArray) -> FloatArray:
    """Forces at points as forces, moments about centroids, (p - x) x F, and levers; all (n, 3), the result (n, 15)."""
    arms = points - centroids
    levers = arms[:, :, None] * forces[:, None, :]
    return np.hstack([forces, np.cross(arms, forces), levers.reshape(-1, 9)])


def without_levers(wrenches: FloatArray) -> FloatArray:
    """Of forces at the centroids and couples, (n, 6): (n, 15)."""
    return np.hstack([wrenches, np.zeros((len(wrenches), 9))])


def sum_on_blocks(blocks: IntArray, wrenches: FloatArray) -> tuple[IntArray, FloatArray]:
    """Blocks, each once, ascending, and the sums of the wrenches on them, from (n,) and (n, 15)."""
    unique, row = np.unique(blocks, return_inverse=True)
    return unique, summed(row, wrenches, len(unique))


@dataclass(frozen=True)
class Entry:
    """A single load: its place in the deck, and the factor on it."""

    load: Load
    path: KeyPath
    factor: float


def entries_of(loads: Sequence[Load], path: KeyPath, named: Mapping[str, Sequence[Load]]) -> Iterator[Entry]:
    """All loads of a list, named ones among them; the deck has no cycle of names."""
    waiting = [Entry(load, (*path, number), load.factor) for number, load in reversed(list(enumerate(loads)))]
    while waiting:
        entry = waiting.pop()
        name = entry.load.loads
        if name is None:
            yield entry
            continue
        below = [Entry(load, ("loads", name, i), entry.factor * load.factor) for i, load in enumerate(named[name])]
        waiting += reversed(below)
