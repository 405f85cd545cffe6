"""Which reductions an analysis allows, the record of each, and matrices of smaller programs without rounding."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.sparse as sp

from mbla.deck.sections.analysis import AnalysisSection
from mbla.program.reductions import allowed_reductions
from mbla.program.reductions.restrict import tidy
from mbla.program.reductions.steps import ProgramSize, ReductionSwitches, StepState, size_of
from mbla.solution.solution import Status
from tests.line import WALL, line_of, verified
from tests.solution.by_hand import own_points

SMALL, LARGE = ProgramSize(6, 4, 40, 6), ProgramSize(12, 8, 80, 12)


@pytest.mark.parametrize(
    ("on", "allowed", "found", "state"),
    [
        (True, True, 3, StepState.APPLIED),
        (True, True, 0, StepState.NONE),
        (True, False, 0, StepState.BARRED),
        (False, True, 0, StepState.OFF),
        (False, False, 0, StepState.OFF),
    ],
)
def test_what_became_of_a_reduction(on: bool, allowed: bool, found: int, state: StepState) -> None:
    step = ReductionSwitches(on=on).step("planar", allowed, found, LARGE, SMALL)
    assert (step.name, step.state, step.found, step.before, step.after) == ("planar", state, found, LARGE, SMALL)


def test_programs_without_live_load_do_not_count() -> None:
    loaded = own_points([0, -1.0, 0, -1.0], [1.0, 0, 0, 0])
    larger = own_points([0, -1.0] * 3, [0, 0, 0, 0, 0, 1.0])
    idle = own_points([0, -1.0] * 9, [0.0] * 18)
    assert size_of([loaded, idle, larger]) == ProgramSize(unknowns=10, cones=5, entries=10, largest=6)
    assert size_of([larger, loaded]).largest == 6
    assert size_of([idle]) == ProgramSize(0, 0, 0, 0)
    assert np.count_nonzero(idle.live_load) == 0


def test_without_reason_to_the_contrary_the_deck_is_followed() -> None:
    assert allowed_reductions(AnalysisSection()) == ReductionSwitches()
    assert not allowed_reductions(AnalysisSection(reductions=False)).on


@pytest.mark.parametrize(
    ("analysis", "off"),
    [
        (AnalysisSection(flow_rule="associative", friction_cone="polyhedral"), {"mirror"}),
        (AnalysisSection(flow_rule="associative", force_ranges=True), {"mirror", "points"}),
    ],
)
def test_what_would_change_the_answer_is_off(analysis: AnalysisSection, off: set[str]) -> None:
    allowed = vars(allowed_reductions(analysis))
    assert {name for name, switched_on in allowed.items() if not switched_on} == off


def test_a_pentagon_is_no_mirror_image_of_itself() -> None:
    """One half with its mirror image gave 0.1176 for the circumscribed pentagon, which verification refused."""
    overrides = ("parameters.n=3", "parameters.mu=0.1", "load_cases.push.live=[{acceleration: [0, 1, 0]}]")
    pentagon = ("analysis.friction_cone=polyhedral", "analysis.sides=5", "analysis.standing=false")
    solution, checks, status = verified(line_of(WALL, *overrides, *pentagon))
    assert status is Status.APPROXIMATE, checks.failures
    assert checks.verified
    assert solution.size is not None
    assert solution.size.mirror_planes == 0
    assert checks.static_bound < 0.1 < checks.kinematic_bound < 0.106


def test_rounding_of_the_largest_entry_is_left_out() -> None:
    matrix = tidy(sp.coo_array((np.array([1e-16, -4.0, 1e-3, 0.0]), ([1, 0, 1, 0], [0, 1, 1, 0])), shape=(2, 3)))
    assert matrix.indices.tolist() == [1, 1]
    assert matrix.data.tolist() == [-4.0, 1e-3]
    assert matrix.shape == (2, 3)
    assert tidy(sp.coo_array((2, 3))).nnz == 0


def test_entries_come_in_order() -> None:
    given = sp.csr_array((np.array([3.0, 1.0, 4.0]), np.array([2, 0, 1]), np.array([0, 2, 3])), shape=(2, 3))
    assert not given.has_sorted_indices
    for matrix in (given, sp.csc_array(given), sp.coo_array(given)):
        clean = tidy(matrix)
        assert clean.has_canonical_format
        assert clean.toarray().tolist() == [[1.0, 0.0, 3.0], [0.0, 4.0, 0.0]]
