from __future__ import annotations

import pytest

from mbla.deck.tree import plain_scalar


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("0", 0),
        ("-17", -17),
        ("+5", 5),
        ("017", 17),
        ("0o17", 15),
        ("0x1F", 31),
        ("1e3", 1000.0),
        ("1.e-3", 0.001),
        ("1.0E+3", 1000.0),
        (".5", 0.5),
        ("-.5e1", -5.0),
        ("9007199254740993", 9007199254740992.0),
        ("true", True),
        ("FALSE", False),
        ("null", None),
        ("~", None),
        ("", None),
    ],
)
def test_core_schema(text: str, value: object) -> None:
    result = plain_scalar(text)
    assert result == value
    assert type(result) is type(value)


@pytest.mark.parametrize(
    "text",
    [
        "no",
        "on",
        "y",
        "yes",
        "off",
        "2024-01-31",
        "12:30:45",
        "1_000",
        "1,5",
        "0b11",
        "-0x1F",
        "1e",
        "tRUE",
        "inf",
        "١٢",
    ],
)
def test_text_in_yaml_1_2(text: str) -> None:
    assert plain_scalar(text) == text


@pytest.mark.parametrize("text", [".inf", "-.INF", "+.Inf", ".nan", ".NaN"])
def test_not_finite(text: str) -> None:
    with pytest.raises(ValueError, match="finite"):
        plain_scalar(text)


@pytest.mark.parametrize("text", ["1e999", "-1e999", "9" * 399, "9" * 5000, "0x" + "F" * 380, "0o" + "7" * 5000])
def test_too_large(text: str) -> None:
    with pytest.raises(ValueError, match="too large"):
        plain_scalar(text)
