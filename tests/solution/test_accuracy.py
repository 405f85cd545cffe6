"""Presets keep within the error they promise, and every knob has an effect."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from mbla import run
from mbla.results.exit_status import exit_code
from mbla.results.listing.verdict_words import load_factor_words, uniqueness_words
from mbla.results.results import CaseResult
from mbla.solution.solution import Status
from mbla.solution.verification.verify_points import meets_what_was_asked
from tests.decks.folder import BENCHMARKS
from tests.line import WALL, case_of

ARCH = (Path(__file__).parents[2] / "decks" / "tradeoff" / "arch.yaml").read_text(encoding="utf-8")
DOME = (Path(__file__).parents[2] / "decks" / "tutorials" / "dome.yaml").read_text(encoding="utf-8")
WALL_10 = 0.592864
"""Linear program, to six digits (decks/benchmarks)."""
ARCH_20 = 0.149350

WITHOUT = "analysis.flow_rule=non_associative"


def case(text: str, *overrides: str) -> CaseResult:
    return case_of(text, *overrides)[1]


def factor(result: CaseResult) -> float:
    assert result.solution.mechanics is not None
    return result.solution.mechanics.load_factor


@pytest.mark.parametrize(("accuracy", "error"), [("draft", 1e-2), ("standard", 1e-4), ("reference", 1e-5)])
@pytest.mark.parametrize(
    ("text", "size", "expected"), [(WALL, 5, 0.65), (WALL, 10, WALL_10), (ARCH, 20, ARCH_20)], ids=str
)
def test_error_and_proof(text: str, size: int, expected: float, accuracy: str, error: float) -> None:
    result = case(text, f"parameters.n={size}", f"analysis.accuracy={accuracy}", "analysis.flow_rule=associative")
    assert result.status is Status.SOLVED
    assert factor(result) == pytest.approx(expected, rel=error)
    assert result.checks.gap <= {"draft": 1e-3, "standard": 3e-7, "reference": 1e-7}[accuracy]


def test_a_draft_leaves_out_what_does_not_change_the_load_factor() -> None:
    draft, standard = (case(WALL, f"analysis.accuracy={name}") for name in ("draft", "standard"))
    assert draft.solution.standing is None
    assert standard.solution.standing is not None


def test_a_draft_looks_for_no_lower_state_unless_it_is_told_to() -> None:
    rule = (WITHOUT, "parameters.n=4")
    standard, draft = (case(WALL, *rule, f"analysis.accuracy={name}") for name in ("standard", "draft"))
    told = case(WALL, *rule, "analysis.accuracy=draft", "analysis.search=1")
    assert standard.solution.least is not None
    assert draft.solution.least is None
    assert told.solution.least is not None
    assert factor(draft) == pytest.approx(factor(standard), rel=1e-6)
    assert exit_code([draft]) == 0


def test_the_gap_asked_for_decides_what_is_solved_again() -> None:
    rough = ("analysis.tolerance=1e-3", "analysis.flow_rule=associative", "parameters.n=10")
    one, sharp = case(WALL, *rough, "analysis.gap=0.01"), case(WALL, *rough, "analysis.gap=1e-7")
    assert len(sharp.solution.programs) > len(one.solution.programs)
    assert sharp.checks.gap <= 1e-7 < one.checks.gap


def test_the_tolerance_is_that_of_the_cone_solver() -> None:
    """A rough one spares iterations of the program, not of the whole: its answer needs others to be proved."""
    knobs = ("analysis.gap=1e-2", "analysis.standing=false", "parameters.n=10")
    rough, sharp = (case(WALL, *knobs, f"analysis.tolerance={value}") for value in ("1e-3", "1e-10"))
    assert sharp.checks.gap < 1e-8
    assert sharp.checks.gap < rough.checks.gap <= 1e-2
    assert rough.solution.programs[0].iterations < sharp.solution.programs[0].iterations


def test_a_wide_gap_that_was_asked_for_is_approximate_and_no_failure() -> None:
    """One wall; the solver is stopped so early that its bounds lie further apart than a solved case may have them."""
    rough = ("analysis.tolerance=1e-4", "analysis.solver=clarabel", "parameters.n=10")
    result = case(WALL, *rough, "analysis.gap=0.01")
    assert result.status is Status.APPROXIMATE
    assert result.solution.tolerance_requested == 0.01
    assert "within the gap of 0.01 that was asked for" in result.solution.reason
    assert exit_code([result]) == 0
    assert factor(result) == pytest.approx(WALL_10, rel=1e-2)
    assert not meets_what_was_asked(
        replace(result.solution, tolerance_requested=result.checks.gap / 2.0), result.checks
    )
    assert exit_code([replace(result, solution=replace(result.solution, tolerance_requested=None))]) == 4


def test_a_state_without_normality_is_judged_by_its_residuals_not_by_associative_bounds() -> None:
    """An arch at its least thickness: the bounds of a factor of 0.0015 end 5e-5 apart, which a draft may leave so.

    The load factor without normality lies between them, above what the static bound proves; the upper limit that is
    named beside it is the kinematic bound, which it does not exceed.
    """
    results = run(BENCHMARKS["cocchetti_rizzi_mu_310_stands"], set=("analysis.accuracy=draft", WITHOUT)).records
    model, (result,) = results.model, results.cases
    checks = result.checks
    assert checks.static_bound < factor(result) < checks.kinematic_bound
    assert 1e-5 < checks.gap < 1e-3
    assert max(checks.equilibrium_residual, checks.complementarity_residual, checks.power_balance) < 1e-6
    assert result.status is Status.SOLVED
    assert result.solution.reason == ""
    *others, remark = result.solution.remarks
    assert [other.identifier for other in others] == ["lower-not-searched"]
    assert remark.startswith("with associative flow forces prove")
    assert remark.identifier == "associative-bounds-apart"
    limit = load_factor_words(model, result.load_case, checks.kinematic_bound)
    assert f"the kinematic bound of the associative load factor, {limit}, is an upper limit" in uniqueness_words(
        model, result
    )


@pytest.mark.long
@pytest.mark.parametrize("size", [50, 100, 200])
def test_reference_proves_larger_arches_within_its_promise(size: int) -> None:
    result = case(ARCH, f"parameters.n={size}", "analysis.accuracy=reference", "analysis.flow_rule=associative")
    assert result.status is Status.SOLVED
    assert result.checks.gap <= 1e-7
