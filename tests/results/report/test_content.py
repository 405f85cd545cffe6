"""Residuals judged exactly as the verification judges them."""

from dataclasses import replace

import numpy as np
import pytest

from mbla.results.listing.sections.figures import residual_rows
from mbla.results.report.assumptions import STILL, assumptions
from mbla.results.report.content import alarm_of, tone_of, verdict_table
from mbla.results.results import CaseResult
from mbla.solution.solution import Checks, Status
from mbla.solution.verification.residuals import Residuals
from mbla.solution.verification.verify_points import Bounds, failures_of, tolerances
from tests.results.rocking import rocking_case
from tests.results.synthetic import tower_results

JUDGED = {
    "equilibrium_residual": "equilibrium",
    "yield_violation": "yielding",
    "penetration": "penetration",
    "complementarity_residual": "complementarity",
    "power_balance": "power_balance",
    "live_power": "live_power",
}


def case_with(flow_rule: str, **changes: float) -> CaseResult:
    case = tower_results(flow_rule).cases[0]
    return replace(case, checks=replace(case.checks, **changes))  # type: ignore[arg-type]


def verdicts(case: CaseResult) -> dict[str, str]:
    """Of every residual, by its name."""
    return {name.replace("relative ", "").replace(" ", "_"): verdict for name, *_, verdict in residual_rows(case)}


@pytest.mark.parametrize("flow_rule", ["associative", "non_associative"])
@pytest.mark.parametrize("name", JUDGED)
@pytest.mark.parametrize("share", [0.99, 1.01])
def test_each_residual_is_judged_as_by_the_verification(flow_rule: str, name: str, share: float) -> None:
    value = share * tolerances(flow_rule)[name]
    value = 1.0 + value if name == "live_power" else value
    case = case_with(flow_rule, **{name: value})
    none = dict.fromkeys(Residuals.__dataclass_fields__, 0.0) | {"live_power": 1.0}
    failures = failures_of(Residuals(**(none | {JUDGED[name]: value})), case.solution, Bounds(0.5, 0.5, 0.5))
    found = verdicts(case)
    assert found[name] == ("NOT PASSED" if failures else "passed") == ("NOT PASSED" if share > 1 else "passed")
    assert list(found.values()).count("NOT PASSED") == len(failures)


def test_the_gap_counts_for_associative_flow_alone() -> None:
    for flow_rule, verdict in (("associative", "NOT PASSED"), ("non_associative", "")):
        assert verdicts(case_with(flow_rule, gap=1e-3))["gap"] == verdict


def test_every_tolerance_has_its_row() -> None:
    assert set(tolerances("associative")) <= set(verdicts(tower_results("associative").cases[0]))
    assert set(tolerances("associative")) <= set(Checks.__dataclass_fields__)
    assert np.isnan(tower_results().cases[1].checks.gap)
    assert residual_rows(tower_results().cases[1]) == []


def test_a_structure_in_time_has_an_answer_although_it_has_no_load_factor() -> None:
    results = tower_results()
    case = rocking_case(results.cases[0])
    alone = replace(results, cases=(case,))
    assert (alarm_of(case), tone_of(case)) == ("", "good")
    heads, (row,) = verdict_table(alone)
    assert heads == ["peak displacement [m]"]
    assert len(row.figures) == 1
    assert "static bound" in verdict_table(replace(results, cases=(case, *results.cases)))[0]
    falls = replace(case, status=Status.NO_EQUILIBRIUM)
    assert alarm_of(falls) == "the structure does not stand under its dead load."
    assert tone_of(falls) == "bad"


def test_what_is_taken_for_granted_of_a_structure_in_time() -> None:
    results = tower_results()
    case = rocking_case(results.cases[0])
    words = " ".join(assumptions(replace(results, cases=(case,))))
    assert STILL not in words
    assert "in time they move as the base does" in words
    assert "slides without lifting" not in words
    assert STILL in " ".join(assumptions(replace(results, cases=(case, *results.cases))))
