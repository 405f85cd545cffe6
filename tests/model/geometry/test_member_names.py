from __future__ import annotations

import pytest

from mbla.model.geometry.geometry import LONGEST, member_name


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("stone_1.a-b", "stone_1.a-b"),
        (" Gewölbe  1 ", "Gewolbe_1"),
        (".x", "_.x"),
        ("-7", "_-7"),
        ("a.x", "a.x"),
        ("石", "_"),
        ("", ""),
        ("  ", ""),
    ],
)
def test_names_as_a_deck_can_write_them(text: str, name: str) -> None:
    assert member_name(text) == name


def test_long_names_are_cut_after_64_characters() -> None:
    assert LONGEST == 64
    assert member_name("a" * 64 + "b") == "a" * 64
    assert member_name("." + "a" * 64) == "_." + "a" * 62
