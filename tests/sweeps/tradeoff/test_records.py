"""JSON and CSV of studies made by hand."""

from __future__ import annotations

import csv
import io
from typing import Any

import pytest

from mbla.sweeps.tradeoff.ladder_run import RungRun
from mbla.sweeps.tradeoff.records import study_csv, study_json
from mbla.sweeps.tradeoff.rung import Rung
from tests.sweeps.tradeoff.hand_made import ladder, study_of, travelling

RUNS = [
    travelling("accuracy: reference", 3.0, 2.0),
    travelling("accuracy: draft", 3.3, 2.02),
    travelling("form: static", 3.0),
    RungRun(Rung("solver: highs"), (), "unfit", "does not take cones"),
]
"""A load of two positions: one rung was stopped after the first, another does not apply."""


def rows_of(runs: list[RungRun], **travel: Any) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(study_csv(study_of(runs, **travel)), newline="")))


def test_positions_of_a_travelling_load_have_lines_of_their_own() -> None:
    rows = rows_of(RUNS, case="axle", positions=2)
    told = [(row["setting"], row["position"], row["load_factor"]) for row in rows]
    assert told == [
        ("accuracy: reference", "", "2.0"),
        ("accuracy: reference", "axle_1", "3.0"),
        ("accuracy: reference", "axle_2", "2.0"),
        ("accuracy: draft", "", "2.02"),
        ("accuracy: draft", "axle_1", "3.3"),
        ("accuracy: draft", "axle_2", "2.02"),
        ("form: static", "", ""),
        ("solver: highs", "", ""),
    ]
    distances = {(row["setting"], row["position"]): row["distance"] for row in rows}
    assert float(distances["accuracy: draft", ""]) == pytest.approx(0.1)
    assert float(distances["accuracy: draft", "axle_1"]) == pytest.approx(0.1)
    assert float(distances["accuracy: draft", "axle_2"]) == pytest.approx(0.01)
    assert distances["form: static", ""] == ""
    assert {row["front"] for row in rows if row["position"]} == {"False"}
    assert {row["case"] for row in rows} == {"axle"}


def test_positions_without_a_reference_have_no_distance() -> None:
    """Of three positions none of the rungs came to the last: there is nothing to hold them against."""
    rows = rows_of(RUNS[:2], case="axle", positions=3)
    told = [(row["setting"], row["position"], row["load_factor"], row["distance"]) for row in rows]
    assert told == [
        ("accuracy: reference", "", "", ""),
        ("accuracy: reference", "axle_1", "3.0", ""),
        ("accuracy: reference", "axle_2", "2.0", ""),
        ("accuracy: draft", "", "", ""),
        ("accuracy: draft", "axle_1", "3.3", ""),
        ("accuracy: draft", "axle_2", "2.02", ""),
    ]


def test_the_record_has_the_positions_of_each_run() -> None:
    (case,) = study_json(study_of(RUNS, case="axle", positions=2))["cases"]
    assert [run["setting"] for run in case["runs"]] == ["accuracy: reference", "accuracy: draft", "form: static"]
    whole, draft, part = case["runs"]
    assert (whole["answer"], whole["positions"][0]["answer"], whole["positions"][1]["answer"]) == (2.0, 3.0, 2.0)
    assert draft["distance"] == pytest.approx(0.1)
    assert "answer" not in part  # of all positions there is none
    assert [each["case"] for each in part["positions"]] == ["axle_1"]
    assert part["distance"] is None


def test_the_record_of_other_load_cases_has_no_positions() -> None:
    (case,) = study_json(study_of(ladder()))["cases"]
    assert {run["positions"] for run in case["runs"]} == {1}
