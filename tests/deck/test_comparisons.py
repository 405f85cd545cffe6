from __future__ import annotations

import pytest

from mbla.deck.comparisons import read_comparison
from mbla.deck.expressions import ExpressionError, ParameterFaultError, Parameters


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("1 < 2", True),
        ("2 < 1", False),
        ("2 <= 2", True),
        ("2 > 2", False),
        ("3 >= 2", True),
        ("a == 2", True),
        ("1 < a < 3", True),
        ("1 < a < 2", False),
        ("3 < a < 4", False),
        ("max(a, b) <= 2*pi", True),
        (" = a < 3 ", True),
        ("a < 2.5 == 5./2", True),
        ("3*1.1 == 3.3", True),
        ("3*1.1 > 3.3", False),
        ("3.3 < 3*1.1", False),
        ("3.3 >= 3*1.1", True),
        ("1 < 1 + 1e-8", True),
        ("0 < 1e-300", True),
    ],
)
def test_comparisons(text: str, expected: bool) -> None:
    assert read_comparison(text).holds(Parameters({"a": 2, "b": "=2*a"}).value) is expected


def test_every_part_of_a_chain_has_a_value() -> None:
    """A fault in the last of a chain is told also where the first is not true."""
    with pytest.raises(ExpressionError, match="divides by zero"):
        read_comparison("2 < 1 < 1/0").holds(Parameters({}).value)


def test_names_of_a_comparison_are_in_their_order_without_functions() -> None:
    assert read_comparison("sqrt(z) + b*a < min(a, pi) < z").names == ("z", "b", "a", "pi")


def test_a_comparison_of_an_unknown_name() -> None:
    with pytest.raises(ExpressionError, match="unknown parameter thicknes; did you mean thickness"):
        read_comparison("thicknes < 1").holds(Parameters({"thickness": 1}).value)


def test_a_comparison_of_a_parameter_at_fault() -> None:
    with pytest.raises(ParameterFaultError):
        read_comparison("a < 1").holds(Parameters({"a": "=1/0"}).value)
