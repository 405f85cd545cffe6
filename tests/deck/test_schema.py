from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from mbla.deck import read_deck
from mbla.deck.content import DeckContent
from mbla.deck.fields import allowed_keys, annotations_at, description, section_keys, takes_names
from mbla.deck.quantities import PositiveLength, PositiveNumber
from mbla.deck.reader import read_yaml
from mbla.deck.schema import (
    REPOSITORY,
    deck_schema,
    deck_schema_text,
    key_reference,
    main,
    with_key_reference,
    write_schema,
)
from mbla.deck.section import Section
from mbla.deck.sources import SourceText
from mbla.errors import DeckError
from tests.deck.decks import BLOCK, changed, write
from tests.deck.test_reading import COMPLETE, FRAGMENTS

INVALID = sorted((Path(__file__).parents[1] / "invalid_decks").glob("deck_*.yaml"))

# What a schema cannot see: text and syntax, other files, values of expressions, names, and sums over keys.
BEYOND = "# schema: accepts"
"""line of a faulty deck that the schema lets pass"""


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
    assert (REPOSITORY / "schemas" / "deck.schema.json").read_text(encoding="utf-8") == deck_schema_text()


def test_schema_is_a_schema() -> None:
    jsonschema.Draft202012Validator.check_schema(deck_schema())


def test_every_key_is_described() -> None:
    schema = deck_schema()
    for name, section in {"": schema, **schema["$defs"]}.items():
        for key, value in section["properties"].items():
            assert "description" in value or "$ref" in value, f"{name}.{key}"


def test_nothing_may_be_null() -> None:
    assert '"null"' not in deck_schema_text()
    assert ": null" not in deck_schema_text()


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


SEEN = [path for path in INVALID if BEYOND not in path.read_text(encoding="utf-8")]


@pytest.mark.parametrize("path", SEEN, ids=lambda path: path.stem)
def test_faulty_decks_fail_the_schema_too(path: Path) -> None:
    assert not schema_accepts(path.read_text(encoding="utf-8"))


def test_most_faulty_decks_are_within_sight() -> None:
    assert len(SEEN) >= 50


def test_sections_may_come_from_an_included_deck() -> None:
    assert schema_accepts("mbla: 1\ninclude: [more.yaml]\n")
    assert not schema_accepts("mbla: 1\n")


def test_write(tmp_path: Path) -> None:
    (tmp_path / "schemas").mkdir()
    assert write_schema(tmp_path) == [tmp_path / "schemas" / "deck.schema.json"]
    assert json.loads((tmp_path / "schemas" / "deck.schema.json").read_text(encoding="utf-8")) == deck_schema()
    page = tmp_path / "schemas" / "deck.md"
    page.write_text("a\n<!-- keys:begin -->\noutdated\n<!-- keys:end -->\nz\n", encoding="utf-8")
    assert write_schema(tmp_path)[1:] == [page]
    text = page.read_text(encoding="utf-8")
    assert text.startswith("a\n<!-- keys:begin -->\n\nUnits:")
    assert text.endswith("\n<!-- keys:end -->\nz\n")
    assert "outdated" not in text
    assert with_key_reference(text) == text


def test_the_key_reference_is_up_to_date() -> None:
    text = (REPOSITORY / "schemas" / "deck.md").read_text(encoding="utf-8")
    assert with_key_reference(text) == text
    assert key_reference().count("####") >= 20


def test_command_writes_when_told(monkeypatch: pytest.MonkeyPatch) -> None:
    written: list[str] = []
    monkeypatch.setattr("mbla.deck.schema.write_schema", lambda: written.append("schema and key reference"))
    main(["--write"])
    assert written == ["schema and key reference"]


def rows() -> dict[str, dict[str, list[str]]]:
    tables: dict[str, dict[str, list[str]]] = {}
    title = ""
    for line in key_reference().splitlines():
        if line.startswith("#### "):
            title = line.removeprefix("#### ").strip("`")
            tables[title] = {}
        elif line.startswith("| `"):
            key, *cells = [cell.strip() for cell in line.strip("|").split(" | ")]
            tables[title][key.strip("`")] = cells
    return tables


