"""Generators of arches, of straight-edged voussoirs in one or more rings over a curve, and of barrel vaults.

The left springing of the curve lies at the origin, the right one at x = span; the section in the x-z plane is carried
along +y, on a skew plan with x growing by y tan(skew).

A barrel vault has courses of straight prisms along its axis, in the section of an arch: its volume is the area of that
times the length, with joints at equal angles d of a circle n (R2^2 - R1^2)/2 sin d.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.deck.items.arch import ArchItem, ArchPiers
from mbla.deck.items.vaults import BarrelVaultItem
from mbla.errors import Finding
from mbla.model.generators.arch_sections import (
    Section,
    build_section,
    check_rise,
    check_width,
    end_springer,
    springer_polygons,
    springing_grounds,
    springing_joints,
    stacks,
    vault_section,
    voussoir_polygons,
)
from mbla.model.generators.curves import Curve, named_curve
from mbla.model.generators.curves.spline import through
from mbla.model.generators.generator import Generated, GroundPart, ItemRefused, Part, Site
from mbla.model.generators.haunches import haunch_grounds, haunches
from mbla.model.solids.polyhedra import Polyhedra, prisms


def generate_arch(item: ArchItem, site: Site) -> Generated:
    """Voussoirs ring by ring, from left to right in each; with them piers, ground or fixed blocks at the springings.

    Raises
    ------
    ItemRefused
        where the voussoirs are too few to be blocks or their joints cross, or the piers do not fit the springings
    """
    springing = item.thickness if item.springing_thickness is None else item.springing_thickness
    inside = 0.5 if item.line == "centre" else 0.0
    section = build_section(_curve(item), item.voussoirs, item.rings, item.thickness, springing, inside)
    shear = float(np.tan(np.radians(item.skew)))
    voussoirs = _voussoirs(item, section, shear)
    parts, grounds = [voussoirs], tuple[GroundPart, ...]()
    if item.backing is not None:
        width = None if item.piers is None else item.piers.width
        made = haunches(item.backing, section, width, lambda _: np.array([[0.0, item.width]]), shear)
        parts.append(made[0])
        if item.springers != "none":
            grounds = haunch_grounds(*made[1:], len(voussoirs.polyhedra), item.joint)
    if item.springers == "blocks":
        parts.append(Part(_through(item, springer_polygons(section, springing), shear), "_springers", fixed=True))
    if item.springers == "ground":
        grounds = (*springing_grounds(section, voussoirs.labels["voussoir"], item.joint, shear), *grounds)
    parts += _piers(item, item.piers, section, shear) if item.piers else ()
    return Generated(tuple(parts), grounds)


def _curve(item: ArchItem) -> Curve:
    if item.points is not None:
        return through(item.points)
    assert item.span is not None  # a rule of the deck
    return named_curve(item.shape, item.span, item.rise, item.embrace, item.side_angle)


def _voussoirs(item: ArchItem, section: Section, shear: float) -> Part:
    """Blocks of all rings; in running bond across the width every other course begins with half a block."""
    polygons, number, ring = voussoir_polygons(section)
    even = np.linspace(0.0, item.width, item.units_across + 1)
    odd = np.concatenate([[0.0], (even[:-1] + even[1:]) / 2, [item.width]]) if item.units_across > 1 else even
    rows = [ends_of(odd if shifted else even) for shifted in (number + ring) % 2]
    block = np.repeat(np.arange(len(polygons)), [len(row) for row in rows])
    unit = np.concatenate([np.arange(len(row)) for row in rows])
    labels: dict[str, IntArray] = {"voussoir": number[block], "ring": ring[block], "unit": unit}
    made = prisms([polygons[row] for row in block.tolist()], np.concatenate(rows), shear)
    return Part(made, member="voussoir", labels=labels)


def ends_of(joints: FloatArray) -> FloatArray:
    """Both ends of each unit between joints (n + 1,), (n, 2)."""
    return np.stack([joints[:-1], joints[1:]], axis=1)


# --- springings ---------------------------------------------------------------------------------------------------


def _piers(item: ArchItem, piers: ArchPiers, section: Section, shear: float) -> Iterator[Part]:
    """Courses from the bottom, left and right in each; then the springer blocks where the joints are inclined."""
    joints = springing_joints(section)
    for joint in joints:
        check_rise(joint, "piers")
    if findings := list(check_width(piers.width, joints, "piers")):
        raise ItemRefused(*findings)
    (left, left_top), (right, right_top) = (joint.intrados for joint in joints)
    if right <= left:
        raise ItemRefused(Finding("arch-shape", "the piers would overlap: nothing is left of the clear span", "piers"))
    places = [(left - piers.width, left, left_top), (right, right + piers.width, right_top)]
    blocks = stacks(places, piers.height, piers.courses)
    count = np.arange(len(blocks))
    yield Part(_through(item, blocks, shear), member="pier", labels={"course": count // 2, "unit": count % 2})
    springers = [(side, end_springer(joint, piers.width)) for side, joint in enumerate(joints)]
    polygons = [polygon for _, polygon in springers if polygon is not None]
    if polygons:
        sides = np.array([side for side, polygon in springers if polygon is not None])
        labels = {"course": np.full(len(sides), piers.courses), "unit": sides}
        yield Part(_through(item, polygons, shear), member="springer", labels=labels)


def _through(item: ArchItem, polygons: list[FloatArray], shear: float) -> Polyhedra:
    """Blocks over the full width."""
    return prisms(polygons, np.tile([0.0, item.width], (len(polygons), 1)), shear)


NO_UNIT = 1e-6
"""length of a remainder, relative to the unit, that is no unit of its own"""


def generate_barrel_vault(item: BarrelVaultItem, site: Site) -> Generated:
    """Units course by course from the left springing, along +y in each; haunches.

    Raises ItemRefused where haunches do not fit.
    """
    section = vault_section(item, item.span)

    def across(course: int) -> FloatArray:
        """Both ends of each unit of a course."""
        return _ends(item, item.bond == "running" and course % 2 == 1)

    rows = [across(course) for course in range(item.courses)]
    course = np.repeat(np.arange(item.courses), [len(row) for row in rows])
    polygons = voussoir_polygons(section)[0]
    units = prisms([polygons[number] for number in course.tolist()], np.concatenate(rows))
    labels = {"course": course, "unit": np.concatenate([np.arange(len(row)) for row in rows])}
    member = "barrel" if item.backing else ""
    parts, grounds = [Part(units, member=member, labels=labels)], tuple[GroundPart, ...]()
    if item.backing is not None:
        made = haunches(item.backing, section, None, across)
        parts.append(made[0])
        if item.springers != "none":
            grounds = haunch_grounds(*made[1:], len(units), item.joint)
    if item.springers == "blocks":
        behind = prisms(springer_polygons(section, item.thickness), np.tile([0.0, item.length], (2, 1)))
        parts.append(Part(behind, "_springers", fixed=True))
    if item.springers == "ground":
        grounds = (*springing_grounds(section, course, item.joint), *grounds)
    return Generated(tuple(parts), grounds)


def _ends(item: BarrelVaultItem, shifted: bool) -> FloatArray:
    """Both ends of each unit of a course along y, (n, 2); the first unit is half a one where shifted."""
    first = item.unit / 2 if shifted else item.unit
    joints = first + item.unit * np.arange(int(np.ceil(item.length / item.unit)) + 1)
    inner = joints[joints < item.length - NO_UNIT * item.unit]
    return ends_of(np.concatenate([[0.0], inner, [item.length]]))
