"""Reactions in the JSON record: named by ground plane and group, their sum in balance with the loads."""

from dataclasses import replace

import numpy as np
import pytest

import mbla
from mbla.results.collapse.mechanics import load_on_structure
from mbla.results.records.json_record import results_json
from mbla.solution.solution import Status
from tests.decks.folder import BENCHMARKS
from tests.results.synthetic import tower_results


def test_supports_and_their_sum() -> None:
    """Tower and brick of 10 N each, both pushed with 5 N at load factor 1/2."""
    case = results_json(tower_results())["cases"][0]
    found = case["reactions"]
    assert set(found["supports"]) == {"ground z = 0", "base (fixed blocks)"}
    for support in found["supports"].values():
        assert support["force"] == pytest.approx([-5, 0, 10])
    assert found["total"]["force"] == pytest.approx([-10, 0, 20])
    # the tower on its edge x = 1, y = 1/2 at the height z = 1 of the base: (x, y, z) × F
    assert found["supports"]["base (fixed blocks)"]["moment"] == pytest.approx([5, -15, 2.5])


def test_a_case_without_a_result_has_none() -> None:
    results = tower_results()
    failed = replace(results.cases[0], status=Status.NOT_VERIFIED)
    record = results_json(replace(results, cases=(failed, results.cases[1])))
    assert [case["reactions"] for case in record["cases"]] == [None, None]


@pytest.mark.parametrize("deck", ["guided_blocks", "beam_on_three_supports"])
def test_the_sum_balances_the_loads_with_guides_and_supports_that_settle(deck: str) -> None:
    results = mbla.run(BENCHMARKS[deck].read_text(encoding="utf-8")).records
    for case, record in zip(results.cases, results_json(results)["cases"], strict=True):
        load = load_on_structure(results.model.of_case(case.load_case), case.load_case, record["load_factor"])
        total = [*record["reactions"]["total"]["force"], *record["reactions"]["total"]["moment"]]
        assert np.abs(np.array(total) + load).max() <= 1e-6 * np.abs(load).max()
