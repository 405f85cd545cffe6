"""How a structure without equilibrium falls, in the words of any other failure."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.results.collapse.failure import failure_of
from mbla.results.collapse.fall import fall_of
from mbla.results.listing.failure_words import failure_sentences
from mbla.results.listing.mechanism_words import mechanism_lines
from mbla.results.listing.text import sentence

LIFTS = (
    "The motion is one of associative flow, in which joints lift as they slide: it proves that nothing holds the "
    "structure, and need not be the way in which it falls."
)
"""what the motion is worth as a picture of the fall, where anything slides in it"""


def fall_sentences(model: Model, contacts: Contacts, load_case: LoadCase, certificate: FloatArray) -> list[str]:
    """What moves and how, where it turns and parts, what slides; the live load, which does not act yet, says no way."""
    collapse, mechanics = fall_of(model, contacts, certificate)
    failure = failure_of(model, contacts, collapse, mechanics)
    unloaded = replace(load_case, live_load=np.zeros_like(load_case.live_load))
    lifts = [LIFTS] if collapse.interfaces.slides.any() else []
    return failure_sentences(model, contacts, unloaded, collapse, failure) + lifts


def fall_lines(model: Model, contacts: Contacts, certificate: FloatArray) -> list[str]:
    """The tables of the parts, hinge lines, sliding planes and cracks."""
    collapse, mechanics = fall_of(model, contacts, certificate)
    return mechanism_lines(model, contacts, failure_of(model, contacts, collapse, mechanics))


def fall_summary(model: Model, contacts: Contacts, load_case: LoadCase, certificate: FloatArray) -> list[str]:
    """For the terminal: the first of these sentences, which say how much moves and what the heaviest part does."""
    return [
        line for text in fall_sentences(model, contacts, load_case, certificate)[:2] for line in sentence(text, "    ")
    ]
