"""Contacts of a model that the next one has as well: decks that differ in loads and friction alone touch alike."""

from __future__ import annotations

import math
import pickle
from dataclasses import dataclass

from mbla.contacts.contacts import Contacts
from mbla.contacts.search import find_contacts
from mbla.deck.sections.contacts import ContactsSection
from mbla.model.model import Model


@dataclass
class KnownContacts:
    """Contacts of the last model, with all that they depend on."""

    last: tuple[bytes, Contacts] | None = None

    def of(self, model: Model, section: ContactsSection) -> Contacts:
        """As ``find_contacts``, found now or before."""
        key = _key(model, section)
        if self.last is None or self.last[0] != key:
            self.last = None
            self.last = key, find_contacts(model, section)
        return self.last[1]


def _key(model: Model, section: ContactsSection) -> bytes:
    """Geometry, what is held, and of each joint law whether it can crush; nothing of loads, friction and cohesion."""
    crushes = {name: math.isfinite(joint.compressive_strength) for name, joint in model.joints.items()}
    held = (model.fixed, model.grounds, model.guides, model.mirrors, model.interfaces, model.ties, model.bent)
    return pickle.dumps((model.units, model.blocks, held, crushes, section))
