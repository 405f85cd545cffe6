"""What the report says about a structure that has exactly one thing wrong with it.

Round faces whose corners lie within the tolerance of their outline: the remark, and where it is not made.
"""

from __future__ import annotations

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from mbla.contacts import ContactReport, find_contacts
from mbla.contacts.report import unsupported_parts
from mbla.model.solids.polyhedra import join_polyhedra
from tests.contacts.structures import (
    any_rotation,
    blocks_of,
    boxes,
    contacts_of,
    ground,
    model_of,
    moved,
    prism,
    profile,
    section,
)
from tests.line import line_of


def words(report: ContactReport) -> dict[str, str]:
    return {notice.identifier: notice.message for notice in report.notices}


def test_near_miss_between_blocks() -> None:
    pair = boxes(([0, 0, 0], [1, 1, 1]), ([0, 0, 1.004], [1, 1, 2.004]))
    report = contacts_of(pair, grounds=(ground(),)).report
    assert report.near_misses.tolist() == [[0, 1]]
    assert report.near_miss_gaps == pytest.approx([0.004])
    assert words(report)["near-misses"] == (
        "1 near miss, opposite faces that miss each other by more than the tolerance of 0.001: "
        "block[0] and block[1] (0.004 m, 0.004 of the block size); they are no contacts, with contacts.tolerance above "
        "0.0042 all of them are, and so is every real gap of the file up to that"
    )


def test_face_that_opens_like_a_wedge_is_a_near_miss() -> None:
    lower, upper = boxes(([0, 0, 0], [1, 1, 1])), boxes(([0, 0, 1], [1, 1, 2]))
    vertices = upper.vertices + 0.015 * upper.vertices[:, :1] * [0, 0, 1]
    report = contacts_of(join_polyhedra([lower, replace(upper, vertices=vertices)]), fixed=[0]).report
    assert report.near_misses.tolist() == [[0, 1]]
    assert report.near_miss_gaps == pytest.approx([0.015], rel=1e-2)


@pytest.mark.parametrize(("gap", "count"), [(0.009, 1), (0.0101, 0)])
def test_gaps_between_blocks_that_are_held_are_looked_at_up_to_ten_tolerances(gap: float, count: int) -> None:
    shapes = boxes(([0, 0, 0], [1, 1, 1]), ([1 + gap, 0, 0], [2 + gap, 1, 1]))
    assert len(contacts_of(shapes, grounds=(ground(),)).report.near_misses) == count


def test_near_miss_of_the_ground() -> None:
    report = contacts_of(boxes(([0, 0, 0.002], [1, 1, 1])), grounds=(ground(),)).report
    assert report.near_misses.tolist() == [[1, 0]]
    assert set(words(report)) == {"near-misses", "isolated-blocks", "ground-without-contact"}


@pytest.mark.parametrize("turn", [None, any_rotation(2)], ids=["along the axes", "turned"])
def test_neighbours_but_one_of_tiles_like_an_l_are_no_near_misses(turn: np.ndarray | None) -> None:
    """The middle of what they share lies in the notch."""
    outline = [[0.0, 0.0], [4.0, 0.0], [4.0, 0.4], [1.0, 0.4], [1.0, 4.0], [0.0, 4.0]]
    pile = join_polyhedra([prism(outline, 0.01 * i, 0.01 * (i + 1)) for i in range(3)])
    contacts = contacts_of(moved(pile, turn=turn), fixed=[0], tolerance=1e-2)
    assert contacts.bodies.tolist() == [[0, 1], [1, 2]]
    assert len(contacts.report.near_misses) == 0
    apart = pile.vertices + np.repeat([[0, 0, 0], [9, 0, 0], [0, 0, 0]], 12, axis=0)
    report = contacts_of(moved(replace(pile, vertices=apart), turn=turn), fixed=[0], tolerance=1e-2).report
    assert report.near_misses.tolist() == [[0, 2]]


def test_near_miss_beside_a_contact_of_the_same_pair() -> None:
    """A step in the upper block: one foot stands, the other hangs just above."""
    lower = boxes(([0, 0, -1], [3, 1, 0]))
    foot, hanging = boxes(([0, 0, 0], [1, 1, 1])), boxes(([2, 0, 0.003], [3, 1, 1]))
    report = contacts_of(join_polyhedra([lower, foot, hanging]), fixed=[0]).report
    assert report.near_misses.tolist() == [[0, 2]]
    assert report.isolated.tolist() == [2]


def test_sliver() -> None:
    report = contacts_of(boxes(([0, 0, 0], [1, 1, 1]), ([0.9995, 0, 1], [2, 1, 2]))).report
    assert report.slivers.tolist() == [[0, 1]]
    assert report.sliver_widths == pytest.approx([0.0005], rel=1e-3)
    assert words(report)["slivers-dropped"] == (
        "1 common surface narrower than the tolerance of 0.001 dropped: block[0] and block[1] "
        "(0.0005 m, 0.0005 of the block size)"
    )


def test_isolated_block() -> None:
    report = contacts_of(
        boxes(([0, 0, 0], [1, 1, 1]), ([5, 0, 0], [6, 1, 1]), ([0, 0, 1], [1, 1, 2])), fixed=[0]
    ).report
    assert report.isolated.tolist() == [1]
    assert [part.tolist() for part in report.unsupported] == [[1]]
    assert words(report) == {
        "isolated-blocks": "1 of 3 blocks touch nothing: block[1]; exit status 4, unless contacts.isolated is allow"
    }


