"""Contacts stage: where blocks touch each other and the ground.

Bounding boxes give pairs of blocks (:mod:`~mbla.contacts.faces.broad_phase`), opposite facets of a pair that lie on one
plane are clipped against each other (:mod:`~mbla.contacts.faces.narrow_phase`), the corners of what they share become
contact points (:mod:`~mbla.contacts.outlines.corners`).
"""

from mbla.contacts.contacts import ContactReport, Contacts
from mbla.contacts.notices import overlap_messages
from mbla.contacts.search import find_contacts

__all__ = ["ContactReport", "Contacts", "find_contacts", "overlap_messages"]
