from __future__ import annotations

import re

import numpy as np
import pytest

from mbla.contacts import find_contacts
from mbla.contacts.contacts import ContactReport
from mbla.contacts.report import joining_gap
from tests.contacts.structures import blocks_of, boxes, ground, model_of, section

PILE = boxes(([0, 0, 0], [1, 1, 1]), ([0, 0, 1.004], [1, 1, 2]), ([0, 0, 2.012], [1, 1, 3]), ([1.05, 0, 0], [2, 1, 3]))
"""Gaps of 0.004 and 0.012 in a pile on the ground, and of 0.05 to the pier beside it."""


def report_of(tolerance: float) -> ContactReport:
    return find_contacts(model_of(blocks_of(PILE), grounds=(ground(),)), section(tolerance)).report


def told(report: ContactReport, identifier: str) -> str:
    return next((notice.message for notice in report.notices if notice.identifier == identifier), "")


@pytest.mark.parametrize("tolerance", [1e-4, 1e-3, 3e-3, 1e-2])
def test_the_tolerance_that_closes_all_gaps_is_told_whatever_the_present_one_is(tolerance: float) -> None:
    report = report_of(tolerance)
    loose = told(report, "isolated-blocks") or told(report, "unsupported-parts")
    words = re.search(r"contacts.tolerance ([0-9.]+) all near misses are contacts, from ([0-9.]+) on every", loose)
    assert words is not None
    every, enough = (float(figure) for figure in words.groups())
    assert (every, enough) == (0.053, 0.013)
    assert f"with contacts.tolerance above {every:.2g} all of them are" in told(report, "near-misses")
    assert report_of(enough).unsupported == ()
    assert len(report_of(every).near_misses) == 0


def test_blocks_that_touch_nothing_are_told_before_all_else() -> None:
    assert report_of(1e-3).notices[0].message.startswith("2 of 4 blocks touch nothing: block[1], block[2]; nearest")


def test_the_least_gap_that_joins_every_block_to_a_support() -> None:
    fixed = np.array([True, False, False, False])
    near, gaps = np.array([[0, 1], [1, 2], [0, 2], [2, 3]]), np.array([0.02, -0.03, 0.05, 0.01])
    assert joining_gap(fixed, np.zeros((0, 2), dtype=np.int64), near, gaps) == 0.03
    assert joining_gap(fixed, np.array([[0, 2]]), near, gaps) == 0.02
    assert joining_gap(fixed, np.zeros((0, 2), dtype=np.int64), near[:3], gaps[:3]) is None
