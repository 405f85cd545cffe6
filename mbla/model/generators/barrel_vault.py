"""Generator of barrel vaults: courses of straight prisms along the axis.

The section is that of an arch with straight-edged voussoirs; the volume is its area times the length. With joints at
equal angles d of a circle it is n (R2^2 - R1^2)/2 sin d.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.items.vaults import BarrelVaultItem
from mbla.model.generators.amounts import Amount
from mbla.model.generators.arch_sections import springer_polygons, springing_grounds, vault_section, voussoir_polygons
from mbla.model.generators.generator import Generated, Part, Site
from mbla.model.solids.polyhedra import prisms

NO_UNIT = 1e-6
"""length of a remainder, relative to the unit, that is no unit of its own"""


def amount_barrel_vault(item: BarrelVaultItem) -> Amount:
    """About how many units such an item has."""
    return Amount(item.courses * item.length / item.unit, "length")


def generate_barrel_vault(item: BarrelVaultItem, site: Site) -> Generated:
    """Units course by course from the left springing, along +y in each."""
    section = vault_section(item, item.span)
    rows = [_ends(item, item.bond == "running" and course % 2 == 1) for course in range(item.courses)]
    course = np.repeat(np.arange(item.courses), [len(row) for row in rows])
    polygons = voussoir_polygons(section)[0]
    units = prisms([polygons[number] for number in course.tolist()], np.concatenate(rows))
    labels = {"course": course, "unit": np.concatenate([np.arange(len(row)) for row in rows])}
    parts = [Part(units, labels=labels)]
    if item.springers == "blocks":
        behind = prisms(springer_polygons(section, item.thickness), np.tile([0.0, item.length], (2, 1)))
        parts.append(Part(behind, "_springers", fixed=True))
    grounds = springing_grounds(section, course, item.joint) if item.springers == "ground" else ()
    return Generated(tuple(parts), grounds)


def _ends(item: BarrelVaultItem, shifted: bool) -> FloatArray:
    """Both ends of each unit of a course along y, (n, 2); the first unit is half a one where shifted."""
    first = item.unit / 2 if shifted else item.unit
    joints = first + item.unit * np.arange(int(np.ceil(item.length / item.unit)) + 1)
    inner = joints[joints < item.length - NO_UNIT * item.unit]
    ends = np.concatenate([[0.0], inner, [item.length]])
    return np.stack([ends[:-1], ends[1:]], axis=1)
