from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mbla.sweeps.file import content
from mbla.sweeps.file.content import Parameter
from tests.sweeps.design.hand_made import column, design, drawn


def levels(parameter: dict[str, Any]) -> list[Any]:
    return column(design({"x": {"key": "a.x", **parameter}}), "x")


def test_every_way_of_the_sweep_file_is_registered() -> None:
    assert set(content.WAYS) == set(Parameter.model_fields) - {"key", "unit"}


def test_a_linear_range_is_as_a_person_would_write_it() -> None:
    found = levels({"linear": {"from": 0.1, "to": 0.2, "points": 11}})
    assert found == [0.1, 0.11, 0.12, 0.13, 0.14, 0.15, 0.16, 0.17, 0.18, 0.19, 0.2]


FINITE = st.floats(-1e9, 1e9).filter(lambda value: value == 0 or abs(value) > 1e-9)


@given(FINITE, FINITE, st.integers(2, 40))
def test_linear_ranges_have_exact_ends_and_equal_steps(start: float, end: float, points: int) -> None:
    if abs(end - start) <= 1e-9 * max(abs(start), abs(end)):
        return
    found = levels({"linear": {"from": start, "to": end, "points": points}})
    assert found[0] == start
    assert found[-1] == end
    # What is rounded away: 12 digits of the span, or 15 of the values where that is coarser.
    rounding = 1e-11 * abs(end - start) + 2e-14 * max(abs(start), abs(end))
    assert np.diff(found) == pytest.approx(np.full(points - 1, (end - start) / (points - 1)), abs=rounding)


@given(st.floats(1e-12, 1e12), st.floats(1.001, 1e6), st.integers(2, 40))
def test_logarithmic_ranges_have_exact_ends_and_equal_ratios(start: float, ratio: float, points: int) -> None:
    end = start * ratio
    found = levels({"log": {"from": start, "to": end, "points": points}})
    assert (found[0], found[-1]) == (start, end)
    assert np.diff(np.log(found)) == pytest.approx(np.full(points - 1, math.log(ratio) / (points - 1)), abs=2e-11)


def test_whole_numbers_are_each_of_them() -> None:
    found = design({"x": {"key": "a.x", "whole": {"from": -1, "to": 2}}})
    assert column(found, "x") == [-1, 0, 1, 2]
    assert found.columns[0].kind == "int"


@pytest.mark.parametrize(
    ("values", "kind", "shown"),
    [
        ([1, 2], "int", [1, 2]),
        ([1, 2.5], "float", [1.0, 2.5]),
        ([True, False], "bool", [True, False]),
        (["arch", "dome"], "text", ["arch", "dome"]),
        ([[1, 0.5], "20 mm", True, 3], "text", ["[1, 0.5]", "20 mm", "true", "3"]),
    ],
)
def test_the_kind_of_a_list_is_that_of_its_values(values: list[Any], kind: str, shown: list[Any]) -> None:
    found = design({"x": {"key": "a.x", "values": values}}, units={"x": "m"})
    assert column(found, "x") == shown
    assert [type(value) for value in column(found, "x")] == [type(value) for value in shown]
    assert [point.settings for point in found.points] == [{"a.x": value} for value in values]
    assert found.columns[0].kind == kind
    assert found.columns[0].unit == ("m" if kind in ("int", "float") else "")


def test_values_that_are_drawn_come_equally_often() -> None:
    found = column(drawn({"values": ["a", "b", "c"]}, points=300, kind="latin_hypercube"), "x")
    assert [found.count(value) for value in "abc"] == [100, 100, 100]
