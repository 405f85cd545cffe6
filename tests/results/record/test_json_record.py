"""The JSON record: keys, values, reactions, and a mechanism that is found when it is asked for."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import mbla
from mbla.results.collapse.mechanics import load_on_structure
from mbla.results.provenance import CaseNeeds
from mbla.results.quantities.quantity import UNVERIFIED
from mbla.results.record.case_record import powers_of
from mbla.results.record.check_record import check_json
from mbla.results.record.json_record import results_json, verification_json
from mbla.results.record.json_values import json_line
from mbla.results.results import Results
from mbla.solution.solution import Standing, StandingResult, Status
from tests.decks.folder import BENCHMARKS
from tests.results.synthetic import STEP, full_results, tower_results


@pytest.fixture(scope="module")
def record() -> dict[str, Any]:
    record: dict[str, Any] = json.loads(json_line(results_json(replace(tower_results(), files=("tower.h5",)))))
    return record


def test_values(record: dict[str, Any]) -> None:
    model = record["model"]
    solved, fallen = record["cases"]
    assert (model["blocks"], model["free_blocks"], model["interfaces"], model["contact_points"]) == (3, 2, 2, 8)
    assert model["total_weight"] == pytest.approx(65)
    assert model["standing"] == "no"
    assert model["extents"] == [[-1, -1, 0], [5, 2, 3]]
    assert (solved["status"], solved["load_factor"], solved["iterations"]) == ("solved", 0.5, 23)
    assert {mode: solved["mechanism"][mode] for mode in ("open", "slide", "stick")} == {
        "open": 2,
        "slide": 0,
        "stick": 6,
    }
    assert solved["mechanism"]["hinges"] == 1
    assert fallen["status"] == "no_equilibrium"
    assert fallen["load_factor"] is None
    assert fallen["static_bound"] is None
    assert fallen["mechanism"] is None
    assert record["files"] == ["tower.h5"]
    assert solved["solver"] == {"asked": "auto", "used": ["mbla", "clarabel"], "factorization": ["qdldl"]}
    assert fallen["solver"] == {"asked": "auto", "used": [], "factorization": []}


def test_a_number_that_is_none_cannot_slip_through() -> None:
    with pytest.raises(ValueError, match="JSON"):
        json_line({"x": float("nan")})


def test_check_record_has_no_cases() -> None:
    record = check_json(tower_results(), {"push": CaseNeeds({"dimension": 2, "cones": 8}, (STEP,))})
    assert "cases" not in record
    step = {
        "name": "parts",
        "state": "applied",
        "found": 2,
        "before": {"unknowns": 12, "cones": 8, "entries": 80, "largest": 12},
        "after": {"unknowns": 12, "cones": 8, "entries": 80, "largest": 6},
    }
    assert record["needs"] == {"push": {"dimension": 2, "cones": 8, "reductions": [step]}}
    assert record["model"]["dimension"] == 2
    assert record["model"]["joints"] == {"dry": {"interfaces": 2, "area": 2.0}}
    json_line(record)


def test_verification_record_says_whether_the_file_agrees() -> None:
    record = verification_json(tower_results(), ())
    assert record["agrees"] is True
    assert record["not_verified"] == [UNVERIFIED[key] for key in ("versions", "times", "claimed", "course", "words")]
    record = verification_json(tower_results(), ("x differs",))
    assert record["agrees"] is False
    assert record["disagreements"] == ["x differs"]


def test_a_case_without_a_result_has_its_best_iterate_instead() -> None:
    case = results_json(with_first(status=Status.NOT_VERIFIED))["cases"][0]
    assert case["load_factor"] is None
    assert case["mechanism"] is None
    assert case["least_load_factor"] is None
    assert case["best_iterate"]["load_factor"] == 0.5
    assert case["best_iterate"]["residuals"]["complementarity"] == 1e-11
    assert case["associative_load_factor"] == 0.5  # its bounds meet


def test_an_associative_factor_whose_bounds_do_not_meet_is_no_result() -> None:
    case = with_first(status=Status.NOT_VERIFIED, checks={"gap": float("nan")})
    assert results_json(case)["cases"][0]["associative_load_factor"] is None


def with_first(status: Status = Status.SOLVED, **changes: Any) -> Results:
    """The tower's results whose first case has another status, solution or checks."""
    results = tower_results()
    first = results.cases[0]
    solution = replace(first.solution, **changes.get("solution", {}))
    checks = replace(first.checks, **changes.get("checks", {}))
    return replace(results, cases=(replace(first, status=status, solution=solution, checks=checks),))


