from __future__ import annotations

from pathlib import Path

import pytest

from mbla.deck import read_deck
from mbla.deck.references import find, groups
from tests.deck.decks import BLOCK, changed, faults, write

ARCH = "arch: {group: arch, material: stone, shape: semicircular, span: 4, thickness: 0.3, width: 1, voussoirs: 9%s}"
BOX = "box: {group: block, material: stone, min: [0, 0, 0], max: [1, 1, 1]}"


def test_item_without_a_group_makes_one_of_its_kind(tmp_path: Path) -> None:
    text = changed("group: block, ", "").replace("{ground: {z: 0}}", "{blocks: box}")
    assert read_deck(write(tmp_path, text)).content.supports[0].blocks == "box"


def test_springers_of_an_arch_are_a_group(tmp_path: Path) -> None:
    with_springers = BLOCK.replace(BOX, ARCH % ", springers: blocks").replace(
        "{ground: {z: 0}}", "{blocks: arch_springers}"
    )
    assert read_deck(write(tmp_path, with_springers)).content.supports[0].blocks == "arch_springers"
    without = with_springers.replace(", springers: blocks", "")
    assert faults(write(tmp_path, without)) == [
        "deck.yaml:13:14 supports[0].blocks = arch_springers: unknown group; known: arch"
    ]


@pytest.mark.parametrize("section", ["materials: 5", "materials: [stone]", "materials: {stone: 5}"])
def test_names_are_compared_even_where_sections_are_broken(tmp_path: Path, section: str) -> None:
    messages = faults(write(tmp_path, BLOCK.replace("materials:\n  stone: {density: 2000}", section)))
    assert any("must be a mapping" in message for message in messages)
    assert len([message for message in messages if "unknown material" in message]) == ("stone:" not in section)


def test_patterns() -> None:
    data = {"a": [{"b": 1}, {"b": 2}, 3], "c": {"d": {"e": 4}, "f": [5]}}
    assert list(find(data, ["a", "#", "b"])) == [(("a", 0, "b"), 1), (("a", 1, "b"), 2)]
    assert list(find(data, ["c", "*", "e"])) == [(("c", "d", "e"), 4)]
    assert list(find(data, ["c", "#"])) == []
    assert list(find(data, ["a", "*"])) == []


def test_groups_of_broken_items_do_no_harm() -> None:
    assert list(groups({"blocks": [{"box": 5}, 3, {"box": {"group": 7}}, {"bx": {}}, {"wall": {}}]})) == ["wall"]
    assert list(groups({"blocks": "none"})) == []