def test_part_that_reaches_no_support() -> None:
    blocks = boxes(([0, 0, 0], [1, 1, 1]), ([5, 0, 0], [6, 1, 1]), ([0, 0, 1], [1, 1, 2]), ([5, 0, 1], [6, 1, 2]))
    report = contacts_of(blocks, fixed=[0]).report
    assert [part.tolist() for part in report.unsupported] == [[1, 3]]
    assert words(report) == {
        "unsupported-parts": "1 part of the structure not connected to a support, the largest of 2 blocks: "
        "block[1], block[3]"
    }


def test_ground_that_carries_nothing() -> None:
    row = boxes(([0, 0, 0], [1, 1, 1]))
    report = contacts_of(row, grounds=(ground(), ground(point=[9, 0, 0], normal=[1, 0, 0]))).report
    assert set(words(report)) == {"ground-without-contact"}


def test_block_on_both_sides_of_the_ground() -> None:
    row = boxes(([0, 0, 0], [1, 1, 1]), ([1, 0, -0.5], [2, 1, 0.5]))
    report = contacts_of(row, grounds=(ground(),)).report
    assert words(report)["block-crosses-ground"] == "1 block on both sides of ground: block[1]"


@pytest.mark.parametrize("order", [(0, 1, 2), (1, 2, 0), (2, 0, 1)])
def test_a_pair_that_overlaps_is_no_near_miss_too(order: tuple[int, ...]) -> None:
    """A hook that reaches into its neighbour at one place and nearly touches it at another; a third block apart."""
    outline = [(0, 0), (1, 0), (1, 2.004), (3, 2.004), (3, 3), (0, 3)]
    parts = [profile(outline), boxes(([0.9, 0, 0], [3, 1, 2])), boxes(([9, 0, 0], [10, 1, 1]))]
    report = contacts_of(join_polyhedra([parts[place] for place in order])).report
    pair = sorted((order.index(0), order.index(1)))
    assert report.overlaps.tolist() == [pair]
    assert report.near_misses.tolist() == []


PILE = boxes(([0, 0, 0], [1, 1, 1]), ([0, 0, 1.004], [1, 1, 2]), ([0, 0, 2.012], [1, 1, 3]), ([1.05, 0, 0], [2, 1, 3]))
"""Gaps of 0.004 and 0.012 in a pile on the ground, and of 0.05 to the pier beside it."""


def report_of(tolerance: float) -> ContactReport:
    return find_contacts(model_of(blocks_of(PILE), grounds=(ground(),)), section(tolerance)).report


def told(report: ContactReport, identifier: str) -> str:
    return next((notice.message for notice in report.notices if notice.identifier == identifier), "")


@pytest.mark.parametrize("tolerance", [1e-4, 1e-3, 3e-3, 1e-2])
def test_the_tolerance_that_closes_all_gaps_is_told_whatever_the_present_one_is(tolerance: float) -> None:
    report = report_of(tolerance)
    words = re.search(r"with contacts.tolerance above ([0-9.]+) all of them are", told(report, "near-misses"))
    assert words is not None
    every = float(words[1])
    assert every == 0.053
    assert "the widest block[0] and block[3] (0.05 m" in told(report, "near-misses")
    assert len(report_of(every).near_misses) == 0


def parts(fixed: list[bool], bodies: list[tuple[int, int]]) -> list[list[int]]:
    links = np.array(bodies, dtype=np.int64).reshape(-1, 2)
    return [part.tolist() for part in unsupported_parts(np.array(fixed), links)]


@pytest.mark.parametrize(
    ("fixed", "bodies", "left"),
    [
        ([True, False, False], [(0, 1), (1, 2)], []),
        ([False, False], [(2, 0), (0, 1)], []),  # on the ground as body a
        ([False] * 6 + [True], [(5, 1), (0, 3), (2, 6)], [[0, 3], [1, 5], [4]]),  # in order of their first blocks
        ([True, True, False], [(0, 1)], [[2]]),
    ],
)
def test_parts_without_support(fixed: list[bool], bodies: list[tuple[int, int]], left: list[list[int]]) -> None:
    assert parts(fixed, bodies) == left


DRUMS = """\
mbla: 1
parameters: {n: 360, eps: 1.e-3}
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.5}}
blocks:
  - column: {group: column, material: stone, radius: 0.5, height: 4, drums: 2, sides: "=n", polygon: inscribed}
contacts: {joint: dry, tolerance: "=eps"}
supports: [{ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
analysis: {flow_rule: associative}
"""


def remarks(*overrides: str) -> list[str]:
    notices = line_of(DRUMS, *overrides).contacts.report.notices
    return [notice.message for notice in notices if notice.identifier == "outlines-simplified"]


def test_the_share_of_the_area_is_told() -> None:
    contacts = line_of(DRUMS).contacts
    (text,) = remarks()
    assert contacts.point_start[1] < 180
    whole = 180 * math.sin(math.pi / 180) * 0.25
    assert f"by {100 * (1 - contacts.areas[0] / whole):.2g} %" in text
    assert "2 common surfaces" in text
