"""Generator of arch bridges: arches between piers and abutments, coursed spandrels on them, backing and parapets.

The springings lie at z = 0, the first one at the origin; the spans follow each other along +x with the piers between
them, the width along +y. In the plane of the arches the blocks fill exactly what lies between the base of piers and
abutments and the top of the spandrels, less the openings under the chords of the intrados.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.deck.items.bridge import BridgeItem
from mbla.errors import Finding
from mbla.model.generators.arch_sections import (
    LEVEL,
    Section,
    SpringingJoint,
    build_section,
    check_rise,
    check_width,
    end_springer,
    springing_joints,
    stacks,
    voussoir_polygons,
)
from mbla.model.generators.curves import Curve, named_curve
from mbla.model.generators.generator import Generated, ItemRefused, Part, Site
from mbla.model.generators.spandrels import (
    Course,
    Masonry,
    Outline,
    bed_levels,
    bond_of_course,
    build_outline,
    course_pieces,
    coursed,
)
from mbla.model.solids.polyhedra import prisms


@dataclass(frozen=True)
class _Frame:
    """Arches in place, and the springer blocks between and next to them, with their springing joints."""

    sections: tuple[Section, ...]
    joints: tuple[tuple[SpringingJoint, SpringingJoint], ...]
    springers: tuple[FloatArray | None, ...]
    left: float
    right: float


def generate_bridge(item: BridgeItem, site: Site) -> Generated:
    """Voussoirs span by span, piers and abutments, springers, spandrels, backing, parapets.

    Raises ItemRefused where voussoirs are too few or cross, or springing joints do not fit piers and abutments.
    """
    frame = _frame(item)
    parts = [*_arches(item, frame), *_supports(item, frame)]
    if item.spandrels != "none":
        parts += _spandrels(item, frame)
    return Generated(tuple(parts))


def _part(member: str, polygons: list[FloatArray], across: Sequence[float], labels: dict[str, IntArray]) -> Part:
    """Blocks of one member of the bridge from their polygons; ``across`` are both their ends along y, labels (n,)."""
    return Part(prisms(polygons, np.tile(across, (len(polygons), 1))), member=member, labels=labels)


# --- arches and what carries them ---------------------------------------------------------------------------------


def _frame(item: BridgeItem) -> _Frame:
    gap = 0.0 if item.piers is None else item.piers.width
    starts = np.concatenate([[0.0], np.cumsum(np.array(item.spans) + gap)])
    sections = []
    for number, span in enumerate(item.spans):
        rise = item.rise[number] if isinstance(item.rise, list) else item.rise
        voussoirs = item.voussoirs[number] if isinstance(item.voussoirs, list) else item.voussoirs
        curve = named_curve(item.shape, span, rise, None, item.side_angle)
        at_origin = _section(item, number, curve, voussoirs)
        onwards = np.array([starts[number], 0.0])
        apex = None if at_origin.apex is None else at_origin.apex + onwards
        sections.append(Section(at_origin.joints + onwards, at_origin.forwards, apex))
    joints = tuple(springing_joints(section) for section in sections)
    _check_widths(item, joints)
    first, last = joints[0][0], joints[-1][1]
    between = [_pier_springer(one[1], other[0]) for one, other in pairwise(joints)]
    ends = [end_springer(joint, item.abutments.width) for joint in (first, last)]
    left, right = -item.abutments.width, float(last.intrados[0]) + item.abutments.width
    return _Frame(tuple(sections), joints, (ends[0], *between, ends[1]), left, right)


def _section(item: BridgeItem, number: int, curve: Curve, voussoirs: int) -> Section:
    """Arch of one span; its faults are reported at its own number of voussoirs."""
    try:
        return build_section(curve, voussoirs, item.rings, item.thickness, item.thickness)
    except ItemRefused as refused:
        if isinstance(item.voussoirs, int):
            raise
        words = [Finding(message.identifier, message, *path, number) for path, message in refused.findings]
        raise ItemRefused(*words) from None


def _check_widths(item: BridgeItem, joints: tuple[tuple[SpringingJoint, SpringingJoint], ...]) -> None:
    for number, both_sides in enumerate(joints):
        check_rise(both_sides[0], "rise", *([number] if isinstance(item.rise, list) else []))
    findings = list(check_width(item.abutments.width, (joints[0][0], joints[-1][1]), "abutments"))
    for one, other in pairwise(joints):
        assert item.piers is not None  # a rule of the deck
        both = one[1].reach + other[0].reach
        if item.piers.width < both * (1 + LEVEL):
            words = f"must be > {both:g}, the extent of the springing joints on both sides"
            findings.append(Finding("out-of-bounds", words, "piers", "width"))
            break
    if findings:
        raise ItemRefused(*findings)


def _pier_springer(left: SpringingJoint, right: SpringingJoint) -> FloatArray | None:
    """Block between the springing joints on both sides of a pier; None where they are level."""
    if not left.rise:
        return None
    return np.stack([left.intrados, right.intrados, right.extrados, left.extrados])


def _arches(item: BridgeItem, frame: _Frame) -> list[Part]:
    rows = []
    for span, section in enumerate(frame.sections):
        polygons, number, ring = voussoir_polygons(section)
        labels = {"span": np.full(len(polygons), span), "voussoir": number, "ring": ring}
        rows.append(_part("voussoir", polygons, (0.0, item.width), labels))
    return rows


def _supports(item: BridgeItem, frame: _Frame) -> list[Part]:
    """Piers and abutments under the springings, course by course, and the springer blocks on them."""
    rows = []
    if item.piers is not None:
        ends = [(one[1].intrados[0], two[0].intrados[0]) for one, two in pairwise(frame.joints)]
        rows.append(_stacks(item, "pier", ends, item.piers.height, item.piers.courses))
    if item.abutments.height is not None and item.abutments.courses is not None:
        ends = [(frame.left, 0.0), (frame.joints[-1][1].intrados[0], frame.right)]
        rows.append(_stacks(item, "abutment", ends, item.abutments.height, item.abutments.courses))
    springers = [springer for springer in frame.springers if springer is not None]
    if springers:
        labels = {"unit": np.arange(len(springers))}
        rows.append(_part("springer", springers, (0.0, item.width), labels))
    return rows


def _stacks(item: BridgeItem, member: str, ends: list[tuple[float, float]], height: float, count: int) -> Part:
    polygons = stacks([(left, right, 0.0) for left, right in ends], height, count)
    number = np.arange(len(polygons))
    labels = {"course": number // len(ends), "unit": number % len(ends)}
    return _part(member, polygons, (0.0, item.width), labels)


# --- masonry on the arches ----------------------------------------------------------------------------------------


def _spandrels(item: BridgeItem, frame: _Frame) -> list[Part]:
    assert item.unit is not None  # rules of the deck
    assert item.cover is not None
    outline = _outline(frame)
    crowns = np.array([section.line(-1)[:, 1].max() for section in frame.sections])
    top = float(crowns.max()) + item.cover
    if not np.isfinite(top + frame.right - frame.left):
        return []  # coordinates beyond what a double holds: the voussoirs are refused
    masonry = Masonry(*item.unit, extent=min(top, frame.right - frame.left))
    shelves = np.array([springer[:, 1].max() for springer in frame.springers if springer is not None])
    beds = bed_levels(outline, top, crowns, shelves, masonry)
    polygons, course, unit = coursed(outline, beds, (frame.left, frame.right), masonry)
    if not polygons:
        message = "is too large for what lies above the arches: take a smaller unit, or more cover"
        raise ItemRefused(Finding("out-of-bounds", message, "unit"))
    rows = _in_place(item, polygons, {"course": course, "unit": unit})
    if item.parapets is not None:
        rows.append(_parapets(item, frame, masonry, top, len(beds) - 1))
    return rows


def _outline(frame: _Frame) -> Outline:
    """The extrados of all arches, level to the ends of the bridge."""
    chains = [section.line(-1) for section in frame.sections]
    left, right = [[frame.left, chains[0][0, 1]]], [[frame.right, chains[-1][-1, 1]]]
    return build_outline([np.array(left), *chains, np.array(right)])


def _in_place(item: BridgeItem, polygons: list[FloatArray], labels: dict[str, IntArray]) -> list[Part]:
    """Through the full width; or a wall along each face, and backing between them in the lowest courses."""
    if item.spandrel_thickness is None:
        return [_part("spandrel", polygons, (0.0, item.width), labels)]
    near, far = item.spandrel_thickness, item.width - item.spandrel_thickness
    rows = [_along_both_faces(item, "spandrel", polygons, labels, item.spandrel_thickness)]
    filled = np.flatnonzero(labels["course"] < (item.backing or 0))
    if len(filled) and near < far:
        chosen = {name: values[filled] for name, values in labels.items()}
        rows.append(_part("backing", [polygons[i] for i in filled.tolist()], (near, far), chosen))
    return rows


def _along_both_faces(
    item: BridgeItem, member: str, polygons: list[FloatArray], labels: dict[str, IntArray], thickness: float
) -> Part:
    count = len(polygons)
    across = np.repeat([[0.0, thickness], [item.width - thickness, item.width]], count, axis=0)
    both = {name: np.tile(values, 2) for name, values in labels.items()} | {"leaf": np.repeat([0, 1], count)}
    return Part(prisms(polygons * 2, across), member=member, labels=both)


def _parapets(item: BridgeItem, frame: _Frame, masonry: Masonry, top: float, course: int) -> Part:
    """One course on both faces, in bond with the course under it."""
    assert item.parapets is not None
    height = item.parapets.height
    if top + height == top:
        message = f"is too small for {top:g}, the height of the spandrels: make it larger"
        raise ItemRefused(Finding("out-of-bounds", message, "parapets", "height"))
    masonry = replace(masonry, extent=min(masonry.extent, height))
    bond = bond_of_course(frame.left, frame.right, course % 2 == 1, masonry.length)
    outline = Outline(np.array([[frame.left, top], [frame.right, top]]))
    polygons, _ = course_pieces(outline, Course(top, top + height, bond), masonry)
    labels = {"course": np.full(len(polygons), course), "unit": np.arange(len(polygons))}
    return _along_both_faces(item, "parapet", polygons, labels, item.parapets.thickness)
