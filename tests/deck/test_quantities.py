from __future__ import annotations

from typing import Annotated, Any

import pytest
from pydantic import TypeAdapter, ValidationError

from mbla.deck.quantities import Count, Index, Integer, Quantity, Switch

CONTEXT = {"convert": lambda text, dimension: {"=big": 1e20, "=six": 6.0, "=almost": 2.9999999999999996}[text]}


def check(annotation: Any, value: object) -> Any:
    return TypeAdapter(annotation).validate_python(value, context=CONTEXT)


def accepts(annotation: Any, value: object) -> bool:
    try:
        check(annotation, value)
    except ValidationError:
        return False
    return True


@pytest.mark.parametrize(("value", "whole"), [(6, 6), (6.0, 6), ("=six", 6), ("=almost", 3)])
def test_whole_numbers(value: object, whole: int) -> None:
    result = check(Count, value)
    assert result == whole
    assert type(result) is int


@pytest.mark.parametrize("value", [0, 1_000_001, 2.5, True, None, [], float("nan"), float("inf"), 1e300, "=big"])
def test_not_a_count(value: object) -> None:
    assert not accepts(Count, value)


def test_index_from_zero() -> None:
    assert check(Index, 0) == 0
    assert not accepts(Index, -1)


@pytest.mark.parametrize(
    ("bounds", "good", "bad"),
    [
        (Quantity("number", gt=0), [1e-300, 5], [0, 0.0, -1]),
        (Quantity("number", ge=0), [0, 1], [-1e-300]),
        (Quantity("number", lt=90), [89.999], [90]),
        (Quantity("number", le=1), [1, "=six"][:1], [1.0000001, "=six"]),
        (Quantity("number"), [-1, 0, 1e300], [True, None, [1], {}, float("nan"), float("-inf")]),
    ],
)
def test_bounds_hold_for_numbers_and_expressions(bounds: Quantity, good: list[object], bad: list[object]) -> None:
    annotation = Annotated[float, bounds]
    assert all(accepts(annotation, value) for value in good)
    assert not any(accepts(annotation, value) for value in bad)


def test_bounds_of_whole_numbers() -> None:
    annotation = Annotated[int, Integer(ge=2, le=5)]
    assert [value for value in range(8) if accepts(annotation, value)] == [2, 3, 4, 5]
    assert not accepts(annotation, "=six")


def test_switch_takes_nothing_but_booleans() -> None:
    assert check(Switch, True) is True
    assert not any(accepts(Switch, value) for value in (1, 0, "true", "yes", None))
