"""Rows of a pushover do not depend on where its steps end, and a row that does is not verified."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.results.listing.pushover import curve_words
from mbla.results.listing.text import within
from mbla.solution.pushover.curve import curve_of
from tests.line import HEAD, case_of, line_of
from tests.solution.test_pushover import columns

WEDGE = (
    HEAD
    + """\
joints: {dry: {friction: 0.4}}
blocks:
  - polyhedron:
      group: a
      material: stone
      vertices: [[0, 0, 0], [1, 0, 0], [0, 0, 1], [0, 0.5, 0], [1, 0.5, 0], [0, 0.5, 1]]
      faces: [[0, 1, 2], [3, 5, 4], [0, 3, 4, 1], [1, 4, 5, 2], [2, 5, 3, 0]]
supports: [{ground: {z: 0}}]
load_cases: {c: {live: [{force: [1000, 0, 0], on: a, at: [0.3, 0.25, 0.25]}], pushover: {step: 0.005, until: 0.1}}}
analysis: {flow_rule: associative}
fill: {f: {on: a, material: soil, level: 1.5, passive: {friction_angle: 30, mobilisation: 0.33}}}
"""
).replace("stone: {density: 2000}", "stone: {density: 2000}, soil: {density: 1700}")
"""A wedge that slides on the ground against soil: weights, friction and passive force do not change on the way."""


def test_a_wedge_that_slides_keeps_its_load_factor_to_the_end() -> None:
    _, case = case_of(WEDGE, "load_cases.c.pushover.until=0.02")
    factors = [row.load_factor for row in case.solution.curve]
    assert factors == pytest.approx([13.55251] * len(factors), rel=1e-6)
    assert case.solution.curve[-1].displacement == pytest.approx(0.02, rel=1e-6)
    assert max(row.residual for row in case.solution.curve) < 1e-6


@pytest.mark.parametrize(
    ("flow", "thickness", "friction", "voussoirs"),
    [("non_associative", 0.34, 0.55, 11), pytest.param("associative", 0.45, 0.79, 5, marks=pytest.mark.long)],
)
def test_where_a_curve_is_to_end_does_not_change_it(
    flow: str, thickness: float, friction: float, voussoirs: int
) -> None:
    """The row at `until` lies on the curve that goes on, which no short step precedes."""
    shape = f"shape: semicircular, span: 3, thickness: {thickness}, width: 0.5, voussoirs: {voussoirs}"
    text = (
        f"{HEAD}joints: {{dry: {{friction: {friction}}}}}\nsupports: []\n"
        f"blocks: [{{arch: {{material: stone, springers: ground, {shape}}}}}]\n"
        "load_cases: {c: {live: [{acceleration: [1, 0, 0]}], pushover: {step: 0.005, until: 0.04, error: false}}}\n"
        f"analysis: {{flow_rule: {flow}}}\n"
    )
    whole = case_of(text)[1].solution.curve
    moved, factors = ([getattr(row, name) for row in whole] for name in ("displacement", "load_factor"))
    for until in (0.01, 0.02, 0.0213):
        last = case_of(text, f"load_cases.c.pushover.until={until}")[1].solution.curve[-1]
        assert last.displacement == pytest.approx(until, rel=1e-6)
        assert last.load_factor == pytest.approx(np.interp(until, moved, factors), rel=2e-3)


def test_a_row_whose_gaps_close_in_less_than_a_step_is_not_verified() -> None:
    """Whatever live work it says it was solved for: gaps that close in none of it excuse any force."""
    line, (_, case) = (
        line_of(WEDGE, "load_cases.c.pushover.until=0.02"),
        case_of(WEDGE, "load_cases.c.pushover.until=0.02"),
    )
    steps = case.solution.pushed
    assert steps is not None
    short = replace(steps, scale=np.append(steps.scale[:-1], 1e-9 * steps.scale[-1]))
    solution = replace(case.solution, pushed=short)
    assert curve_of(line.model, line.contacts, line.deck.contacts, case.load_case, solution)[-1].residual < 1e-6
    forces = steps.forces.copy()
    own = slice(int(steps.point_start[-2]), int(steps.point_start[-1]))
    forces[own, 1:] *= -1.0  # friction drives it: the load factor that gaps over no live work gave
    friction = 0.4 * float(forces[own, 0].sum())
    factors = np.append(steps.load_factors[:-1], steps.load_factors[-1] - 2.0 * friction / 1000.0)
    solution = replace(solution, pushed=replace(short, forces=forces, load_factors=factors))
    assert curve_of(line.model, line.contacts, line.deck.contacts, case.load_case, solution)[-1].residual > 0.1


DIP = (
    HEAD
    + """\
joints: {dry: {friction: 0.7}}
supports: []
blocks:
  - arch:
      {rise: 0.6, material: stone, springers: ground,
      shape: segmental, span: 2, thickness: 0.25, width: 0.5, voussoirs: 7}
load_cases: {c: {live: [{acceleration: [1, 0, 0]}], pushover: {step: 0.006, until: 0.03}}}
"""
)
"""An arch in which a joint that was open closes within a step."""


@pytest.mark.long
def test_rows_that_depend_on_the_step_are_not_called_verified() -> None:
    model, case = case_of(DIP)
    remarks = {remark.identifier: str(remark) for remark in case.solution.remarks}
    assert "pushover-depends-on-step" in remarks
    assert "not 0.006 as asked" in remarks["pushover-steps-shorter"]
    assert curve_words(model, case).count("Approximate") == 1
    fine = case_of(DIP, "load_cases.c.pushover.step=0.001", "load_cases.c.pushover.error=false")[1].solution.curve
    off = [
        row
        for row in case.solution.curve
        if abs(row.load_factor - np.interp(row.displacement, *columns(fine))) > 0.03 and not row.error > 0.01
    ]
    assert not off


def test_figures_have_the_digits_that_their_error_leaves() -> None:
    assert within(0.647123, 0.055) == "0.65 (+- 0.06)"
    assert within(26.1234, 14.7) == "26 (+- 10)"
    assert within(0.0998765, 1e-9) == "0.0998765"
    assert within(0.0998765, np.nan) == "0.0998765"
