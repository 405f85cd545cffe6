from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any, get_args, get_origin

import pytest
from pydantic import BaseModel

from mbla.deck import read_deck
from mbla.deck.content import DeckContent
from mbla.deck.fields import branches
from mbla.deck.references import SIDE_FILES, side_files
from mbla.deck.suggestions import did_you_mean, listed
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
    assert faults(write(tmp_path, without)) == ["deck.yaml:13:14 supports[0].blocks [unknown-name]"]


def test_the_wall_of_a_stair_is_a_group(tmp_path: Path) -> None:
    stair = (
        "spiral_stair: {group: stair, material: stone, treads: 4, inner_radius: 0.5, outer_radius: 1.5, rise: 0.2, "
        "angle: 30, overlap: 5, built_in: 0.2, wall: %s}"
    )
    text = BLOCK.replace(BOX, stair % "shelf").replace("{ground: {z: 0}}", "{blocks: stair_wall}")
    assert read_deck(write(tmp_path, text)).content.supports[0].blocks == "stair_wall"
    assert any("[unknown-name]" in fault for fault in faults(write(tmp_path, text.replace("shelf", "none"))))


@pytest.mark.parametrize("section", ["materials: 5", "materials: [stone]", "materials: {stone: 5}"])
def test_names_are_compared_even_where_sections_are_broken(tmp_path: Path, section: str) -> None:
    found = faults(write(tmp_path, BLOCK.replace("materials:\n  stone: {density: 2000}", section)))
    assert any("[wrong-type]" in fault for fault in found)
    assert len([fault for fault in found if "material [unknown-name]" in fault]) == ("stone:" not in section)


DECK = {
    "blocks": [{"mesh": {"file": "a.obj"}}, {"table": {"vertices": "v.csv", "faces": "f.csv"}}, {"box": {}}],
    "contacts": {"table": "c.csv"},
    "loads": {"crane": [{"table": "l.csv"}]},
    "load_cases": {"push": {"dead": [{"gravity": [0, 0, -1]}], "live": [{"table": "p.csv"}]}},
}


def file_fields(section: type[BaseModel], path: str) -> Iterator[str]:
    """Paths of the fields of text that stand for a file by their description."""
    for name, field in section.model_fields.items():
        here = f"{path}.{field.alias or name}".lstrip(".")
        words = field.description or ""
        for suffix, each in below(field.annotation, ""):
            if each is str and ("CSV file" in words or "relative to the deck" in words):
                yield here + suffix
            elif isinstance(each, type) and issubclass(each, BaseModel):
                yield from file_fields(each, here + suffix)


def below(annotation: Any, suffix: str) -> Iterator[tuple[str, Any]]:
    for each in branches(annotation):
        origin, arguments = get_origin(each), get_args(each)
        if origin is dict:
            yield from below(arguments[1], f"{suffix}.*")
        elif origin in (list, tuple):
            yield from below(arguments[0], f"{suffix}.#")
        else:
            yield suffix, each


def test_every_field_that_names_a_file_is_known() -> None:
    """A file that is not hashed would change answers under an unchanged key."""
    assert sorted(set(file_fields(DeckContent, ""))) == sorted(SIDE_FILES)


def test_of_a_whole_deck() -> None:
    assert dict(side_files(DECK)) == {
        ("blocks", 0, "mesh", "file"): "a.obj",
        ("blocks", 1, "table", "vertices"): "v.csv",
        ("blocks", 1, "table", "faces"): "f.csv",
        ("contacts", "table"): "c.csv",
        ("loads", "crane", 0, "table"): "l.csv",
        ("load_cases", "push", "live", 0, "table"): "p.csv",
    }


@pytest.mark.parametrize(
    ("word", "meant"),
    [("fricton", "friction"), ("Friction", "friction"), ("non-associative", "non_associative"), ("zzz", ""), ("", "")],
)
def test_did_you_mean(word: str, meant: str) -> None:
    assert did_you_mean(word, ["friction", "cohesion", "non_associative"]) == (
        f"; did you mean {meant}?" if meant else ""
    )


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