def sections(root: type[Section]) -> list[type[Section]]:
    return [root] + [below for each in root.__subclasses__() for below in sections(each)]


def test_every_key_of_every_section_has_a_row() -> None:
    found = sorted(tuple(keys) for keys in rows().values())
    used = [each for each in sections(Section) if each.__module__.startswith("mbla.deck.")]
    bases = ("Item", "Masonry", "VaultItem", "Section")
    expected = sorted(tuple(section_keys(each)) for each in used if each.__name__ not in bases)
    assert found == expected


def test_units_defaults_and_bounds() -> None:
    tables = rows()
    assert tables["materials.NAME"]["density"] == ["number [M/L^3], > 0", "–", "mass per volume"]
    assert tables["contacts"]["tolerance"][:2] == ["number, > 0, ≤ 0.1", "`0.001`"]
    assert tables["blocks[].wall"]["unit"][:2] == ["3 numbers [L], > 0", "required"]
    assert tables["blocks[].wall.openings[]"]["from"][0] == "2 numbers [L]"
    assert tables["blocks[].polyhedron"]["faces"][0] == "list of lists of whole numbers, 0 or more"
    assert tables["output"]["vtu"][:2] == ["`true`, `false`", "`true`"]
    assert tables["output"]["frames"][:2] == ["whole number, 2 to 1000", "`11`"]
    assert tables["blocks[].*.*.rotate"]["about"][:2] == ["3 numbers [L]", "`[0, 0, 0]`"]
    position = next(table for table in tables.values() if "voussoir" in table)
    assert position["voussoir"][0] == "whole number or 2 whole numbers"  # negative ones count from the last
    assert position["index"][0] == "whole number, 0 or more"
    assert tables["deck"]["parameters"][0] == "name: number"
    assert tables["supports[]"]["blocks"][0] == "name or mapping or list of names or mappings"


def test_every_row_has_a_meaning() -> None:
    assert all(cells[-1] for table in rows().values() for cells in table.values())


def test_words_about_a_kind_of_item_end_where_its_sentence_does() -> None:
    items = rows()["blocks[]"]
    assert (
        items["stack"][2] == "Equal cuboids one on the other along +z, the lowest with its least corner at the origin"
    )
    assert items["cross_vault"][2].endswith("the middle of the bay at the origin, springings at z = 0")


def test_keys_along_a_path() -> None:
    assert allowed_keys(DeckContent, ("units",)) == ["length", "force", "mass"]
    assert allowed_keys(DeckContent, ("blocks", 3, "wall", "openings", 0)) == ["from", "to", "lintel", "arch"]
    assert allowed_keys(DeckContent, ("supports", 0, "blocks", 2))[:4] == ["group", "box", "index", "member"]
    assert allowed_keys(DeckContent, ("blocks", 0, "box", "transform", "rotate")) == ["axis", "angle", "about"]
    assert allowed_keys(DeckContent, ("joints", "dry"))[0] == "friction"


def test_no_keys_where_names_are_free_or_nothing_is() -> None:
    assert allowed_keys(DeckContent, ("joints",)) == []
    assert allowed_keys(DeckContent, ("nothing", "here")) == []
    assert allowed_keys(DeckContent, ("title", "x")) == []


def test_mappings_of_names() -> None:
    names = [key for key in DeckContent.model_fields if takes_names(DeckContent, (key,))]
    assert names == ["parameters", "materials", "joints", "loads", "load_cases", "expected"]


def test_description() -> None:
    assert description(DeckContent, ("output", "frames")) == "frames of the animation of the mechanism"
    assert description(DeckContent, ("output", "nothing")) == ""


def test_annotations_with_units_and_bounds() -> None:
    assert annotations_at(DeckContent, ("blocks", 0, "mesh", "scale")) == [PositiveNumber]
    assert annotations_at(DeckContent, ("blocks", 0, "mesh", "extrude")) == [PositiveLength | None]
    assert annotations_at(DeckContent, ("blocks", 0, "mesh", "nothing")) == []
    assert annotations_at(DeckContent, ("title", 0)) == []
