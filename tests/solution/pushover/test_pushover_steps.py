"""Rows of a pushover do not depend on where its steps end, and a row that does is not verified."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.results.listing.text import within
from mbla.results.results import CaseResult
from mbla.solution.pushover.curve import curve_of
from mbla.solution.pushover.record import RowPoints
from tests.line import HEAD, case_of, line_of

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


@pytest.fixture(scope="module")
def slides() -> CaseResult:
    """The wedge, by 0.02 m."""
    return case_of(WEDGE, "load_cases.c.pushover.until=0.02")[1]


def test_a_wedge_that_slides_keeps_its_load_factor_to_the_end(slides: CaseResult) -> None:
    curve = slides.solution.further.pushover.curve
    factors = [row.load_factor for row in curve]
    assert factors == pytest.approx([13.55251] * len(factors), rel=1e-6)
    assert curve[-1].displacement == pytest.approx(0.02, rel=1e-6)
    assert max(row.residual for row in curve) < 1e-6


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
    whole = case_of(text)[1].solution.further.pushover.curve
    moved, factors = ([getattr(row, name) for row in whole] for name in ("displacement", "load_factor"))
    for until in (0.01, 0.02, 0.0213):
        last = case_of(text, f"load_cases.c.pushover.until={until}")[1].solution.further.pushover.curve[-1]
        assert last.displacement == pytest.approx(until, rel=1e-6)
        assert last.load_factor == pytest.approx(np.interp(until, moved, factors), rel=2e-3)


@pytest.mark.parametrize("what", ["friction", "pose", "load factor", "history"])
def test_a_row_that_is_changed_is_not_verified(slides: CaseResult, what: str) -> None:
    """Forces, pose, load factor and history of a row belong together."""
    line, case = line_of(WEDGE, "load_cases.c.pushover.until=0.02"), slides
    rows, last = case.solution.further.pushover.rows, -1
    assert rows is not None
    own = slice(int(rows.point_start[-2]), int(rows.point_start[-1]))
    points = {name: values.copy() for name, values in vars(rows.points).items()}
    shifts, factors = rows.shifts.copy(), rows.load_factors.copy()
    if what == "friction":  # it drives the wedge
        points["forces"][own, 1:] *= -1.0
        factors[last] -= 2.0 * 0.4 * float(points["forces"][own, 0].sum()) / 1000.0
    elif what == "pose":
        shifts[last, 0, 0] -= 0.001
    elif what == "load factor":
        factors[last] *= 1.001
    else:
        points["history"][own, 1:] *= -1.0
    forged = replace(rows, shifts=shifts, load_factors=factors, points=RowPoints(**points))
    of_case = (line.assembly, case.load_case, case.solution)
    assert curve_of(*of_case, rows)[last].residual < 1e-5
    assert curve_of(*of_case, forged)[last].residual > 1e-4


def test_figures_have_the_digits_that_their_error_leaves() -> None:
    assert within(0.647123, 0.055) == "0.65 (+- 0.06)"
    assert within(26.1234, 14.7) == "26 (+- 10)"
    assert within(0.0998765, 1e-9) == "0.0998765"
    assert within(0.0998765, np.nan) == "0.0998765"
