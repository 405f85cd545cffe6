"""What the contact model is known to get wrong for the joints of a model, as warnings for the listing."""

from __future__ import annotations

import numpy as np

from mbla.contacts.contacts import Contacts
from mbla.errors import Notice
from mbla.model.model import Model
from mbla.program.convex.shapes import interface_shapes


def program_notices(model: Model, contacts: Contacts, contact_model: str = "concave") -> tuple[Notice, ...]:
    """Warnings about joint laws in use that the contact model represents on the unsafe side."""
    if contact_model == "convex":
        return _without_stress_block(model, contacts)
    crushable = [
        name
        for name, count in contacts.count_by_joint.items()
        if count and np.isfinite(model.joints[name].compressive_strength)
    ]
    if not crushable:
        return ()
    text = (
        f"joint law {', '.join(crushable)}: compressive strength limits each contact point to its share of the area, "
        "which overstates an interface under eccentric load: it bears N (1 + 2 e/b) <= fc A, a stress block only "
        "N <= fc A (1 - 2 e/b), with eccentricity e and width b"
    )
    return (Notice("warning", "eccentric-crushing-overstated", text),)


def _without_stress_block(model: Model, contacts: Contacts) -> tuple[Notice, ...]:
    """Interfaces that can crush whose outlines are not convex: their contact points crush as in the concave model."""
    strengths = np.array([model.joints[name].compressive_strength for name in contacts.joint_names])
    crushable = np.isfinite(strengths)[contacts.joints] if len(contacts) else np.zeros(0, dtype=bool)
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
