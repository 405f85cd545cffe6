"""Results of a sweep: their paths, and what is at them in the records of real runs."""

from __future__ import annotations

import re
from typing import Any

import pytest

import mbla
from mbla.deck.units import Units
from mbla.results.record.json_record import results_json
from mbla.sweeps.results import reason_of, result_columns, result_fault, result_places, values_of
from tests.decks.folder import BENCHMARKS
from tests.results.synthetic import tower_results


@pytest.fixture(scope="module")
def record() -> dict[str, Any]:
    return results_json(tower_results())


def values(record: dict[str, Any], *paths: str, cases: tuple[str, ...] = ("push_x",)) -> dict[str, Any]:
    return values_of(record, result_places(paths, cases))


# --- paths that are results ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("path", "kind", "unit"),
    [
        ("load_factor", "float", ""),
        ("mechanism.class", "text", ""),
        ("verified", "bool", ""),
        ("mechanism.moving_blocks", "int", ""),
        ("mechanism.parts.0.weight", "float", "kN"),
        ("reactions.total.moment.2", "float", "kN mm"),
        ("reactions.supports.ground z = 0.5.force.0", "float", "kN"),
        ("worst.distance", "float", "mm"),
        ("positions.3.load_factor", "float", ""),
        ("model.contact_area", "float", "mm2"),
        ("settings.solver", "text", ""),
        ("time.solve", "float", "s"),
    ],
)
def test_paths_have_kind_and_unit(path: str, kind: str, unit: str) -> None:
    assert result_fault(path) == ""
    (column,) = result_columns([path], ["push"], Units("mm", "kN", "t"))
    assert (column.name, column.kind, column.unit, column.role, column.path) == (path, kind, unit, "result", path)
    assert column.case == ("" if path.split(".")[0] in ("model", "settings", "time") else "push")


@pytest.mark.parametrize(
    ("path", "words"),
    [
        ("load_facto", "is no result; did you mean load_factor?"),
        ("zzzz", "is no result; results are the keys of `cases[]` in schemas/results.md"),
        ("mechanism", "is an object, no single value; take mechanism.class, mechanism.open"),
        ("angle_bounds", "is a list, no single value; take angle_bounds.0"),
        ("reactions.total", "is an object, no single value; take reactions.total.force.0 or reactions.total.moment.0"),
        ("angle_bounds.first", "is no result"),
        ("mechanism.class.0", "is no result"),
        ("model.slivers", "is no result"),  # of mbla check alone
        ("exit_code", "is no result"),  # a column anyway
        ("push.load_factor", "stands without its load case, as load_factor"),
        ("", "must not be empty"),
    ],
)
def test_paths_that_are_none_are_told_with_what_is_meant(path: str, words: str) -> None:
    fault = result_fault(path, ["push"])
    assert fault.startswith(words)
    assert re.fullmatch(r"[^\n]+", fault)


def test_several_load_cases_have_a_column_each() -> None:
    columns = result_columns(["status", "model.blocks", "load_factor"], ["x", "y"], Units())
    assert [column.name for column in columns] == [
        "x.status",
        "x.load_factor",
        "y.status",
        "y.load_factor",
        "model.blocks",
    ]


# --- values -------------------------------------------------------------------------------------------------------


def test_values_of_a_case_and_of_the_run(record: dict[str, Any]) -> None:
    found = values(record, "load_factor", "mechanism.hinge_lines.0.start.2", "model.blocks", "mechanism.parts.7.weight")
    assert list(found.values()) == [0.5, 1.0, None, 3]  # those of the run come last


def series(*positions: tuple[str, float | None], worst: int | None) -> dict[str, Any]:
    """A travelling load and its cases."""
    found = [
        {"case": f"t_{row}", "position": row, "status": status, "load_factor": factor}
        for row, (status, factor) in enumerate(positions, 1)
    ]
    time = {"total": 0.5, "solver": 0.25}
    cases = [{"name": each["case"], "verified": True, "time": time, **each} for each in found]
    own = None if worst is None else found[worst]
    return {
        "cases": cases,
        "series": [{"name": "t", "complete": True, "positions": found, "worst": own}],
        "objectives": [],
    }


def test_a_travelling_load_has_the_values_of_its_worst_position() -> None:
    record = series(("solved", 0.5), ("solved", 0.3), ("unbounded", None), worst=1)
    found = values(record, "status", "load_factor", "worst.position", "positions.0.load_factor", cases=("t",))
    assert list(found.values()) == ["solved", 0.3, 2, 0.5]
    assert values(record, "time.total", cases=("t",)) == {"time.total": 1.5}  # of all positions


@pytest.mark.parametrize(
    ("statuses", "expected"),
    [
        (("solved", "unbounded", "not_verified"), "not_verified"),
        (("no_equilibrium", "no_equilibrium"), "no_equilibrium"),
        (("unbounded", "unbounded"), "unbounded"),
    ],
)
def test_a_travelling_load_whose_worst_is_not_known_has_no_load_factor(
    statuses: tuple[str, ...], expected: str
) -> None:
    record = series(*((status, 0.5 if status == "solved" else None) for status in statuses), worst=None)
    assert list(values(record, "status", "load_factor", cases=("t",)).values()) == [expected, None]


def test_a_travelling_load_as_it_is_run() -> None:
    deck = BENCHMARKS["beam_under_travelling_load"].read_text(encoding="utf-8")
    record = results_json(mbla.run(deck).records)
    assert record["series"]
    for travel in record["series"]:
        found = values(record, "status", "load_factor", "mechanism.class", "worst.distance", cases=(travel["name"],))
        factors = [each["load_factor"] for each in travel["positions"] if each["load_factor"] is not None]
        assert found["load_factor"] == pytest.approx(min(factors))
        assert found["status"] == "solved"
        assert found["mechanism.class"] is not None
        assert found["worst.distance"] == travel["worst"]["distance"]


def test_a_reason_names_its_load_cases_where_there_are_several() -> None:
    falls, late = "the dead load alone is not carried", "the time limit was reached"
    cases = [{"name": name, "reason": reason} for name, reason in zip("abcd", (falls, None, late, falls), strict=True)]
    assert reason_of({"cases": cases, "notices": []}) == f"a and d: {falls}; c: {late}"
    assert reason_of({"cases": cases[:1], "notices": []}) == falls
    assert reason_of({"cases": cases[1:2], "notices": []}) == ""
