from __future__ import annotations

from collections.abc import Iterator
from typing import Any, get_args, get_origin

from pydantic import BaseModel

from mbla.deck.content import DeckContent
from mbla.deck.fields import branches
from mbla.deck.references import SIDE_FILES, find, side_files

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


def test_of_a_value_below_the_deck() -> None:
    for path, name in side_files(DECK):
        for length in range(len(path) + 1):
            ((_, value),) = find_value(path[:length])
            assert (path, name) in set(side_files(value, path[:length]))
    assert list(side_files("a.obj", ("blocks", 0, "mesh", "units"))) == []
    assert list(side_files("a.obj", ("blocks", 0, "mesh", "file", "more"))) == []


def test_what_is_no_name_stands_for_no_file() -> None:
    assert list(side_files({"blocks": [{"mesh": {"file": 7}}], "contacts": {"table": ["c.csv"]}})) == []


def find_value(path: tuple[str | int, ...]) -> list[tuple[Any, Any]]:
    value: Any = DECK
    for key in path:
        value = value[key]
    return list(find(value, []))
