"""What keeps a structure that stands from being followed in time."""

from __future__ import annotations

from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.model.pose import turns_and_slides
from mbla.solution.pushover.start import MORE_POINTS, crushes_at_corners
from mbla.solution.solution import Solution


def why_not_followed(model: Model, contacts: Contacts, at_rest: Solution) -> str:
    """In words; empty where nothing does.

    model   : as it may move under the load case
    at_rest : of its dead load
    """
    against = {
        "guided blocks turn and move besides": turns_and_slides(model.guides),
        f"joints can crush, which is followed at points: {MORE_POINTS}": at_rest.stress_blocks
        and crushes_at_corners(model, contacts),
        "nothing touches it": not len(contacts.points),
        "contact_model: convex": at_rest.contact_model == "convex",
    }
    return ", ".join(words for words, holds in against.items() if holds)
