"""From the deck to the model: items, blocks, supports, joints, loads, images, in this order."""

from __future__ import annotations

from collections.abc import Sequence

from mbla.deck.deck import Deck
from mbla.deck.tree import KeyPath
from mbla.deck.types import LoadCaseSection
from mbla.errors import DeckError, Fault, Message, Notice
from mbla.model.joint_laws import build_joints, joint_notices
from mbla.model.loads import LoadSite, build_load_cases
from mbla.model.model import LoadCase, Model
from mbla.model.selectors import Roster
from mbla.model.settlement import build_settlement
from mbla.model.structure import structure_of
from mbla.model.supports import Supports, does_nothing
from mbla.model.symmetry import symmetry_faults, with_images


def build_model(deck: Deck) -> Model:
    """The model that a checked deck describes.

    Raises
    ------
    DeckError
        with every fault found: items that cannot be built, blocks that are no blocks, selectors without blocks,
        supports and loads that do nothing
    """
    structure = structure_of(deck)
    faults, notices = list(structure.faults), list(structure.notices)
    load_cases = _all_load_cases(deck, structure.roster, structure.supports, faults, notices)
    if faults:
        raise DeckError(faults)
    supports, interfaces = structure.supports, structure.interfaces
    model = Model(
        title=deck.content.title,
        units=deck.units,
        blocks=structure.roster.blocks,
        fixed=supports.fixed,
        grounds=supports.grounds,
        joints=build_joints(deck, supports.grounds, interfaces),
        load_cases=load_cases,
        notices=(*structure.first_notices, *joint_notices(deck), *notices),
        guides=supports.guides,
        interfaces=interfaces,
        bent=structure.bent,
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
                Message(
                    "live-load-without-effect",
                    f"the supports take every live load{where}, for they act on guided blocks across what these may do",
                ),
            )
    return load_cases
