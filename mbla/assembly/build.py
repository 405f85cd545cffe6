"""From a model to its assembly: contacts are found, and faults of the deck that they show are refused."""

from __future__ import annotations

from mbla.assembly.assembly import Assembly, assembly_of
from mbla.assembly.findings import (
    dilatancy_findings,
    glue_findings,
    objective_findings,
    settlement_findings,
    time_history_findings,
)
from mbla.contacts.contacts import ContactsRefused
from mbla.contacts.findings import bent_faults, overlap_findings
from mbla.contacts.known import KnownContacts
from mbla.contacts.search import find_contacts
from mbla.contacts.soil import soil_findings
from mbla.deck.deck import Deck
from mbla.errors import DeckError, first_faults
from mbla.model.model import Model


def build_assembly(deck: Deck, model: Model, known: KnownContacts | None = None) -> Assembly:
    """The assembly of a model.

    known : contacts of the model before, in whose place those of this one are kept

    Raises
    ------
    DeckError
        for blocks that overlap, soil that touches nothing, bent faces in contact, glue that leaves nothing to move, and
        what no search can handle
    """
    try:
        contacts = find_contacts(model, deck.contacts) if known is None else known.of(model, deck.contacts)
    except ContactsRefused as refused:
        raise DeckError([deck.fault_at(refused.path, refused.message)]) from refused
    assembly = assembly_of(model, contacts)
    faults = [deck.fault_at(path, message) for path, message in overlap_findings(deck, model, contacts)]
    faults += [deck.fault_at(path, message) for path, message in soil_findings(deck, model, contacts)]
    faults += bent_faults(deck, model, contacts)
    for findings in (glue_findings, objective_findings, settlement_findings, time_history_findings):
        faults += [deck.fault_at(path, message) for path, message in findings(assembly)]
    laws = [deck.contacts.joint, *(override.joint for override in deck.contacts.overrides)]
    faults += [deck.fault_at(path, message) for path, message in dilatancy_findings(assembly, laws)]
    if faults:
        raise DeckError(first_faults(faults))
    return assembly
