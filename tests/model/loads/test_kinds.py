"""Every kind of load has what a user needs: a type with its entry in the schema, a deck and a test of its forces."""

from __future__ import annotations

from pathlib import Path

import pytest

from mbla.deck.kinds.load_key import LOAD_KEYS, NAMED, live_only
from mbla.deck.schema import deck_schema
from mbla.deck.section import EXACTLY_ONE, Section
from mbla.deck.sections.loads import Load
from mbla.model.loads.load_kind import CaseKind, LoadKind
from tests.deck.keys_in_use import sections_of
from tests.decks.folder import PATHS, deck_of
from tests.model.tested_kinds import check_tested

KINDS = tuple(name for name in LOAD_KEYS if name != NAMED)


@pytest.fixture(scope="module")
def used() -> set[str]:
    sections = sections_of([deck_of(path).content for path in PATHS])
    return {each.kind for each in sections if isinstance(each, Load)}


@pytest.mark.parametrize("name", KINDS)
def test_every_kind_has_type_schema_deck_and_test(name: str, used: set[str]) -> None:
    kind, definitions = LOAD_KEYS[name], deck_schema()["$defs"]
    assert isinstance(kind, LoadKind | CaseKind)
    of_load = definitions["Load"]["properties"][name]
    assert of_load["description"] == kind.description
    if isinstance(kind.section, type) and issubclass(kind.section, Section):
        assert of_load["$ref"] == f"#/$defs/{kind.section.__name__}"
        assert set(kind.names) <= set(kind.section.model_fields)
    assert name in used, f"no deck has a load of kind {name}: write one under decks/"
    check_tested(Path(__file__).with_name(f"test_{name}.py"), name, [f"{name}: "])


def test_a_load_has_one_of_these_kinds() -> None:
    assert set(EXACTLY_ONE[Load]) == {*KINDS, NAMED}
    assert {name for name in KINDS if isinstance(LOAD_KEYS[name], CaseKind)} == set(live_only())


def test_a_load_tells_its_kind() -> None:
    load = Load.model_validate({"moment": (1.0, 2.0, 3.0), "on": "top"})
    assert (load.kind, load.facts, load.chosen) == ("moment", LOAD_KEYS["moment"], (1.0, 2.0, 3.0))
