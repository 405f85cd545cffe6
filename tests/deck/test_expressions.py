from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mbla.deck.expressions import (
    ExpressionError,
    ParameterFaultError,
    Parameters,
)
from mbla.sweeps.file.comparisons import read_comparison


def value(text: str, **parameters: object) -> float:
    return Parameters(parameters).evaluate(text)


VALUES: list[tuple[str, float]] = [
    ("=1", 1.0),
    ("= 2 + 3*4", 14.0),
    ("=-2**2", -4.0),
    ("=2**3**2", 512.0),
    ("=7 % 3", 1.0),
    ("=-(1+2)/4", -0.75),
    ("=sqrt(2)**2", 2.0),
    ("=sin(30)", 0.5),
    ("=atan2(1, 1)", 45.0),
    ("=tan(45)", 1.0),
    ("=2*pi", 2 * math.pi),
    ("=log(e)", 1.0),
    ("=log(8, 2)", 3.0),
    ("=exp(0)", 1.0),
    ("=min(3, 1, 2) + max(3, 1)", 4.0),
    ("=floor(-1.5)", -2.0),
    ("=ceil(1.2)", 2.0),
    ("=round(2.6)", 3.0),
    ("=abs(-n)", 5.0),
    ("=" + "9" * 299, 1e299),
    ("=acos(0.5) + asin(0.5) + atan(1) + cos(60)", 135.5),
]


@pytest.mark.parametrize(("text", "expected"), VALUES)
def test_values(text: str, expected: float) -> None:
    assert value(text, n=5) == pytest.approx(expected, rel=1e-14)


def test_parameters_refer_to_parameters() -> None:
    parameters = Parameters({"a": "=2*b", "b": "=c+1", "c": 3})
    assert parameters.evaluate("=a") == 8.0
    assert parameters.used == {"a", "b", "c"}
    assert parameters.failures() == []


def test_cycle_is_blamed_on_its_first_parameter() -> None:
    parameters = Parameters({"x": "=a", "a": "=b", "b": "=c", "c": "=a"})
    with pytest.raises(ParameterFaultError):
        parameters.evaluate("=x")
    assert parameters.failures() == [("a", "refers to itself: a -> b -> c -> a")]


def test_fault_of_a_parameter_is_its_own() -> None:
    parameters = Parameters({"a": "=1/0", "b": "=a"})
    with pytest.raises(ParameterFaultError):
        parameters.evaluate("=b")
    assert parameters.failures() == [("a", "divides by zero")]


def test_long_chain() -> None:
    chain: dict[str, object] = {f"p{i}": f"=p{i + 1}+1" for i in range(5000)} | {"p5000": 1}
    assert Parameters(chain).evaluate("=p0") == 5001.0


def test_shared_parameters_are_evaluated_once() -> None:
    doubling: dict[str, object] = {f"p{i}": f"=p{i + 1}+p{i + 1}" for i in range(60)} | {"p60": 1}
    assert Parameters(doubling).evaluate("=p0") == 2.0**60


def test_long_cycle_is_shortened() -> None:
    ((name, message),) = Parameters({f"p{i}": f"=p{(i + 1) % 500}" for i in range(500)}).failures()
    assert name == "p0"
    assert message == "refers to itself: p0 -> p1 -> p2 -> p3 -> p4 -> p5 -> p6 -> p7 -> ... -> p0"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("=", "without content"),
        ("=1/0", "divides by zero"),
        ("=0**-1", "divides by zero"),
        ("=5%0", "divides by zero"),
        ("=9**9**9**9", "too large"),
        ("=1e308*10", "too large"),
        ("=exp(1000)", "too large"),
        ("=sqrt(-1)", r"sqrt\(-1\) is not defined"),
        ("=log(0)", r"log\(0\) is not defined"),
        (
            "=tan(radians(20))",
            "radians is not needed: angles of sin, cos, tan, asin, acos, atan and atan2 are in degrees",
        ),
        ("=degrees(atan(1))", "degrees is not needed"),
        ("=cos(2*pi/n)", "cos takes degrees: write 180 for pi in its angle"),
        ("=acos(2)", r"acos\(2\) is not defined"),
        ("=(-8)**(1/3)", "root of a negative number"),
        ("=1e400", "too large"),
        ("=n", "unknown parameter n"),
        ("=sqrt", r"sqrt is a function: write sqrt\(...\)"),
        ("=sqr(4)", "unknown function sqr; did you mean sqrt"),
        ("=sqrt()", "sqrt takes 1 argument, has 0"),
        ("=atan2(1)", "atan2 takes 2 arguments, has 1"),
        ("=max(1)", "max takes 2 to 16 arguments, has 1"),
        ("=2^3", r"write \*\* for powers"),
        ("=2 3", "cannot be read"),
        ("=(1", "cannot be read"),
        ("=1 if 1 else 2", "something other"),
        ("=1 < 2", "something other"),
        ("=7 // 2", "something other"),
        ("=True", "something other"),
        ("=1j", "something other"),
        ("='a'*9", "something other"),
        ("=[1][0]", "something other"),
        ("=(1).real", "something other"),
        ("=lambda: 1", "something other"),
        ("=[x for x in (1,)]", "something other"),
        ("=f'{1}'", "something other"),
        ("=(x:=1)", "something other"),
        ("=abs(x=1)", "something other"),
        ("=max(*(1, 2))", "something other"),
        ("=sqrt(2)(3)", "something other"),
        ("=__import__('os').system('true')", "something other"),
        ("=import os", "cannot be read"),
        ("=" + "(" * 250 + "1" + ")" * 40, "cannot be read"),
        ("=" + "-" * 250 + "1", "nested"),
        ("=" + "1+" * 149 + "1", "nested"),
        ("=" + "1" * 301, "more than 300 characters"),
    ],
)
def test_refusals(text: str, message: str) -> None:
    with pytest.raises(ExpressionError, match=message):
        value(text)


def test_python_remarks_on_style_are_no_warnings() -> None:
    with pytest.raises(ExpressionError):
        value("=1if 2else 3")


@given(st.text("0123456789.+-*/%()e pisqrtmaxnl,_'\"[]{}:=<>!~@\\", max_size=60))
def test_any_text_gives_a_finite_number_or_an_expression_error(text: str) -> None:
    try:
        result = value("=" + text, n=2)
    except ExpressionError:
        return
    assert isinstance(result, float)
    assert math.isfinite(result)


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
