from __future__ import annotations

import pytest

from mbla.deck.suggestions import did_you_mean, listed, unknown


@pytest.mark.parametrize(
    ("word", "meant"),
    [("fricton", "friction"), ("Friction", "friction"), ("non-associative", "non_associative"), ("zzz", ""), ("", "")],
)
def test_did_you_mean(word: str, meant: str) -> None:
    assert did_you_mean(word, ["friction", "cohesion", "non_associative"]) == (
        f"; did you mean {meant}?" if meant else ""
    )


def test_hostile_length() -> None:
    assert did_you_mean("x" * 100_000, ["friction"] * 100) == ""


def test_among_many_names() -> None:
    assert did_you_mean("block777", [f"other{i}" for i in range(5000)] + ["block77"]) == "; did you mean block77?"


def test_listed() -> None:
    assert [listed([]), listed(["a"]), listed(["a", "b"]), listed("abc", "and")] == [
        "none",
        "a",
        "a or b",
        "a, b and c",
    ]
    assert listed(f"n{i}" for i in range(25)).endswith("n19 and 5 more")


def test_unknown() -> None:
    assert unknown("key", "lenght", ["length"]) == "unknown key; did you mean length? allowed: length"
    assert unknown("key", "zzz", ["length"], "known") == "unknown key; known: length"
