"""What a load is to the model: an entry of the deck, the site that it acts on, and its kind, which makes forces of it.

Each file of this folder that is named after a kind registers it at its foot, with what the deck knows of it.
Combinations name loads: these stand in for the entries that refer to them, with the product of their factors.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeAlias

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.deck.kinds.load_key import LOAD_KEYS, NAMED, LoadKey
from mbla.deck.quantities import Vector
from mbla.deck.sections.any_load import AnyLoad
from mbla.deck.sections.vehicles import Vehicle
from mbla.deck.units import Units
from mbla.errors import Finding, KeyPath, Notice
from mbla.model.applied_load import AppliedLoad
from mbla.model.fill.fill import FillBody
from mbla.model.model import Ground
from mbla.model.selectors import BlockSelection
from mbla.model.soil.soil_mesh import SoilMesh
from mbla.model.solids.blocks import NO_MASSES, Blocks, PointMasses
from mbla.questions import Question
from mbla.questions.load_factor import LOAD_FACTOR


@dataclass(frozen=True)
class Entry:
    """A single load: its kind and value, what it says besides, its place in the deck, and the factor on it."""

    kind: str
    value: Any
    load: AnyLoad
    path: KeyPath
    factor: float

    @staticmethod
    def of(load: AnyLoad, path: KeyPath, factor: float = 1.0) -> Entry:
        """Of a load of the deck, with a factor besides its own."""
        return Entry(load.kind, load.chosen, load, path, factor * load.factor)

    @property
    def adds_up(self) -> bool:
        """It is a part of a sum of loads."""
        return not LOAD_KEYS[self.kind].live_only


def entries_of(loads: Sequence[AnyLoad], path: KeyPath, named: Mapping[str, Sequence[AnyLoad]]) -> Iterator[Entry]:
    """All loads of a list, named ones among them; the deck has no cycle of names."""
    waiting = [Entry.of(load, (*path, number)) for number, load in reversed(list(enumerate(loads)))]
    while waiting:
        entry = waiting.pop()
        if entry.kind != NAMED:
            yield entry
            continue
        name = entry.value
        below = [Entry.of(load, ("loads", name, number), entry.factor) for number, load in enumerate(named[name])]
        waiting += reversed(below)


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
    water   : in soil of cells, in every load case
    soils   : of cells, which are among the blocks
    """

    selection: BlockSelection
    fixed: BoolArray
    units: Units
    resolve_file: Callable[[KeyPath, str], Path]
    grounds: tuple[Ground, ...] = ()
    named: Mapping[str, Sequence[AnyLoad]] = field(default_factory=dict)
    tolerance: float = 1e-3
    overlap: float = 1e-3
    fill: Mapping[str, FillBody] = field(default_factory=dict)
    vehicles: Mapping[str, Vehicle] = field(default_factory=dict)
    masses: PointMasses = NO_MASSES
    water: tuple[AppliedLoad, ...] = ()
    soils: Sequence[SoilMesh] = ()

    @property
    def blocks(self) -> Blocks:
        """All blocks of the model."""
        return self.selection.blocks

    def refuse(self, finding: Finding) -> None:
        """Add a fault, once."""
        self.selection.refuse(finding)

    def warn(self, identifier: str, message: str) -> None:
        """Add a warning, once."""
        self.selection.remark(Notice("warning", identifier, message))


Build: TypeAlias = Callable[[Entry, IntArray | None, LoadSite], AppliedLoad | None]
"""The load on blocks, from its entry, the blocks that its ``on`` selects, None where it has none, and the site. None
where a fault was left."""


@dataclass(frozen=True, kw_only=True)
class LoadKind(LoadKey):
    """A kind of load that adds up with others.

    build      : see ``Build``
    vector     : of its value, where that is one: what ``interact`` turns
    mirrored   : it has an image, so that planes of symmetry need not lie along it; else only a vector along them is
                 its own image
    may_cancel : its parts may leave nothing of each other, which its sum with others is judged by
    """

    build: Build
    vector: Callable[[Any], Vector] | None = None
    mirrored: bool = False
    may_cancel: bool = False


@dataclass(frozen=True)
class Variant:
    """A load case that a load makes of one: what acts besides its other loads, and what is asked of it."""

    load: AppliedLoad | None = None
    question: Question = LOAD_FACTOR


Variants: TypeAlias = Callable[[str, Entry, Sequence[Entry], FloatArray, LoadSite], list[Variant]]
"""The load cases, from the name of the deck's one, the entry, the entries of its dead loads, the sum of these,
(n_blocks, 6), and the site; none where a fault was left."""


@dataclass(frozen=True, kw_only=True)
class CaseKind(LoadKey):
    """A live load that makes another load case, or several, of one; see ``Variants``."""

    variants: Variants
    live_only: bool = True


def load_kind(entry: Entry) -> LoadKind:
    """The kind of a load that adds up."""
    kind = LOAD_KEYS[entry.kind]
    assert isinstance(kind, LoadKind)  # who asks has left out those that do not
    return kind


def one_block(entry: Entry, blocks: IntArray | None, site: LoadSite) -> int | None:
    """Of blocks (n,) that are selected; None, and a fault of the deck, where they are several."""
    assert blocks is not None  # a rule of the deck: these loads say on which block they act
    if len(blocks) == 1:
        return int(blocks[0])
    what = entry.kind
    message = f"a {what} acts on one block, {len(blocks)} are selected: give an index, or one {what} for each"
    site.refuse(Finding("one-block-only", message, *entry.path, "on"))
    return None
