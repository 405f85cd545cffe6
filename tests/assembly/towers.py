"""A tower of cubes some of whose beds are glued."""

from __future__ import annotations

from mbla.assembly import Assembly, assembly_of
from mbla.contacts import find_contacts
from mbla.deck.sections.contacts import ContactOverride, ContactsSection
from tests.contacts.structures import blocks_of, boxes, ground, model_of

TOWER = boxes(*(([0, 0, i], [1, 1, i + 1]) for i in range(5)))
GROUPS = ["a", "b", "c", "d", "e"]


def glued(*pairs: tuple[str, str], joint: str = "glued") -> Assembly:
    """The tower on the ground with some of its beds glued."""
    model = model_of(blocks_of(TOWER, GROUPS), grounds=(ground(),))
    overrides = [ContactOverride(between=pair, joint=joint) for pair in pairs]
    contacts = find_contacts(model, ContactsSection(joint="dry", overrides=overrides))
    return assembly_of(model, contacts)
