"""Pushovers of structures whose joints crush, at the points of a grid: closed form, energies, verification."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from mbla.results.listing.sections.pushover import energy_missing
from mbla.solution.pushover.curve import dropped
from mbla.solution.pushover.curve_rows import CurveEnd
from mbla.solution.verification.pushed_rows import row_residuals
from tests.line import HEAD, case_of, cases_of

DECK = (
    HEAD.replace("contacts: {joint: dry}", 'contacts: {joint: dry, points: {per_edge: "=n"}}')
    + """\
parameters: {fc: 200000, n: 20}
joints: {dry: {friction: 0.3, compressive_strength: "=fc"}}
blocks: [{box: {group: block, material: stone, min: [0, 0, 0], max: [0.2, 0.5, 1]}}]
supports: [{ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}], pushover: {step: 0.01, error: false}}}
"""
)
PRESSED = 2000 * 9.81 * 0.2 / 200000
"""Length of the stress block under the block as it turns, W/(f t)."""


def closed_form(moved: np.ndarray) -> np.ndarray:
    """It turns about the inner end of its stress block, whose middle carries it: as a block narrower by its length."""
    turns = np.linspace(0.0, 0.3, 3001)
    displacement = 0.5 * np.sin(turns) + (0.1 - PRESSED) * (1.0 - np.cos(turns))
    return np.asarray(np.tan(math.atan(0.2 - PRESSED) - np.interp(moved, displacement, turns)))


@pytest.mark.parametrize("solver", ["auto", "mbla"])
def test_a_block_that_crushes_its_toe_rocks_about_the_end_of_its_stress_block(solver: str) -> None:
    """Crushed points sink one more than the other, and friction between them is a couple: 7e-4 at most."""
    _, case = case_of(DECK, f"analysis={{solver: {solver}}}")
    curve = case.solution.further.pushover.curve
    moved, factors = np.array([[row.displacement, row.load_factor] for row in curve]).T
    assert len(curve) > 9
    assert factors == pytest.approx(closed_form(moved), abs=1e-3)
    assert case.solution.further.pushover.curve_end is CurveEnd.NOTHING_LEFT
    assert max(row.residual for row in curve) < 1e-5
    assert curve[-1].crushing > 10.0 * curve[-1].friction
    assert abs(energy_missing(curve)) < 2e-3
    assert dropped(curve) is None


def test_a_row_that_presses_harder_than_the_strength_is_found() -> None:
    assembly, (case,) = cases_of(DECK, "load_cases.push.pushover.steps=1")
    rows, model = case.solution.further.pushover.rows, assembly.model
    assert rows is not None
    weaker = {"dry": replace(model.joints["dry"], compressive_strength=0.9 * 200000)}
    good, bad = (
        row_residuals(each, case.load_case, "non_associative", rows)[-1].law
        for each in (assembly, replace(assembly, model=replace(model, joints=weaker)))
    )
    assert good < 1e-6
    assert bad > 0.05


def test_joints_that_crush_need_points_between_their_corners() -> None:
    _, case = case_of(DECK, "parameters.n=1")
    assert not case.solution.further.pushover.curve
    words = "joints can crush, which is followed at points: give contacts.points a per_edge or spacing"
    assert words in case.solution.remarks[-1].words


@pytest.mark.long
def test_an_arch_that_crushes_is_followed_to_its_end() -> None:
    """Its hinges move inwards, and what they crush is part of the energy."""
    text = DECK.replace(
        "box: {group: block, material: stone, min: [0, 0, 0], max: [0.2, 0.5, 1]}",
        "arch: {material: stone, shape: semicircular, span: 4, thickness: 0.5, width: 0.5, voussoirs: 9}",
    )
    _, case = case_of(text, "joints.dry.friction=0.8", "parameters.n=8", "load_cases.push.pushover.step=0.004")
    curve = case.solution.further.pushover.curve
    assert case.solution.further.pushover.curve_end is CurveEnd.NOTHING_LEFT
    assert max(row.residual for row in curve) < 1e-4
    assert abs(energy_missing(curve)) < 5e-3
