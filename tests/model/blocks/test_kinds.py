"""Every kind of items has what a user needs: a type with its entry in the schema, a deck and a test of its geometry."""

from __future__ import annotations

from pathlib import Path

import pytest

from mbla.deck.kinds.positions import COPY
from mbla.deck.schema import deck_schema
from mbla.deck.sections.blocks import BlockItem
from mbla.deck.sections.selectors import POSITIONS
from mbla.model.blocks import ITEM_KINDS
from mbla.model.blocks.item import AnyItem
from tests.decks.folder import PATHS, deck_of
from tests.model.tested_kinds import check_tested

KINDS = tuple(ITEM_KINDS)


@pytest.fixture(scope="module")
def used() -> set[str]:
    return {entry.kind for path in PATHS for entry in deck_of(path).content.blocks}


@pytest.mark.parametrize("name", KINDS)
def test_every_kind_has_type_schema_deck_and_test(name: str, used: set[str]) -> None:
    kind, definitions = ITEM_KINDS[name], deck_schema()["$defs"]
    assert issubclass(kind.section, AnyItem)
    assert (kind.section.__doc__ or "").strip()
    assert definitions["BlockItem"]["properties"][name] == {"$ref": f"#/$defs/{kind.section.__name__}"}
    assert set(definitions[kind.section.__name__]["properties"]) == set(kind.section.model_fields)
    assert name in used, f"no deck has a {name}: write one under decks/"
    uses = (f"mbla.model.blocks.{name} import", f'"{name}"')
    check_tested(Path(__file__).with_name(f"test_{name}.py"), name, uses)


@pytest.mark.parametrize("name", KINDS)
def test_facts_name_what_is_there(name: str) -> None:
    kind = ITEM_KINDS[name]
    fields = kind.section.model_fields
    assert {position.name for position in kind.positions} <= {*POSITIONS} - {COPY.name}
    assert {side.key for side in kind.groups} | {*kind.files} | {
        place.split(".")[0] for place in kind.materials
    } <= set(fields)
    assert bool(kind.files) == (kind.flat_face is not None)


def test_entries_tell_kind_and_item() -> None:
    entry = BlockItem.model_validate({"box": {"material": "stone", "min": (0, 0, 0), "max": (1, 1, 1)}})
    assert (entry.kind, entry.facts, entry.item) == ("box", ITEM_KINDS["box"], entry.chosen)
