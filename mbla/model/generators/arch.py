"""Generators of arches, of straight-edged voussoirs in one or more rings over a curve, and of barrel vaults.

The left springing of the curve lies at the origin, the right one at x = span; the section in the x-z plane is carried
along +y, on a skew plan with x growing by y tan(skew).

A barrel vault has courses of straight prisms along its axis, in the section of an arch: its volume is the area of that
times the length, with joints at equal angles d of a circle n (R2^2 - R1^2)/2 sin d.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.deck.items.arch import ArchItem
from mbla.deck.items.vaults import BarrelVaultItem
from mbla.errors import Finding
from mbla.model.generators.amounts import Amount
from mbla.model.generators.arch_sections import (
    LEVEL,
    Section,
    SpringingJoint,
    Thickness,
    build_section,
    courses,
    end_springer,
    springer_polygons,
    springing_grounds,
    springing_joints,
    unfit_rise,
    vault_section,
    voussoir_polygons,
)
from mbla.model.generators.curves import Curve, named_curve
from mbla.model.generators.curves.spline import through
from mbla.model.generators.generator import Generated, ItemRefused, Part, Site
from mbla.model.solids.polyhedra import Polyhedra, prisms


def amount_arch(item: ArchItem) -> Amount:
    """About how many units such an item has."""
    courses = 2 * item.piers.courses if item.piers else 0
    return Amount(float(item.voussoirs) * item.rings * item.units_across + courses, "voussoirs")


def generate_arch(item: ArchItem, site: Site) -> Generated:
    """Voussoirs ring by ring, from left to right in each; with them piers, ground or fixed blocks at the springings.

    Raises
    ------
    ItemRefused
        where the voussoirs are too few to be blocks or their joints cross, or the piers do not fit the springings
    """
    springing = item.thickness if item.springing_thickness is None else item.springing_thickness
    thickness = Thickness(item.thickness, springing, 0.5 if item.line == "centre" else 0.0)
    section = build_section(_curve(item), item.voussoirs, item.rings, thickness)
    shear = float(np.tan(np.radians(item.skew)))
    voussoirs = _voussoirs(item, section, shear)
    if item.springers == "blocks":
        behind = prisms(springer_polygons(section, springing), _full_width(item, 2), shear)
        return Generated((voussoirs, Part(behind, "_springers", fixed=True)))
    if item.springers == "ground":
        return Generated((voussoirs,), springing_grounds(section, voussoirs.labels["voussoir"], item.joint, shear))
    if item.piers is not None:
        return Generated((voussoirs, *_piers(item, section, shear)))
    return Generated((voussoirs,))


def _curve(item: ArchItem) -> Curve:
    if item.points is not None:
        return through(item.points)
    assert item.span is not None  # a rule of the deck
    return named_curve(item.shape, item.span, item.rise, item.embrace, item.side_angle)


def _voussoirs(item: ArchItem, section: Section, shear: float) -> Part:
    """Blocks of all rings; in running bond across the width every other course begins with half a block."""
    polygons, number, ring = voussoir_polygons(section)
    blocks, across, units = [], [], []
    for polygon, odd in zip(polygons, (number + ring) % 2, strict=True):
        edges = _edges_across(item.width, item.units_across, bool(odd))
        blocks += [polygon] * (len(edges) - 1)
        across.append(np.stack([edges[:-1], edges[1:]], axis=1))
        units.append(np.arange(len(edges) - 1))
    each = np.array([len(unit) for unit in units])
    labels: dict[str, IntArray] = {
        "voussoir": np.repeat(number, each),
        "ring": np.repeat(ring, each),
        "unit": np.concatenate(units),
    }
    return Part(prisms(blocks, np.concatenate(across), shear), member="voussoir", labels=labels)


def _edges_across(width: float, count: int, odd: bool) -> FloatArray:
    """Joints across the width, both faces included."""
    if count == 1 or not odd:
        return np.linspace(0.0, width, count + 1)
    inner = width * (np.arange(count) + 0.5) / count
    return np.concatenate([[0.0], inner, [width]])


def _full_width(item: ArchItem, count: int) -> FloatArray:
    return np.tile([0.0, item.width], (count, 1))


# --- springings ---------------------------------------------------------------------------------------------------


def _piers(item: ArchItem, section: Section, shear: float) -> list[Part]:
    """Courses from the bottom, left and right in each; then the springer blocks where the joints are inclined."""
    assert item.piers is not None
    joints = springing_joints(section)
    _check_piers(item, joints)
    stacks, springers, sides = [], [], []
    for side, joint in enumerate(joints):
        near, far = joint.intrados[0], joint.intrados[0] + joint.side * item.piers.width
        top = joint.intrados[1]
        stacks.append(courses(min(near, far), max(near, far), top - item.piers.height, top, item.piers.courses))
        springer = end_springer(joint, item.piers.width)
        if springer is not None:
            springers.append(springer)
            sides.append(side)
    pairs = [block for course in zip(*stacks, strict=True) for block in course]
    count = np.arange(len(pairs))
    labels = {"course": count // 2, "unit": count % 2}
    parts = [Part(_through(item, pairs, shear), member="pier", labels=labels)]
    if springers:
        above = {"course": np.full(len(sides), item.piers.courses), "unit": np.array(sides)}
        parts.append(Part(_through(item, springers, shear), member="springer", labels=above))
    return parts


def _check_piers(item: ArchItem, joints: tuple[SpringingJoint, SpringingJoint]) -> None:
    assert item.piers is not None
    least = max(joint.reach for joint in joints)
    for joint in joints:
        unfit = unfit_rise(joint)
        if unfit is not None:
            raise ItemRefused(Finding("arch-shape", unfit, "piers"))
    if item.piers.width < least * (1 - LEVEL):
        raise ItemRefused(
            Finding("out-of-bounds", f"must be >= {least:g}, the extent of the springing joint", "piers", "width")
        )
    if joints[1].intrados[0] <= joints[0].intrados[0]:
        raise ItemRefused(Finding("arch-shape", "the piers would overlap: nothing is left of the clear span", "piers"))


def _through(item: ArchItem, polygons: list[FloatArray], shear: float) -> Polyhedra:
    return prisms(polygons, _full_width(item, len(polygons)), shear)


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