def test_every_answer_is_in_the_record() -> None:
    results = full_results()
    solution = replace(results.cases[0].solution, standing=StandingResult(Standing.DOUBTFUL, 1, "no plateau"))
    full = replace(results, cases=(replace(results.cases[0], solution=solution),))
    record = json.loads(json_line(results_json(full)))
    case = record["cases"][0]
    assert record["model"]["standing"] == "doubtful"
    assert record["model"]["dimension"] == 2
    assert case["scheme"] == "auto"
    assert case["least_load_factor"] == 0.45
    assert (case["path_end"], case["path_gain"], case["path_last"]) == ("falls", 0.02, 0.4)
    assert case["standing"] == {"verdict": "doubtful", "block": "tower[0]", "reason": "no plateau"}
    assert case["remarks"] == ["the load still rises", "one more", "the mechanism moves in space"]
    assert (case["tension_violation"], case["slip_residual"]) == (1e-9, 2e-9)
    assert case["residuals"] == {
        "equilibrium": 1e-12,
        "yield": 0.0,
        "tension": 1e-9,
        "penetration": 0.0,
        "complementarity": 1e-11,
        "slip": 2e-9,
        "elastic": 3e-9,
    }
    assert case["size"]["dropped_points"] == 4
    assert case["path"][2] == {
        "step": 3,
        "displacement": 4.0,
        "load_factor": 0.6,
        "open": 2,
        "slide": 1,
        "balanced": False,
    }
    assert case["best_iterate"] is None


def test_a_structure_that_hangs_together_by_self_stress_has_no_load_factor_without_normality() -> None:
    record = results_json(full_results())
    case = record["cases"][0]
    assert case["standing"]["verdict"] == "only by self-stress"
    assert case["load_factor"] is None
    assert case["best_iterate"]["load_factor"] == 0.5
    assert case["associative_load_factor"] == 0.55
    assert "only-by-self-stress" in [notice["identifier"] for notice in record["notices"]]


@pytest.mark.parametrize(("least", "shown"), [(0.45, 0.45), (float("nan"), None)])
def test_the_least_load_factor_is_there_where_a_search_found_one(least: float, shown: float | None) -> None:
    case = results_json(with_first(checks={"least_load_factor": least}))["cases"][0]
    assert (case["load_factor"], case["least_load_factor"]) == (0.5, shown)


def test_a_certificate_is_named() -> None:
    assert [case["certificate"] for case in results_json(tower_results())["cases"]] == [None, "motion"]
    lock = full_results().cases[0].solution.lock
    unbounded = with_first(Status.UNBOUNDED, solution={"mechanics": None, "lock": lock})
    assert results_json(unbounded)["cases"][0]["certificate"] == "forces"


def test_the_failure_as_it_is_told() -> None:
    mechanism = results_json(tower_results())["cases"][0]["mechanism"]
    assert mechanism["clusters_merged"] == 0.0
    assert mechanism["clusters"] == mechanism["parts"]
    (line,) = mechanism["hinge_lines"]
    assert line["clusters"] == [1, 0]
    assert line["interfaces"] == [0]
    assert (line["start"], line["end"], line["length"]) == ([1.0, 0.0, 1.0], [1.0, 1.0, 1.0], 1.0)
    assert mechanism["sliding_planes"] == mechanism["cracks"] == []
    assert mechanism["enough"] == {"moving_blocks": 1, "interfaces": 1, "bearing_blocks": 0, "left_out_blocks": 1}


def test_powers_are_relative_to_that_of_the_own_load() -> None:
    """Twice the push does twice the work; of a load that works against its own mechanism nothing is said."""
    results = tower_results("associative")
    model, case = results.model, results.cases[0]
    twice = replace(model.load_cases[1], live_load=2 * model.load_cases[1].live_load)
    told = powers_of(replace(model, load_cases=(model.load_cases[0], twice)), case)
    assert told == pytest.approx({"push_x": 1.0, "fall": 2.0})
    against = replace(case.load_case, live_load=-case.load_case.live_load)
    assert powers_of(model, replace(case, load_case=against)) is None
    with pytest.raises(KeyError, match="push_y"):
        results.case("push_y")
    assert results.case("push_x") is case


@pytest.mark.parametrize("deck", ["guided_blocks", "beam_on_three_supports"])
def test_the_sum_balances_the_loads_with_guides_and_supports_that_settle(deck: str) -> None:
    results = mbla.run(BENCHMARKS[deck].read_text(encoding="utf-8")).records
    for case, record in zip(results.cases, results_json(results)["cases"], strict=True):
        load = load_on_structure(results.model.of_case(case.load_case), case.load_case, record["load_factor"])
        total = [*record["reactions"]["total"]["force"], *record["reactions"]["total"]["moment"]]
        assert np.abs(np.array(total) + load).max() <= 1e-6 * np.abs(load).max()
