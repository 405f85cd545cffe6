"""Generator of barrel vaults: courses of straight prisms along the axis.

The section is that of an arch with straight-edged voussoirs; the volume is its area times the length. With joints at
equal angles d of a circle it is n (R2^2 - R1^2)/2 sin d.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.deck.items.vaults import BarrelVaultItem
from mbla.model.generators.amounts import Amount, refuse_too_many
from mbla.model.generators.chains import prisms
from mbla.model.generators.generator import Generated, GroundPart, Part, Site
from mbla.model.generators.vault_sections import VaultSection, vault_section
from mbla.model.solids.polyhedra import Polyhedra

NO_UNIT = 1e-6
"""length of a remainder, relative to the unit, that is no unit of its own"""


def amount_barrel_vault(item: BarrelVaultItem) -> Amount:
    """About how many units such an item has."""
    return Amount(item.courses * item.length / item.unit, "length")


def generate_barrel_vault(item: BarrelVaultItem, site: Site) -> Generated:
    """Units course by course from the left springing, along +y in each.

    Raises
    ------
    ItemRefused
        for more units than can be handled
    """
    refuse_too_many(amount_barrel_vault(item), item)
    section = vault_section(item, item.span)
    rows = [_ends(item, item.bond == "running" and course % 2 == 1) for course in range(item.courses)]
    course = np.repeat(np.arange(item.courses), [len(row) for row in rows])
    ends = np.concatenate(rows)
    low, high = section.joints[course], section.joints[course + 1]
    outlines = np.stack([low[:, 1], high[:, 1], high[:, 0], low[:, 0]], axis=1)
    units = _along_axis(outlines, ends)
    labels = {"course": course, "unit": np.concatenate([np.arange(len(row)) for row in rows])}
    parts = [Part(units, labels=labels)]
    if item.springers == "blocks":
        parts.append(Part(_behind(item, section), "_springers", fixed=True))
    grounds = tuple(_grounds(item, section, course)) if item.springers == "ground" else ()
    return Generated(tuple(parts), grounds)


def _ends(item: BarrelVaultItem, shifted: bool) -> FloatArray:
    """Both ends of each unit of a course along y, (n, 2); the first unit is half a one where shifted."""
    first = item.unit / 2 if shifted else item.unit
    joints = first + item.unit * np.arange(int(np.ceil(item.length / item.unit)) + 1)
    inner = joints[joints < item.length - NO_UNIT * item.unit]
    ends = np.concatenate([[0.0], inner, [item.length]])
    return np.stack([ends[:-1], ends[1:]], axis=1)


def _along_axis(outlines: FloatArray, ends: FloatArray) -> Polyhedra:
    """Prisms along y from outlines (n, n_corners, 2) in the x-z plane, clockwise as seen from -y; ends (n, 2)."""
    near = np.stack([outlines[..., 0], np.broadcast_to(ends[:, :1], outlines.shape[:2]), outlines[..., 1]], axis=-1)
    along = np.zeros((len(ends), 3))
    along[:, 1] = ends[:, 1] - ends[:, 0]
    return prisms(near, along)


def _behind(item: BarrelVaultItem, section: VaultSection) -> Polyhedra:
    """One block behind each springing joint, over the whole length."""
    left, right = section.joints[0], section.joints[-1]
    back = item.thickness * section.forwards[[0, -1]]
    outlines = np.stack(
        [
            np.stack([left[1] - back[0], left[1], left[0], left[0] - back[0]]),
            np.stack([right[0] + back[1], right[0], right[1], right[1] + back[1]]),
        ]
    )
    return _along_axis(outlines, np.tile([0.0, item.length], (2, 1)))


def _grounds(item: BarrelVaultItem, section: VaultSection, course: IntArray) -> list[GroundPart]:
    """One plane under the units of the first course, and one under those of the last."""
    found = []
    for joint, number, side in ((0, 0, 1.0), (-1, item.courses - 1, -1.0)):
        (x, z), (dx, dz) = section.joints[joint, 0], side * section.forwards[joint]
        plane = np.array([x, 0.0, z]), np.array([dx, 0.0, dz])
        found.append(GroundPart(*plane, np.flatnonzero(course == number), item.joint))
    return found
