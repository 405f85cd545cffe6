"""Flow without normality under a rough ``residual``: it stops there, and says what it reached."""

from __future__ import annotations

import math

import pytest

from mbla.results.exit_status import exit_code
from mbla.results.outcome import law_residual
from mbla.results.results import CaseResult
from mbla.solution.solution import Status
from tests.line import WALL, case_of
from tests.solution.nonassociative.test_first_fall import PLANK

ROUGH = 1e-2
WITHOUT = "analysis.flow_rule=non_associative"
SPATIAL = ("analysis.reductions=false",)
DILATANCY = WALL.replace('friction: "=mu"', 'friction: "=mu", dilatancy: 10')


def case(text: str, *overrides: str) -> CaseResult:
    return case_of(text, *overrides)[1]


def factor(result: CaseResult) -> float:
    assert result.solution.mechanics is not None
    return result.solution.mechanics.load_factor


def iterations(result: CaseResult) -> int:
    return sum(program.iterations for program in result.solution.programs)


def test_the_scheme_stops_where_it_was_told_to() -> None:
    """0.65 is the load factor of this wall with any flow rule."""
    sharp, rough = (case(WALL, WITHOUT, *SPATIAL, "analysis.search=0", f"analysis.residual={r}") for r in (1e-6, ROUGH))
    assert sharp.status is Status.SOLVED
    assert law_residual(sharp.checks) <= 1e-9
    assert factor(sharp) == pytest.approx(0.65, rel=1e-9)
    assert law_residual(rough.checks) <= ROUGH
    assert exit_code([rough]) == 0
    assert iterations(rough) < iterations(sharp)
    assert factor(rough) == pytest.approx(factor(sharp), rel=ROUGH)


@pytest.mark.parametrize(
    ("text", "rule"), [(WALL, WITHOUT), (DILATANCY, "analysis.flow_rule=dilatancy")], ids=["without", "with"]
)
def test_it_ends_as_sharply_as_it_can_where_that_was_asked(text: str, rule: str) -> None:
    result = case(text, rule, "analysis.residual=1e-9")
    assert result.status is Status.SOLVED
    assert law_residual(result.checks) <= 1e-8
    assert factor(result) == pytest.approx(0.65, rel=1e-8)


@pytest.mark.long
def test_a_peak_is_looked_for_as_the_knob_says() -> None:
    """A clamped plank, which carries more on the way than when it slides."""
    looked, left = (case(PLANK, WITHOUT, f"analysis.peak={word}") for word in ("true", "false"))
    assert looked.checks.peak_load_factor > 1.4 * factor(looked)
    assert math.isnan(left.checks.peak_load_factor)
    assert "peak-not-examined" in {remark.identifier for remark in left.solution.remarks}
    assert factor(left) == pytest.approx(factor(looked), rel=1e-9)
    assert iterations(left) < iterations(looked)


def test_the_tolerance_is_that_of_the_cone_solver() -> None:
    """A rough one spares iterations of the program, not of the whole: its answer needs others to be proved."""
    knobs = ("analysis.gap=1e-2", "analysis.standing=false", "parameters.n=10")
    rough, sharp = (case(WALL, *knobs, f"analysis.tolerance={value}") for value in ("1e-3", "1e-10"))
    assert sharp.checks.gap < 1e-8
    assert 1e-5 < rough.checks.gap <= 1e-2
    assert rough.solution.programs[0].iterations < sharp.solution.programs[0].iterations
