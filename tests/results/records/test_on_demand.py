"""A record whose values are found when they are asked for says what the whole record says."""

from __future__ import annotations

import pytest

from mbla.results.records.json_record import results_json
from mbla.results.records.mechanism_json import OnDemand
from tests.results.synthetic import tower_results


def test_each_value_is_worked_out_once_and_only_when_asked_for() -> None:
    asked: list[str] = []

    def make(name: str) -> int:
        asked.append(name)
        return len(name)

    record = OnDemand({"hinges": lambda: make("hinges"), "reach": lambda: make("reach")})
    assert list(record) == ["hinges", "reach"]
    assert "hinges" in record
    assert "cracks" not in record
    assert not asked
    assert (record["reach"], record["reach"]) == (5, 5)
    assert asked == ["reach"]
    with pytest.raises(KeyError):
        record["cracks"]


def test_the_mechanism_asked_for_key_by_key_is_that_of_the_whole_record() -> None:
    results = tower_results()
    whole, lazy = results_json(results), results_json(results, on_demand=True)
    mechanisms = 0
    for full, case in zip(whole.pop("cases"), lazy.pop("cases"), strict=True):
        expected, mechanism = full.pop("mechanism"), case.pop("mechanism")
        assert case == full
        assert mechanism == expected if expected is None else dict(reversed(list(mechanism.items()))) == expected
        assert expected is None or list(mechanism) == list(expected)
        mechanisms += expected is not None
    assert mechanisms
    assert lazy == whole
