"""Which joint law each interface has: the section's, the ground's, or that of the last override that fits.

Interfaces of soil of cells have the laws of the soil: between its cells and on ground one, on other blocks another,
between two soils that of less friction. Of overrides those with ``between`` hold for them, as others, such as of all
bed joints, mean masonry.

The law that a table of interfaces gives for one of them holds before all others.

An override fits where all its conditions hold:

- ``between``: one body is in the first selection and the other in the second;
- ``orientation``: *bed* where the normal n of the interface is nearer than 45 degrees to the vertical, |n_z| > cos 45°,
  *head* where it is not; or the angle between n and ±d is at most ``within``. Normals that a rounding of coordinates
  would tip over a limit count as on it: at 45 degrees as head, at ``within`` as fitting;
- ``box``: the centroid of the interface lies in it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.outlines.overlay import Overlays
from mbla.deck.sections.contacts import AboutNormal, ContactOverride, ContactsSection
from mbla.deck.sections.materials import BUILT_IN, GLUED, OPEN
from mbla.errors import Notice
from mbla.model.model import Model, PrescribedInterfaces
from mbla.model.selectors import BlockSelection, bodies_selected
from mbla.model.solids.plane import unit

BED = math.cos(math.radians(45))
ROUNDING = 1e-9
"""of cosines: normals are unit vectors computed from coordinates, good to about 1e-15 over the slenderness of faces"""


@dataclass(frozen=True)
class Laws:
    """Joint law of each interface, (n,), as row of ``names``, which has every law of the deck and the built-in ones."""

    rows: IntArray
    names: tuple[str, ...]

    def are(self, name: str) -> BoolArray:
        """Interfaces with that law, (n,)."""
        return np.asarray(self.rows == self.names.index(name))

    @property
    def open(self) -> BoolArray:
        """Interfaces that are no contacts, (n,)."""
        return self.are(OPEN)

    @property
    def glued(self) -> BoolArray:
        """Internal interfaces, inside of a rigid body, (n,)."""
        return self.are(GLUED)

    def in_use(self, chosen: IntArray) -> tuple[IntArray, tuple[str, ...]]:
        """Joint law of the chosen interfaces, (n,), as row of the names in use; and these, in the deck's order."""
        used, rows = np.unique(self.rows[chosen], return_inverse=True)
        return rows.astype(np.int64), tuple(self.names[law] for law in used)


def joints_of_interfaces(
    model: Model,
    section: ContactsSection,
    overlays: Overlays,
    centroids: FloatArray,
    prescribed: Sequence[str] | None = None,
) -> tuple[Laws, list[Notice]]:
    """Joint law of each interface, and a warning for each override that fits none.

    centroids  : (n, 3) m of the interfaces
    prescribed : (n) name of the law that the table of interfaces gives; empty where it gives none; None without a table
    """
    names = (*model.joints, *(name for name in BUILT_IN if name not in model.joints))
    bodies, n_blocks = overlays.bodies, len(model.blocks)
    rows = np.full(len(bodies), names.index(section.joint))
    for index, ground in enumerate(model.grounds):
        rows[bodies[:, 0] == n_blocks + index] = names.index(ground.joint)
    soil = _of_soil(model, bodies, names, rows)
    settled = np.zeros(len(rows), dtype=bool)
    if prescribed is not None:
        settled = np.array([bool(name) for name in prescribed], dtype=bool)
        rows[settled] = [names.index(name) for name in prescribed if name]
    selection = BlockSelection(model.blocks)
    notices = []
    for number, override in enumerate(section.overrides):
        fits = ~(settled | soil) if override.between is None else ~settled
        if override.between is not None:
            first, second = (bodies_selected(each, selection, len(model.grounds))[bodies] for each in override.between)
            fits &= (first & second[:, ::-1]).any(axis=1)
        if override.orientation is not None:
            fits &= _oriented(overlays.frames[:, 0], override)
        if override.box is not None:
            least, greatest = np.array(override.box)
            fits &= ((centroids >= least) & (centroids <= greatest)).all(axis=1)
        rows[fits] = names.index(override.joint)
        if not fits.any():
            text = f"contacts.overrides[{number}], with joint {override.joint}, fits no contact and has no effect"
            notices.append(Notice("warning", "override-without-contact", text))
    return Laws(rows, names), notices


def _of_soil(model: Model, bodies: IntArray, names: Sequence[str], rows: IntArray) -> BoolArray:
    """Interfaces (n, 2) of soil, (n,), to which it gives their laws in ``rows``."""
    if not model.soils:
        return np.zeros(len(rows), dtype=bool)
    own = np.append(model.soil_of_block, np.full(len(model.grounds), -1))
    joints, walls = (
        np.array([names.index(getattr(soil, key)) for soil in model.soils]) for key in ("joint", "wall_joint")
    )
    friction = np.array([model.joints[soil.joint].friction for soil in model.soils])
    first, second = own[bodies].T
    weaker = np.where((first >= 0) & ((second < 0) | (friction[first] <= friction[second])), first, second)
    on_block = ((first < 0) | (second < 0)) & (bodies < len(model.blocks)).all(axis=1)
    found = weaker >= 0
    rows[found] = np.where(on_block, walls[weaker], joints[weaker])[found]
    return np.asarray(found)


def laws_of_nearest(given: PrescribedInterfaces | None, bodies: IntArray, centroids: FloatArray) -> list[str] | None:
    """Law that a table gives for the interface of the same two bodies, (n, 2), nearest to each place, (n, 3) m.

    Empty where it gives none, and for bodies that it has no interface of; None without a table.
    """
    if given is None:
        return None
    places = np.add.reduceat(given.corners, given.corner_start[:-1]) / np.diff(given.corner_start)[:, None]
    laws = []
    for own, place in zip(bodies, centroids, strict=True):
        rows = np.flatnonzero((given.bodies == own).all(axis=1))
        away = np.linalg.norm(places[rows] - place, axis=1)
        laws.append(given.joints[rows[away.argmin()]] if len(rows) else "")
    return laws


def _oriented(normals: FloatArray, override: ContactOverride) -> BoolArray:
    if isinstance(override.orientation, AboutNormal):
        direction = unit(override.orientation.normal)
        least = math.cos(math.radians(override.orientation.within))
        return np.asarray(np.abs(normals @ direction) >= least - ROUNDING)
    bed = np.abs(normals[:, 2]) > BED + ROUNDING
    return np.asarray(bed if override.orientation == "bed" else ~bed)
