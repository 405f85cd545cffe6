from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from mbla.deck import read_deck
from mbla.deck.content import DeckContent
from mbla.deck.fields import allowed_keys, annotations_at, takes_names
from mbla.deck.quantities import PositiveLength, PositiveNumber
from mbla.deck.schema import (
    deck_schema,
    generated_files,
    key_reference,
)
from mbla.deck.text.reader import read_yaml
from mbla.deck.text.sources import SourceText
from mbla.errors import DeckError
from tests.deck.decks import BLOCK, changed, write
from tests.deck.test_reading import COMPLETE, FRAGMENTS
from tests.faulty_decks import DECKS


@cache
def validator() -> Any:
    return jsonschema.Draft202012Validator(deck_schema())


def schema_accepts(text: str) -> bool:
    return bool(validator().is_valid(read_yaml(SourceText("deck", text), 0).data))


def models_accept(folder: Path, text: str) -> bool:
    try:
        read_deck(write(folder, text))
    except DeckError:
        return False
    return True


def test_file_is_up_to_date() -> None:
    for path, text in generated_files("deck", deck_schema(), key_reference()).items():
        assert path.read_text(encoding="utf-8") == text


def test_schema_is_a_schema() -> None:
    jsonschema.Draft202012Validator.check_schema(deck_schema())


def test_every_key_is_described() -> None:
    schema = deck_schema()
    for name, section in {"": schema, **schema["$defs"]}.items():
        for key, value in section["properties"].items():
            assert "description" in value or "$ref" in value, f"{name}.{key}"


GOOD = [
    BLOCK,
    COMPLETE,
    FRAGMENTS,
    changed("{density: 2000}", '{density: "2 t/m^3"}'),
    changed("min: [0, 0, 0]", 'min: ["=mu-1", "-1 cm", "-.5e1 m"]'),
    changed("{ground: {z: 0}}", "{blocks: [block, {group: block, index: '=0'}]}"),
    COMPLETE.replace("courses: 6", 'courses: "=n+1"'),
    COMPLETE.replace("courses: 6", "courses: 6.0"),
]


@pytest.mark.parametrize("text", GOOD)
def test_good_decks_pass_both(tmp_path: Path, text: str) -> None:
    assert models_accept(tmp_path, text)
    assert schema_accepts(text)


@pytest.mark.parametrize("path", DECKS, ids=lambda path: path.stem)
def test_of_faulty_decks_the_schema_sees_what_the_table_says(path: Path) -> None:
    """It cannot see values of expressions, names, sums over keys, other files, nor blocks."""
    assert schema_accepts(DECKS[path].text) == DECKS[path].schema_accepts


def test_sections_may_come_from_an_included_deck() -> None:
    assert schema_accepts("mbla: 1\ninclude: [more.yaml]\n")
    assert not schema_accepts("mbla: 1\n")


def test_the_key_reference_has_many_tables() -> None:
    assert key_reference().count("####") >= 20


def test_keys_along_a_path() -> None:
    assert allowed_keys(DeckContent, ("units",)) == ["length", "force", "mass"]
    assert allowed_keys(DeckContent, ("blocks", 3, "wall", "openings", 0)) == ["from", "to", "lintel", "arch"]
    assert allowed_keys(DeckContent, ("supports", 0, "blocks", 2))[:4] == ["group", "box", "index", "member"]
    assert allowed_keys(DeckContent, ("blocks", 0, "box", "transform", "rotate")) == ["axis", "angle", "about"]
    assert allowed_keys(DeckContent, ("joints", "dry"))[0] == "friction"


def test_mappings_of_names() -> None:
    names = [key for key in DeckContent.model_fields if takes_names(DeckContent, (key,))]
    assert names == [
        *("parameters", "materials", "joints", "groups", "fill", "vehicles", "loads", "load_cases", "expected")
    ]


def test_annotations_with_units_and_bounds() -> None:
    assert annotations_at(DeckContent, ("blocks", 0, "mesh", "scale")) == [PositiveNumber]
    assert annotations_at(DeckContent, ("blocks", 0, "mesh", "extrude")) == [PositiveLength | None]
    assert annotations_at(DeckContent, ("blocks", 0, "mesh", "nothing")) == []
    assert annotations_at(DeckContent, ("title", 0)) == []
