"""The remark that outlines of common surfaces have lost corners, where that can be seen in the load factor."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.corners import Corners
from mbla.contacts.narrow_phase import Patches
from mbla.contacts.polygons import areas
from mbla.deck.types import ContactsSection
from mbla.errors import Notice
from mbla.model.model import Model

SEEN = 1e-4
"""Share of its area, taken off or added, from which on an outline is called simpler than the surface: the edges about
which blocks turn move by about that share of their distance, and the load factor by rocking with them."""


def outline_notices(
    model: Model, section: ContactsSection, patches: Patches, corners: Corners, drawn: FloatArray
) -> list[Notice]:
    """A notice where corners that were left out change the area of a common surface, or nothing.

    patches : with the outlines as they were cut
    corners : those that stay
    drawn   : (n_patches,) area within these, relative like the outlines
    """
    changes = np.abs(drawn / areas(patches.polygons) - 1.0)
    simpler = int((changes > SEEN).sum())
    if not simpler:
        return []
    most = int(np.argmax(changes))
    first, second = (model.body_name(int(body)) for body in patches.overlays.bodies[most])
    stay = int((corners.polygon_of_corner == most).sum())
    text = (
        f"corners within the tolerance of {section.tolerance:g} of the outline are left out, which changes the area of "
        f"{simpler} common surface{'' if simpler == 1 else 's'}, most that of {first} and {second}, drawn by {stay} "
        f"corners, by {100 * changes[most]:.2g} %: a smaller contacts.tolerance keeps more of them"
    )
    return [Notice("notice", "outlines-simplified", text)]
