from __future__ import annotations

from pathlib import Path

import pytest

from mbla.deck import Deck, read_deck
from mbla.deck.text.overrides import next_key
from mbla.errors import Message
from mbla.model.blocks.box import BoxItem
from tests.deck.decks import BLOCK, changed, faults, refusal, write


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return write(tmp_path, BLOCK)


def friction(deck: Deck) -> float | None:
    return deck.content.joints["dry"].friction


def test_parameter_is_set_before_expressions_are_evaluated(path: Path) -> None:
    assert friction(read_deck(path, ["parameters.mu=0.5"])) == 0.5


def test_last_of_two_stands(path: Path) -> None:
    assert friction(read_deck(path, ["parameters.mu=0.5", "parameters.mu=0.4"])) == 0.4


def test_value_may_be_an_expression_or_hold_a_unit(path: Path) -> None:
    assert friction(read_deck(path, ["joints.dry.friction==mu/2"])) == 0.3
    assert read_deck(path, ["materials.stone.density=2 t/m^3"]).content.materials["stone"].density == 2000.0


def test_item_of_a_list_by_its_number(path: Path) -> None:
    (item,) = read_deck(path, ["blocks.0.box.max.2=3"]).content.blocks
    assert isinstance(item.item, BoxItem)
    assert item.item.max == (1.0, 1.0, 3.0)


def test_lists_and_mappings(path: Path) -> None:
    content = read_deck(path, ["blocks.0.box.max=[1, 2, 3]", "joints.dry={friction: 0.7, cohesion: 5}"]).content
    box = content.blocks[0].item
    assert isinstance(box, BoxItem)
    assert box.max == (1.0, 2.0, 3.0)
    assert (content.joints["dry"].friction, content.joints["dry"].cohesion) == (0.7, 5.0)


def test_name_with_a_dot(tmp_path: Path) -> None:
    path = write(tmp_path, BLOCK.replace("stone", "stone.v2"))
    assert read_deck(path, ["materials.stone.v2.density=5"]).content.materials["stone.v2"].density == 5.0


def test_place_is_the_override(path: Path) -> None:
    deck = read_deck(path, ["title=New", "parameters.mu=0.5"])
    assert (
        str(deck.fault_at(("parameters", "mu"), Message("not-a-number", "no"))) == "--set:2:15 parameters.mu = 0.5: no"
    )


@pytest.mark.parametrize(
    ("override", "message"),
    [
        ("parameters.mu=x", "--set:1:15 parameters.mu = x: must be a number"),
        ("parameters.mo=0.5", "--set:1:1 parameters.mo = 0.5: unknown name mo in parameters; known: mu"),
        (
            "materials.ston.density=5",
            "--set:1:1 materials.ston.density = 5: unknown name ston in materials; did you mean stone? known: stone",
        ),
        ("blocks.1.box=3", "--set:1:1 blocks.1.box = 3: there is no item 1: 0 to 0 are allowed"),
        ("blocks.-1.box=3", "--set:1:1 blocks.-1.box = 3: -1 is not a number of an item: 0 to 0 are allowed"),
        ("blocks..box=3", "--set:1:1 blocks..box = 3: nothing is not a number of an item: 0 to 0 are allowed"),
        ("blocks.²=3", "--set:1:1 blocks.² = 3: ² is not a number of an item: 0 to 0 are allowed"),
        ("title.first=A", "--set:1:1 title.first = A: the deck has a single value there, with nothing below it"),
        ("title", "--set:1:1 title: must be key.path=value, on one line: there is no ="),
        ("=3", "--set:1:1 =3: must be key.path=value, on one line"),
        ("title=a\nb", "--set:1:1 title=a b: must be key.path=value, on one line"),
        ("title=", "--set:1:7 title: has no value: write one after the ="),
        ("title=~", "--set:1:7 title: has no value: write one after the ="),
        ("include=[more.yaml]", "--set:1:1 include: cannot be set: files are included before anything is set"),
        ("contacts={a: 1, a: 2}", "--set:1:17 contacts: is given twice, first in line 1"),
        ("parameters.mu=.nan", "--set:1:15 parameters.mu = .nan: must be a finite number"),
        ("parameters.mu=*a", "--set:1:15 parameters.mu: aliases (*a) are not allowed"),
        ("parameters.mu=[1", "--set:1:15 parameters.mu: not YAML: while parsing a flow sequence"),
        ("analysis.acuracy=draft", "--set:1:1 analysis.acuracy = draft: unknown key; did you mean accuracy?"),
        ("analisis.accuracy=draft", "--set:1:1 analisis: unknown key; did you mean analysis?"),
    ],
)
def test_refusals(path: Path, override: str, message: str) -> None:
    (found,) = refusal(path, override).faults
    assert str(found).startswith(message)


def test_faults_of_deck_and_overrides_together(tmp_path: Path) -> None:
    path = write(tmp_path, changed("density: 2000", "density: -1"))
    assert faults(path, "parameters.mo=1", "contacts.tolerance=2") == [
        "--set:1:1 parameters.mo [unknown-name]",
        "--set:2:20 contacts.tolerance [out-of-bounds]",
        "deck.yaml:6:20 materials.stone.density [out-of-bounds]",
    ]


def test_a_path_of_very_many_keys_is_refused_at_once() -> None:
    assert next_key({"a.b.c": 1, "a": 2}, ["a", "b", "c", "d"]) == ("a.b.c", ["d"])
    assert next_key({"a.b.c": 1, "a": 2}, ["a", "b", "d"]) == ("a", ["b", "d"])
    assert next_key({"a": 1}, ["a"] * 100_000)[0] == "a"  # in time that grows with the number, not with its square
