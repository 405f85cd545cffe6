"""Arches of a bridge in place, and the piers, abutments and springers that carry them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.errors import Finding
from mbla.model.blocks.arches.sections import (
    LEVEL,
    ArchSection,
    SpringingJoint,
    build_section,
    check_rise,
    check_width,
    end_springer,
    springing_joints,
    stacks,
    through,
    voussoir_polygons,
)
from mbla.model.blocks.curves import Curve, named_curve
from mbla.model.blocks.generated import ItemPart, ItemRefused

if TYPE_CHECKING:
    from mbla.model.blocks.bridge import BridgeItem


@dataclass(frozen=True)
class BridgeFrame:
    """Arches in place, and the springer blocks between and next to them, with their springing joints."""

    sections: tuple[ArchSection, ...]
    joints: tuple[tuple[SpringingJoint, SpringingJoint], ...]
    springers: tuple[FloatArray | None, ...]
    left: float
    right: float


def part_through(
    member: str, polygons: list[FloatArray], across: Sequence[float], labels: dict[str, IntArray]
) -> ItemPart:
    """Blocks of one member of the bridge from their polygons; ``across`` are both their ends along y, labels (n,)."""
    return ItemPart(through(polygons, across), member=member, labels=labels)


def frame_of(item: BridgeItem) -> BridgeFrame:
    """Arches and springers in place; raises ItemRefused where these do not fit."""
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
        sections.append(ArchSection(at_origin.joints + onwards, at_origin.forwards, apex))
    joints = tuple(springing_joints(section) for section in sections)
    _check_widths(item, joints)
    first, last = joints[0][0], joints[-1][1]
    between = [_pier_springer(one[1], other[0]) for one, other in pairwise(joints)]
    ends = [end_springer(joint, item.abutments.width) for joint in (first, last)]
    left, right = -item.abutments.width, float(last.intrados[0]) + item.abutments.width
    return BridgeFrame(tuple(sections), joints, (ends[0], *between, ends[1]), left, right)


def _section(item: BridgeItem, number: int, curve: Curve, voussoirs: int) -> ArchSection:
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


def arches(item: BridgeItem, frame: BridgeFrame) -> list[ItemPart]:
    """Voussoirs span by span."""
    rows = []
    for span, section in enumerate(frame.sections):
        polygons, number, ring = voussoir_polygons(section)
        labels = {"span": np.full(len(polygons), span), "voussoir": number, "ring": ring}
        rows.append(part_through("voussoir", polygons, (0.0, item.width), labels))
    return rows


def supports(item: BridgeItem, frame: BridgeFrame) -> list[ItemPart]:
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
        rows.append(part_through("springer", springers, (0.0, item.width), labels))
    return rows


def _stacks(item: BridgeItem, member: str, ends: list[tuple[float, float]], height: float, count: int) -> ItemPart:
    polygons = stacks([(left, right, 0.0) for left, right in ends], height, count)
    number = np.arange(len(polygons))
    labels = {"course": number // len(ends), "unit": number % len(ends)}
    return part_through(member, polygons, (0.0, item.width), labels)
