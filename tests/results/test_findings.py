"""What solver and verification say, as notices, and magnitudes that lie too far apart."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.errors import Message
from mbla.questions.angle import Angle
from mbla.questions.tilt import Tilt
from mbla.results.findings import found_notices, magnitude_notices
from mbla.results.listing.verdict_words import verdict
from mbla.results.outcome import notices_of
from mbla.results.results import CaseResult, Results
from mbla.solution.solution import Status
from mbla.solution.thresholds import GAP_TOLERANCE
from tests.extremes.outcome import Scene, results_of
from tests.extremes.shapes import SLENDER
from tests.extremes.weights import SIDE_BY_SIDE
from tests.results.synthetic import full_results, standing_at, tower_results


def push() -> CaseResult:
    return tower_results().cases[0]


def identifiers(case: CaseResult) -> list[str]:
    return [notice.identifier for notice in found_notices(case)]


def test_a_clean_case_has_none() -> None:
    assert found_notices(push()) == ()


@pytest.mark.parametrize("status", [status for status in Status if status is not Status.SOLVED])
def test_every_other_status_is_a_warning_with_its_reason(status: Status) -> None:
    case = replace(push(), status=status)
    (notice,) = found_notices(case)
    assert (notice.severity, notice.identifier, notice.case) == ("warning", status.value.replace("_", "-"), "push_x")
    assert len(notice.message) > len("push_x: ")
    said = replace(case, solution=replace(case.solution, reason="it rains"))
    assert found_notices(said)[0].message == "push_x: it rains"


def test_failures_and_remarks() -> None:
    case = push()
    failures = (Message("equilibrium-residual", "0.1"), Message("bounds-apart", "1 and 2"))
    remarks = (Message("elastic-path-rises", "on"), Message("pushover-drops", "here"))
    case = replace(
        case, checks=replace(case.checks, failures=failures), solution=replace(case.solution, remarks=remarks)
    )
    assert identifiers(case) == [
        "equilibrium-residual",
        "bounds-apart",
        "elastic-path-rises",
        "pushover-drops",
    ]
    assert [notice.severity for notice in found_notices(case)] == ["warning", "warning", "notice", "warning"]


def test_what_is_claimed_but_not_verified() -> None:
    case = full_results().cases[0]
    assert "least-not-verified" not in identifiers(case)
    doubtful = replace(case, checks=replace(case.checks, least_load_factor=float("nan")))
    assert identifiers(doubtful).count("least-not-verified") == 1
    doubtful = replace(case, checks=replace(case.checks, torsion_load_factor=float("nan")))
    assert identifiers(doubtful).count("torsion-not-verified") == 1


def test_harmless_positions_of_a_travelling_load_are_no_warnings() -> None:
    results = tower_results()
    position = standing_at(1, 2, results.model.blocks.centroids[1], 0.0)
    cases = tuple(replace(push(), load_case=replace(push().load_case, question=position)) for _ in range(2))
    locked = replace(cases[0], status=Status.UNBOUNDED)

    def severities(*chosen: CaseResult) -> list[str]:
        found = notices_of(replace(results, notices=(), cases=chosen))
        return [notice.severity for notice in found if notice.identifier == "unbounded"]

    assert severities(locked, cases[1]) == ["notice"]
    assert severities(locked, locked) == ["warning", "warning"]


def slender(width: float, friction: float, rule: str = "associative", contact_model: str = "convex") -> Results:
    """A block 1 m high, pushed, that tips at its width over its height."""
    overrides = (
        f"parameters.b={width!r}",
        f"parameters.mu={friction!r}",
        f"analysis.flow_rule={rule}",
        f"analysis.contact_model={contact_model}",
    )
    return results_of(Scene("slender", "", SLENDER, overrides))


def said_of(results: Results, identifier: str) -> list[str]:
    return [notice.message for notice in notices_of(results) if notice.identifier == identifier]


def test_friction_far_beyond_what_tips_a_narrow_block_is_named() -> None:
    """Friction of 1e5 times the arm of 0.5 over half the width: what slides it over what tips it."""
    results = slender(1e-4, 1e5)
    stuck = replace(results.cases[0], status=Status.NUMERICAL_ERROR)
    (notice,) = magnitude_notices(results.model, results.contacts, stuck, doubtful=False)
    assert notice.identifier == "magnitudes-far-apart"
    assert "sliding on an interface takes 1e+09 times the push that tips a block on it" in notice.message


def test_it_starts_to_tip_on_the_path() -> None:
    (case,) = slender(1e-4, 1e5, "non_associative").cases
    assert case.status is Status.SOLVED
    assert case.solution.mechanics is not None
    assert case.solution.mechanics.load_factor == pytest.approx(1e-4, rel=1e-5)


def test_what_was_not_verified_came_from_a_program_that_failed() -> None:
    """The solver gives no reason where another program came to an answer, and that does not hold."""
    (case,) = slender(1e-4, 1e5).cases
    assert not case.solution.reason
    record = replace(case.solution.programs[0], status=Status.NUMERICAL_ERROR)
    case = replace(case, status=Status.NOT_VERIFIED, solution=replace(case.solution, programs=(record,)))
    first = found_notices(case)[0]
    assert first.identifier == "not-verified"
    assert "the solver failed numerically in program 1 (associative)" in first.message
    kept = replace(case, solution=replace(case.solution, programs=()))
    assert found_notices(kept)[0].message == "push: verification does not confirm the answer"


@pytest.mark.parametrize(
    ("friction", "words"),
    [
        (1e-10, "collapses at 0 g to within 2e-09 g, verified"),
        (1e-6, "collapses at 1e-06 g to within 2e-09 g, verified"),
        (1e-4, "collapses at 0.0001 g, verified"),
    ],
)
def test_a_load_factor_that_rounding_could_have_made_says_so(friction: float, words: str) -> None:
    """Friction of 1e-10 and 1e-6 is told from zero by less than a ten thousandth, 1e-4 by more."""
    results = slender(0.5, friction, contact_model="concave")
    (case,) = results.cases
    assert verdict(results.model, case) == words
    assert bool(said_of(results, "load-factor-rounding")) == (friction < 1e-5)


def test_an_angle_that_rounding_could_have_made_is_none() -> None:
    """A table on which blocks slide at once, to within rounding."""
    results = slender(0.5, 1e-10, contact_model="concave")
    (case,) = results.cases
    load = case.load_case.live_load
    tilted = replace(case.load_case, question=Angle(Tilt(np.array([0.0, 1.0, 0.0]), load, load, load)))
    assert verdict(results.model, replace(case, load_case=tilted)) == "collapses at 0 degrees of tilt, verified"


def test_a_heavy_block_at_rest_makes_no_load_factor_next_to_nothing() -> None:
    """The pushed block beside one of 1e8 times its weight slides alone at 0.4: dead over live load are 1e8."""
    overrides = ("parameters.light=1.0e8", "analysis.flow_rule=associative", "analysis.contact_model=convex")
    results = results_of(Scene("side by side", "", SIDE_BY_SIDE, overrides))
    (case,) = results.cases
    assert case.checks.static_bound <= 0.4 <= case.checks.kinematic_bound
    assert case.checks.gap <= GAP_TOLERANCE
    assert not said_of(results, "load-factor-rounding")
    assert case.solution.mechanics is not None
    assert case.solution.mechanics.load_factor == pytest.approx(0.4, rel=GAP_TOLERANCE)


@pytest.mark.parametrize(("friction", "named"), [(1e-9, True), (1e-3, False), (0.0, False)])
def test_friction_that_is_next_to_none_is_named_where_a_case_is_not_settled(friction: float, named: bool) -> None:
    results = slender(0.5, friction, contact_model="concave")
    (case,) = results.cases
    stuck = replace(case, status=Status.NUMERICAL_ERROR)
    notices = magnitude_notices(results.model, results.contacts, stuck, doubtful=False)
    assert [notice.identifier for notice in notices] == ["magnitudes-far-apart"] * named
    assert all("friction of 1e-09 is negligible" in notice.message for notice in notices)
