"""What of a model does not depend on its loads, its joint laws and its analysis: blocks, supports, given interfaces."""

from __future__ import annotations

from dataclasses import dataclass, replace

from mbla.deck.deck import Deck
from mbla.deck.tree import KeyPath
from mbla.deck.types import AnalysisSection, JointLaw, OutputSection
from mbla.errors import Fault, Message, Notice
from mbla.model.added_masses import with_added_masses
from mbla.model.bent_faces import BentFaces
from mbla.model.build_blocks import build_blocks
from mbla.model.collect_items import collect_items
from mbla.model.far_coordinates import far_fault, far_notices
from mbla.model.interfaces import read_interfaces
from mbla.model.item_defects import defects_in_words
from mbla.model.model import PrescribedInterfaces
from mbla.model.overrides import check_overrides
from mbla.model.selectors import Roster, build_roster
from mbla.model.supports import Supports, build_supports
from mbla.process.sharing import once

NO_LAW = JointLaw(friction=0.0)
"""stands for every joint law: only their names count here"""


@dataclass(frozen=True)
class Structure:
    """Blocks by name, with the masses that rest on them, and what holds them.

    bent                   : faces that were split
    first_notices, notices : before and after those on joint laws
    faults                 : in the order in which they are told
    """

    roster: Roster
    supports: Supports
    interfaces: PrescribedInterfaces | None
    bent: BentFaces
    first_notices: tuple[Notice, ...]
    notices: tuple[Notice, ...]
    faults: tuple[Fault, ...]


def structure_of(deck: Deck) -> Structure:
    """Build it, or take that of an earlier deck that says the same of it in the same files."""
    bare = _bare(deck)
    keys_set = tuple(text.partition("=")[0] for text in deck.overrides)  # a file is looked for where its name is given
    files = tuple(str(source.path.absolute()) for source in deck.sources)
    content = (bare.content, bare.units, files, keys_set)
    structure = once("structure", content, lambda: _build(bare), lasts=lambda structure: not structure.faults)
    return replace(structure, roster=replace(structure.roster, fault_at=deck.fault_at))


def _bare(deck: Deck) -> Deck:
    """The deck without what its structure must not depend on."""
    content = deck.content.model_copy(
        update={
            "title": "",
            "parameters": {},
            "joints": dict.fromkeys(deck.content.joints, NO_LAW),
            "loads": {},
            "load_cases": {},
            "analysis": AnalysisSection(),
            "output": OutputSection(),
            "expected": {},
        }
    )
    return replace(deck, content=content)


def _unplaced(path: KeyPath, message: Message) -> Fault:
    raise AssertionError(f"no deck to find {path} in: {message}")


def _build(deck: Deck) -> Structure:
    faults: list[Fault] = []
    notices: list[Notice] = []
    items = collect_items(deck, faults)
    built = build_blocks(items.polyhedra, items.labels, deck.contacts.tolerance)
    far = far_fault(items.polyhedra, deck.contacts.tolerance)
    faults += (
        defects_in_words(deck, built.defects, items.items, built.blocks)
        if far is None
        else [deck.fault_at(("blocks",), Message("coordinate-out-of-range", far))]
    )
    partial = items.partial | {built.blocks.groups[defect.block] for defect in built.defects}
    roster = build_roster(built.blocks, partial, deck.fault_at)
    supports = build_supports(deck, Supports(items.fixed, items.grounds), roster, faults)
    check_overrides(deck.contacts.overrides, roster, faults)
    interfaces = read_interfaces(deck, roster, supports.grounds, faults)
    if deck.content.masses:
        roster = replace(roster, blocks=with_added_masses(deck.content.masses, roster, supports.fixed, faults, notices))
    first = (*items.notices, *built.notices, *far_notices(items.polyhedra, items.labels.name))
    bent = replace(built.bent, items=items.items[built.bent.blocks])
    roster = replace(roster, fault_at=_unplaced)  # places are those of one deck
    return Structure(roster, supports, interfaces, bent, first, tuple(notices), tuple(faults))
