import json
from dataclasses import replace
from typing import Any

import pytest

from mbla.results.json_record import check_json, json_line, results_json, standing, verification_json
from mbla.solution.solution import Status

from .synthetic import tower_results


@pytest.fixture(scope="module")
def record() -> dict[str, Any]:
    record: dict[str, Any] = json.loads(json_line(results_json(replace(tower_results(), files=("tower.h5",)))))
    return record


PROMISED = {
    "": {"mbla", "deck", "exit_code", "model", "cases", "time"},
    "model": {
        "standing",
        "blocks",
        "free_blocks",
        "interfaces",
        "contact_points",
        "dimension",
        "total_weight",
        "units",
    },
    "cases": {
        "name",
        "status",
        "flow_rule",
        "load_factor",
        "static_bound",
        "kinematic_bound",
        "associative_load_factor",
        "equilibrium_residual",
        "yield_violation",
        "complementarity_residual",
        "programs",
        "iterations",
        "mechanism",
        "time",
    },
}


def test_promised_keys_are_there(record: dict[str, Any]) -> None:
    assert set(record) >= PROMISED[""]
    assert set(record["model"]) >= PROMISED["model"]
    for case in record["cases"]:
        assert set(case) >= PROMISED["cases"]
        assert set(case["time"]) == {"total", "solver"}
    assert set(record["time"]) == {"read", "contacts", "solve", "write"}


def test_values(record: dict[str, Any]) -> None:
    model = record["model"]
    solved, fallen = record["cases"]
    assert (model["blocks"], model["free_blocks"], model["interfaces"], model["contact_points"]) == (3, 2, 2, 8)
    assert model["total_weight"] == pytest.approx(65)
    assert model["standing"] == "no"
    assert model["extents"] == [[-1, -1, 0], [5, 2, 3]]
    assert (solved["status"], solved["load_factor"], solved["iterations"]) == ("solved", 0.5, 23)
    assert solved["mechanism"] == {"open": 2, "slide": 0, "stick": 6}
    assert fallen["status"] == "no_equilibrium"
    assert fallen["load_factor"] is None
    assert fallen["static_bound"] is None
    assert fallen["mechanism"] is None
    assert record["files"] == ["tower.h5"]


def test_line_is_one_line_without_nan_and_deterministic() -> None:
    line = json_line(results_json(tower_results()))
    assert "\n" not in line
    assert "NaN" not in line
    assert line == json_line(results_json(tower_results()))


def test_a_number_that_is_none_cannot_slip_through() -> None:
    with pytest.raises(ValueError, match="JSON"):
        json_line({"x": float("nan")})


def test_check_record_has_no_cases() -> None:
    record = check_json(tower_results(), {"push": {"cones": 8}})
    assert "cases" not in record
    assert record["needs"] == {"push": {"cones": 8}}
    assert record["model"]["joints"] == {"dry": {"interfaces": 2, "area": 2.0}}
    json_line(record)


def test_verification_record_says_whether_the_file_agrees() -> None:
    assert verification_json(tower_results(), ())["agrees"] is True
    record = verification_json(tower_results(), ("x differs",))
    assert record["agrees"] is False
    assert record["disagreements"] == ["x differs"]


def test_standing_is_claimed_only_where_it_is_known() -> None:
    solved, fallen = tower_results().cases
    undecided = replace(solved, status=Status.TIME_LIMIT, solution=replace(solved.solution, associative=None))
    assert standing((solved,)) == "yes"
    assert standing((replace(fallen, status=Status.UNBOUNDED),)) == "yes"
    assert standing((solved, fallen)) == "no"
    assert standing((solved, undecided)) is None
    assert standing((undecided, fallen)) == "no"
    assert standing(()) is None
