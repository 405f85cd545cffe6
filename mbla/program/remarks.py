"""What the contact model is known to get wrong for the joints of a model, as warnings for the listing."""

from __future__ import annotations

import numpy as np

from mbla.contacts.contacts import Contacts
from mbla.errors import Notice
from mbla.model.model import Model


def program_notices(model: Model, contacts: Contacts) -> tuple[Notice, ...]:
    """Warnings about joint laws in use that contact points at corners represent on the unsafe side."""
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
