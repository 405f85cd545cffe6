from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mbla.results.outcome import (
    associative_of,
    case_notices,
    dimension_of,
    falls_while_moving,
    law_residual,
    least_known,
    result_of,
    standing_of,
)
from mbla.results.results import CaseResult
from mbla.solution.solution import ModelSize, Standing, StandingResult, Status
from mbla.solution.standing.standing import DOUBTFUL, SLOWLY
from mbla.solution.verification.verify import verify
from tests.line import BLOCK, line_of, solution_of
from tests.results.synthetic import tower_results

SOLVED, FALLEN = tower_results().cases
YES, SELF, NO, DOUBT = Standing.YES, Standing.SELF_STRESS, Standing.NO, Standing.DOUBTFUL


def with_standing(verdict: Standing | None, case: CaseResult = SOLVED) -> CaseResult:
    standing = None if verdict is None else StandingResult(verdict, 1, "why")
    return replace(case, solution=replace(case.solution, standing=standing))


def test_a_doubt_is_told_once() -> None:
    told = StandingResult(Standing.DOUBTFUL, 1, f"{DOUBTFUL}: {SLOWLY}")
    (notice,) = case_notices(replace(SOLVED, solution=replace(SOLVED.solution, standing=told)))
    words = "push_x: whether the structure stands without self-stress could not be decided: "
    assert notice.message == words + SLOWLY


@pytest.mark.parametrize(
    ("verdicts", "worst"),
    [
        ([YES], "yes"),
        ([YES, YES], "yes"),
        ([YES, None], None),
        ([None], None),
        ([], None),
        ([YES, DOUBT, None], "doubtful"),
        ([DOUBT, SELF], "only by self-stress"),
        ([SELF, NO, YES], "no"),
    ],
)
def test_the_worst_verdict_speaks_for_the_structure(verdicts: list[Standing | None], worst: str | None) -> None:
    assert standing_of([with_standing(verdict) for verdict in verdicts]) == worst


@pytest.mark.parametrize("status", list(Status))
def test_only_solved_and_approximate_cases_have_a_result(status: Status) -> None:
    found = result_of(replace(SOLVED, status=status))
    assert (found is not None) == (status in (Status.SOLVED, Status.APPROXIMATE))


@pytest.mark.parametrize(("verdict", "has_result"), [(YES, True), (DOUBT, True), (SELF, False), (NO, False)])
def test_self_stress_takes_the_factor_away_but_not_the_associative_one(verdict: Standing, has_result: bool) -> None:
    case = with_standing(verdict)
    assert (result_of(case) is not None) == has_result
    associative = replace(case, solution=replace(case.solution, flow_rule="associative"))
    assert result_of(associative) is not None


def test_the_associative_answer_is_one_where_the_path_beside_it_came_to_none() -> None:
    line = line_of(BLOCK, "analysis.flow_rule=non_associative")
    solution = replace(solution_of(line), status=Status.NOT_VERIFIED, mechanics=None, reason="the path did not begin")
    checks = verify(line.assembly, line.load_case, solution)
    assert not checks.verified
    assert checks.kinematic_bound == pytest.approx(0.5, rel=1e-6)
    assert checks.gap < 1e-6
    assert associative_of(CaseResult(line.load_case, solution, checks, Status.NOT_VERIFIED)) is solution.associative


@pytest.mark.parametrize(("least", "known"), [(0.45, 0.45), (0.55, 0.5), (float("nan"), 0.5)])
def test_one_designs_with_the_smaller_of_the_load_factor_and_the_least_found(least: float, known: float) -> None:
    assert least_known(replace(SOLVED, checks=replace(SOLVED.checks, least_load_factor=least))) == known
    assert np.isnan(least_known(FALLEN))


@pytest.mark.parametrize(
    ("end", "last", "falls"),
    [("falls", 0.49, True), ("falls", 0.5, False), ("far", 0.4, True), ("far", 0.49, False)],
)
def test_the_load_falls_while_it_moves_where_the_path_ends_so_or_well_below_its_greatest(
    end: str, last: float, falls: bool
) -> None:
    case = replace(SOLVED, solution=replace(SOLVED.solution, path_end=end, path_last=last))
    assert falls_while_moving(case) is falls


def test_dimension_is_two_only_where_every_case_was_planar() -> None:
    def case(dimension: int) -> CaseResult:
        return replace(SOLVED, solution=replace(SOLVED.solution, size=ModelSize(dimension, 0, 1, 2, 4, 0)))

    assert dimension_of([case(2), case(2)]) == 2
    assert dimension_of([case(2), case(3)]) == 3
    assert dimension_of([case(2), SOLVED]) == 3
    assert dimension_of([]) == 3


def test_law_residual_is_the_largest_that_is_known() -> None:
    nan = float("nan")
    assert law_residual(replace(SOLVED.checks, slip_residual=0.25, complementarity_residual=nan)) == 0.25
    assert np.isnan(law_residual(FALLEN.checks))


def test_a_warning_speaks_of_a_load_factor_only_where_there_is_one() -> None:
    case = with_standing(SELF)
    assert "its load factor is no collapse load: why" in case_notices(case)[0].message
    unbounded = replace(case, solution=replace(case.solution, mechanics=None), status=Status.UNBOUNDED)
    assert "load factor" not in case_notices(unbounded)[0].message


@pytest.mark.parametrize(
    ("case", "identifiers"),
    [
        (SOLVED, []),
        (with_standing(YES), []),
        (with_standing(SELF), ["only-by-self-stress"]),
        (with_standing(DOUBT), ["standing-doubtful"]),
        (replace(SOLVED, checks=replace(SOLVED.checks, slip_residual=2e-6)), ["law-residual"]),
        (replace(SOLVED, checks=replace(SOLVED.checks, slip_residual=5e-7)), []),
    ],
)
def test_warnings(case: CaseResult, identifiers: Any) -> None:
    notices = case_notices(case)
    assert [notice.identifier for notice in notices] == identifiers
    assert all(notice.severity == "warning" and notice.message.startswith("push_x: ") for notice in notices)
