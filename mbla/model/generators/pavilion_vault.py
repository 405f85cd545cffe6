"""Generator of pavilion (cloister) vaults; see ``mbla.model.generators.mitres`` for what happens at the hips.

A course with the area A of its profile, the centroid of which lies at a distance c from the middle, goes round the bay
and fills 8 q A c, q the length of the bay over its width: sums of these, and the keystone, are the volume.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.items.vaults import PavilionVaultItem
from mbla.model.generators.amounts import Amount
from mbla.model.generators.generator import Generated, Part, Site, level_ground
from mbla.model.generators.mitres import (
    CORNERS,
    SHORTEST,
    HalfSection,
    along_x,
    along_y,
    first_course,
    half_section,
    keystone,
    mitred,
    reflected,
)
from mbla.model.solids.polyhedra import Polyhedra, join_polyhedra


def amount_pavilion_vault(item: PavilionVaultItem) -> Amount:
    """About how many units such an item has."""
    return Amount(item.courses * sum(item.bay) / item.unit, "unit")


def generate_pavilion_vault(item: PavilionVaultItem, site: Site) -> Generated:
    """Hips from the springings up, four blocks in each course; units of the webs; keystone; fixed springers."""
    section = half_section(item, item.bay)
    hips, webs, labels = [], [], []
    for course in range(section.courses):
        joints = _joints(item, section, course)
        hips += [reflected(_hip(section, course, joints), corner) for corner in CORNERS]
        for span in range(4):
            units = _units(section, course, joints, span)
            webs += [units] if len(units) else []
            labels += [(course, span, unit) for unit in range(len(units))]
    around = {"course": np.repeat(np.arange(section.courses), 4), "segment": np.tile(np.arange(4), section.courses)}
    parts = [Part(join_polyhedra(hips), member="hip", labels=around)]
    if webs:
        rows, spans, units = np.array(labels, dtype=np.int64).T
        positions = {"course": rows, "span": spans, "unit": units}
        parts.append(Part(join_polyhedra(webs), member="web", labels=positions))
    parts.append(Part(keystone(section), member="keystone", labels={"course": np.array([section.courses])}))
    grounds = (level_ground(first_course(parts), item.joint),) if item.springers == "ground" else ()
    if item.springers == "blocks":
        behind = _hip(section, -1, (np.zeros(1), np.zeros(1)))
        feet = join_polyhedra([reflected(behind, corner) for corner in CORNERS])
        parts.append(Part(feet, "_springers", fixed=True, labels={"segment": np.arange(4)}))
    return Generated(tuple(parts), grounds)


def _joints(item: PavilionVaultItem, section: HalfSection, course: int) -> tuple[FloatArray, FloatArray]:
    """Upright joints of a course along x and along y, increasing; the arms of the hips end at the first and last."""
    shifted = item.bond == "running" and course % 2 == 1
    found = []
    for stretched in (1.0, section.stretch):
        reach = stretched * section.profile(course)[:, 0].min() - SHORTEST * item.unit
        reach = np.fmin(reach, max(item.bay))  # infinite, or no number, where a radius is beyond what a double holds
        steps = np.arange(int(max(reach, 0.0) / item.unit) + 1) + (0.5 if shifted else 0.0)
        right = item.unit * steps[item.unit * steps <= reach]
        found.append(np.unique(np.concatenate([-right, right])) if len(right) else np.zeros(1))
    return found[0], found[1]


def _hip(section: HalfSection, course: int, joints: tuple[FloatArray, FloatArray]) -> FloatArray:
    """The block in the corner +x+y, (1, 3, 4, 3): its end along y, the mitre, its end along x."""
    profile = section.profile(course)
    ends = along_y(profile, joints[1][-1]), along_x(profile, section.stretch, joints[0][-1])
    return np.stack([ends[0], mitred(profile, section.stretch), ends[1]])[None]


def _units(section: HalfSection, course: int, joints: tuple[FloatArray, FloatArray], span: int) -> Polyhedra:
    """The units of a course between two hips, counter-clockwise."""
    profile = section.profile(course)
    if span % 2 == 0:
        stations = np.array([along_y(profile, y) for y in joints[1]])
    else:
        stations = np.array([along_x(profile, section.stretch, x) for x in joints[0][::-1]])
    ordered = np.stack([stations[:-1], stations[1:]], axis=1)
    turned = ordered if span < 2 else ordered * [-1.0, -1.0, 1.0]
    return reflected(turned, (1, 1))
