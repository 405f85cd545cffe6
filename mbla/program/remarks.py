"""What the contact model is known to get wrong for the joints of a model, as warnings for the listing."""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, starts
from mbla.contacts.contacts import Contacts
from mbla.errors import Notice
from mbla.model.model import Model
from mbla.model.ragged import next_item
from mbla.program.convex.shapes import interface_shapes

STRAIGHT = 1e-9
"""1 - cosine of the angle between edges that are parts of one: 4.5e-5 radians"""


def program_notices(model: Model, contacts: Contacts, contact_model: str = "concave") -> tuple[Notice, ...]:
    """Warnings about joint laws in use that the contact model represents on the unsafe side."""
    if contact_model == "convex":
        return _without_stress_block(model, contacts)
    crushable = _crushable(model, contacts)
    if not crushable.any():
        return ()
    names = ", ".join(contacts.joint_names[joint] for joint in np.unique(contacts.joints[crushable]))
    text = f"joint law {names}: compressive strength limits each contact point to its share of the area"
    if not (crushable & _corners_alone(contacts)).any():
        text += (
            "; an interface bears moments that exceed those of stress blocks by at most (fc + ft) b h^2/(8 n^2), with "
            "the tensile strength ft, its length h in n parts and its greatest breadth b (four times that where it is "
            "no parallelogram)"
        )
        return (Notice("notice", "crushing-at-points", text),)
    text += (
        ", which overstates an interface under eccentric load: it bears N (1 + 2 e/b) <= fc A, a stress block only "
        "N <= fc A (1 - 2 e/b), with eccentricity e and width b; more points (contacts.points) bring that down"
    )
    return (Notice("warning", "eccentric-crushing-overstated", text),)


def _crushable(model: Model, contacts: Contacts) -> BoolArray:
    """Interfaces with a compressive strength, (n_interfaces,)."""
    strengths = np.array([model.joints[name].compressive_strength for name in contacts.joint_names])
    return np.asarray(np.isfinite(strengths)[contacts.joints] if len(contacts) else np.zeros(0, dtype=bool))


def _corners_alone(contacts: Contacts) -> BoolArray:
    """Interfaces with an edge that has contact points at its ends only, (n_interfaces,)."""
    place = np.arange(len(contacts.points)) - contacts.point_start[contacts.interface_of_point]
    rows = np.flatnonzero(place < contacts.outline[contacts.interface_of_point])
    owner = contacts.interface_of_point[rows]
    following = next_item(starts(contacts.outline))
    step = contacts.points[rows[following]] - contacts.points[rows]
    step /= np.linalg.norm(step, axis=1)[:, None]
    turns = np.empty(len(rows), dtype=bool)  # at the end of each edge
    turns[:] = np.einsum("ij,ij->i", step, step[following]) < 1 - STRAIGHT
    begins = np.empty_like(turns)
    begins[following] = turns
    return np.asarray(np.bincount(owner, turns & begins, minlength=len(contacts)) > 0)


def _without_stress_block(model: Model, contacts: Contacts) -> tuple[Notice, ...]:
    """Interfaces that can crush whose outlines are not convex: their contact points crush as in the concave model."""
    crushable = _crushable(model, contacts)
    if not crushable.any():
        return ()
    count = int((crushable & ~interface_shapes(contacts).convex).sum())
    if count == 0:
        return ()
    text = (
        f"{count} interface{'s' if count > 1 else ''} with a compressive strength and an outline that is not convex, "
        "or with holes: there it limits each contact point to its share of the area, which overstates an interface "
        "under eccentric load"
    )
    return (Notice("warning", "crushing-by-points", text),)
