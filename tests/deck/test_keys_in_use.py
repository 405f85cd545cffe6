"""Every kind of thing that a deck may have, and every key but those listed here, appears in a deck under decks/."""

from __future__ import annotations

from pathlib import Path

import pytest

from mbla.deck.content import DeckContent
from mbla.deck.section import EXACTLY_ONE, Section
from mbla.deck.sections.blocks import BlockItem
from mbla.deck.sections.load_cases import ASKED, LoadCaseSection
from mbla.deck.sections.loads import Load
from mbla.deck.sections.materials import BUILT_IN
from mbla.deck.sections.placement import TransformStep
from mbla.deck.sections.supports import Support
from mbla.model.blocks.mesh import MeshItem
from mbla.model.geometry.readers import READERS
from tests.deck.keys_in_use import Key, all_keys, keys_in_use, sections_of
from tests.decks.folder import PATHS, deck_of

UNUSED: dict[str, str] = {
    "AnalysisSection": "gap max_iterations reductions residual search standing time_limit tolerance",
    "Fill": "dilatancy",
    "ForceHistorySection": "at direction file on unit",
    "MeshItem": "weld",
    "MotionSection": "corner",
    "OutputSection": "plots positions",
    "OverTime": "interval start",
    "PushoverSection": "position",
    "PublishedScheme": "averaging max_programs",
    "RecordSection": "every",
    "SelectorTerm": "cell",
    "SoilItem": "dilatancy",
    "StopSection": "collapse displacement",
    "TargetSection": "peak",
    "TimeHistorySection": "check contact_damping damping forces rigid",
    "Travel": "contact",
}
"""Type -> keys that no deck gives. A new key belongs into a deck; one of these that a deck takes up leaves the list."""


@pytest.fixture(scope="module")
def contents() -> list[DeckContent]:
    return [deck_of(path).content for path in PATHS]


def test_keys_that_no_deck_gives_are_listed(contents: list[DeckContent]) -> None:
    listed: set[Key] = {(section, name) for section, names in UNUSED.items() for name in names.split()}
    assert listed <= all_keys()
    assert all_keys() - keys_in_use(contents) == listed


@pytest.mark.parametrize("section", [BlockItem, Load, LoadCaseSection, TransformStep])
def test_every_kind_is_in_a_deck(contents: list[DeckContent], section: type[Section]) -> None:
    used = {name for each in sections_of(contents) if isinstance(each, section) for name in each.model_fields_set}
    assert set(EXACTLY_ONE.get(section, ASKED)) - set(UNUSED.get(section.__name__, "").split()) <= used


def test_every_kind_of_support_is_in_a_deck(contents: list[DeckContent]) -> None:
    supports = [each for each in sections_of(contents) if isinstance(each, Support)]
    assert any(each.model_fields_set == {"blocks"} for each in supports)  # blocks that do not move at all
    used = {name for each in supports for name in each.model_fields_set}
    assert used == set(Support.model_fields)


def test_every_built_in_joint_law_is_in_a_deck(contents: list[DeckContent]) -> None:
    used = {getattr(each, "joint", None) for each in sections_of(contents)}
    assert set(BUILT_IN) <= used


def test_every_kind_of_geometry_file_is_in_a_deck(contents: list[DeckContent]) -> None:
    meshes = [each for each in sections_of(contents) if isinstance(each, MeshItem)]
    used = {Path(each.file).suffix.lower() for each in meshes}
    assert set(READERS) == used
