"""Pushovers of structures on a tilting table against closed forms: the angle over the displacement."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from mbla.results.results import CaseResult
from mbla.solution.pushover.curve_rows import CurveEnd
from mbla.solution.verification.pushed_rows import row_residuals
from tests.line import HEAD, case_of, cases_of

DECK = (
    HEAD
    + """\
parameters: {mu: 0.8, b: 0.2, c: 0, until: 9}
joints: {dry: {friction: "=mu", cohesion: "=c"}}
blocks: [{box: {group: block, material: stone, min: [0, 0, 0], max: ["=b", 0.5, 1]}}]
supports: [{ground: {z: 0}}]
load_cases: {turn: {live: [{tilt: {axis: [0, 1, 0]}}], pushover: {step: 0.01, until: "=until"}}}
"""
)
WEIGHT = 2000 * 0.2 * 0.5 * 9.81


def curve_of(case: CaseResult) -> tuple[np.ndarray, np.ndarray]:
    """Displacements and angles in radians."""
    rows = case.solution.further.pushover.curve
    return np.array([row.displacement for row in rows]), np.radians([row.angle for row in rows])


def turned(moved: np.ndarray, height: float = 0.5) -> np.ndarray:
    """Rotation of the block about its edge, from the displacement of its centre of mass."""
    alpha, radius = math.atan(0.1 / height), math.hypot(0.1, height)
    return np.asarray(alpha - np.arcsin(np.sin(alpha) - moved / radius))


@pytest.mark.parametrize("height", [0.5, 0.75])
def test_a_block_that_has_turned_on_the_table_needs_so_much_less_of_an_angle(height: float) -> None:
    """Angle alpha - theta, tan alpha = b/h; a mass on its top acts where that is."""
    masses = [] if height == 0.5 else ["masses=[{on: block, mass: 200, at: [0.1, 0.25, 1.0]}]"]
    _, case = case_of(DECK, *masses)
    moved, angles = curve_of(case)
    assert len(moved) == 11
    assert angles == pytest.approx(math.atan(0.1 / height) - turned(moved, height), abs=2e-6)
    assert case.solution.further.pushover.curve_end is CurveEnd.NOTHING_LEFT
    assert moved[-1] == pytest.approx(0.1, rel=1e-4)


def test_a_block_slides_on_the_table_at_the_angle_of_friction() -> None:
    _, case = case_of(DECK, "parameters.mu=0.15", "parameters.until=0.1")
    moved, angles = curve_of(case)
    assert moved[-1] == pytest.approx(0.1)
    assert angles == pytest.approx(math.atan(0.15), abs=1e-9)


def test_cohesion_counts_at_the_angle_as_it_is() -> None:
    """W sin = mu W cos + c A."""
    _, case = case_of(DECK, "parameters.mu=0.1", "parameters.b=1", "parameters.c=500", "parameters.until=0.1")
    closed = math.atan(0.1) + math.asin(500 * 0.5 / (5 * WEIGHT) * math.cos(math.atan(0.1)))
    assert curve_of(case)[1] == pytest.approx(closed, abs=1e-8)


def test_loads_that_do_not_turn_keep_their_direction_in_the_structure() -> None:
    """A twentieth of the weight along the table, with arms x and z about the edge: W (x cos - z sin) = W z / 20."""
    _, case = case_of(DECK, "load_cases.turn.dead=[{acceleration: [0.05, 0, 0]}]")
    moved, angles = curve_of(case)
    cos, sin = np.cos(turned(moved)), np.sin(turned(moved))
    across, up = 0.1 * cos - 0.5 * sin, 0.5 * cos + 0.1 * sin
    assert across * np.cos(angles) - up * np.sin(angles) == pytest.approx(0.05 * up, abs=2e-6)
    assert case.solution.further.pushover.curve_end is CurveEnd.NOTHING_LEFT


def test_rows_of_another_angle_are_out_of_balance() -> None:
    assembly, (case,) = cases_of(DECK, "parameters.until=0.03")
    rows = case.solution.further.pushover.rows
    assert rows is not None
    forged = replace(rows, load_factors=rows.load_factors + math.radians(0.1))
    good, bad = (row_residuals(assembly, case.load_case, "non_associative", each)[-1] for each in (rows, forged))
    assert good.balance < 1e-6
    assert bad.balance > 1e-4
