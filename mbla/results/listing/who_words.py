"""How the parts of a failure are called, and what they move against."""

from __future__ import annotations

import numpy as np

from mbla.arrays import IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.results.collapse.failure import Failure
from mbla.results.collapse.rigid_parts import PartMotion

LONGEST = 30
"""characters of the label of a ground up to which it is named in a sentence"""


def part_name(model: Model, failure: Failure, number: int) -> str:
    """``part 2``; ``it`` where everything moves as one, ``what rests`` for 0."""
    if number == 0:
        return "what rests"
    return "it" if moves_whole(model, failure.motions[0]) else f"part {number}"


def moves_whole(model: Model, part: PartMotion) -> bool:
    """Whether the part is everything that can move."""
    return len(part.blocks) == len(model.free)


def other_name(model: Model, contacts: Contacts, failure: Failure, number: int, interfaces: IntArray) -> str:
    """The same; what rests by its name where it is one body: ``ground z = 0``, ``base[0]``."""
    if number:
        return part_name(model, failure, number)
    rests = np.append(failure.clusters, np.zeros(len(model.grounds), dtype=np.int64)) == 0
    bodies = contacts.bodies[interfaces]
    found = np.unique(bodies[rests[bodies]])
    if len(found) == 1:
        name = model.body_name(int(found[0]))
        if len(name) <= LONGEST:
            return name
    supports = np.append(model.fixed, np.ones(len(model.grounds), dtype=bool))
    return "the supports" if len(found) and supports[found].all() else "what rests"
