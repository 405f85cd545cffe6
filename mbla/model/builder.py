"""From the deck to the model: items, blocks, supports, joints, loads, images, in this order."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from mbla.deck.deck import Deck
from mbla.deck.tree import KeyPath
from mbla.deck.types import LoadCaseSection
from mbla.errors import DeckError, Fault, Notice
from mbla.model.added_masses import with_added_masses
from mbla.model.build_blocks import build_blocks
from mbla.model.collect_items import collect_items
from mbla.model.far_coordinates import far_fault, far_notices
from mbla.model.interfaces import read_interfaces
from mbla.model.item_defects import defects_in_words
from mbla.model.joint_laws import build_joints, joint_notices
from mbla.model.loads import LoadSite, build_load_cases
from mbla.model.model import LoadCase, Model
from mbla.model.overrides import check_overrides
from mbla.model.selectors import Roster, build_roster
from mbla.model.settlement import build_settlement
from mbla.model.supports import Supports, build_supports, does_nothing
from mbla.model.symmetry import symmetry_faults, with_images


def build_model(deck: Deck) -> Model:
    """The model that a checked deck describes.

    Raises
    ------
    DeckError
        with every fault found: items that cannot be built, blocks that are no blocks, selectors without blocks,
        supports and loads that do nothing
    """
    faults: list[Fault] = []
    notices: list[Notice] = []
    items = collect_items(deck, faults)
    built = build_blocks(items.polyhedra, items.labels, deck.contacts.tolerance)
    far = far_fault(items.polyhedra, deck.contacts.tolerance)
    faults += defects_in_words(deck, items, built) if far is None else [deck.fault_at(("blocks",), far)]
    partial = items.partial | {built.blocks.groups[defect.block] for defect in built.defects}
    roster = build_roster(built.blocks, partial, deck.fault_at)
    supports = build_supports(deck, Supports(items.fixed, items.grounds), roster, faults)
    check_overrides(deck.contacts.overrides, roster, faults)
    interfaces = read_interfaces(deck, roster, supports.grounds, faults)
    if deck.content.masses:
        roster = replace(roster, blocks=with_added_masses(deck.content.masses, roster, supports.fixed, faults, notices))
    load_cases = _all_load_cases(deck, roster, supports, faults, notices)
    if faults:
        raise DeckError(faults)
    model = Model(
        title=deck.content.title,
        units=deck.units,
        blocks=roster.blocks,
        fixed=supports.fixed,
        grounds=supports.grounds,
        joints=build_joints(deck, supports.grounds, interfaces),
        load_cases=load_cases,
        notices=(
            *items.notices,
            *built.notices,
            *far_notices(items.polyhedra, items.labels.name),
            *joint_notices(deck),
            *notices,
        ),
        guides=supports.guides,
        interfaces=interfaces,
    )
    if faults := symmetry_faults(deck, model):
        raise DeckError(faults)
    return with_images(deck, model)


def _all_load_cases(
    deck: Deck, roster: Roster, supports: Supports, faults: list[Fault], notices: list[Notice]
) -> tuple[LoadCase, ...]:
    """Load cases of the deck, in its order."""
    site = LoadSite(
        roster=roster,
        fixed=supports.fixed,
        units=deck.units,
        resolve_file=deck.resolve_file,
        grounds=supports.grounds,
        named=deck.content.loads,
        tolerance=deck.contacts.tolerance,
        faults=faults,
        notices=notices,
    )
    sections = deck.content.load_cases.items()
    return tuple(case for name, section in sections for case in _load_cases(name, section, site, supports))


def _load_cases(name: str, section: LoadCaseSection, site: LoadSite, supports: Supports) -> Sequence[LoadCase]:
    """Loads of one case, or of one for each position of a load that travels; or a support that gives way."""
    load_cases = build_load_cases(name, section, site)
    path: KeyPath = ("load_cases", name)
    if section.settlement is not None:
        settles = (*path, "settlement")
        return [
            build_settlement(section.settlement, settles, load_case, supports, site.roster, site.faults)
            for load_case in load_cases
        ]
    for load_case in load_cases:
        if not site.faults and does_nothing(load_case.live_load, supports):
            where = "" if load_case.travel is None else f" at position {load_case.travel.number}"
            site.refuse(
                (*path, "live"),
                f"the supports take every live load{where}, for they act on guided blocks across what these may do",
            )
    return load_cases
