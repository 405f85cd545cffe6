"""Every snippet of decks/what_stands_for_what.md is a part of a deck that is read and built."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from mbla.deck import read_deck
from mbla.model import build_model

PAGE = (Path(__file__).parents[2] / "decks" / "what_stands_for_what.md").read_text(encoding="utf-8")
SNIPPETS = re.findall(r"```yaml\n(.*?)```", PAGE, re.DOTALL)
DECK = """
mbla: 1
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.6}}
blocks:
  - wall: {group: wall, material: stone, unit: [0.8, 0.4, 0.4], length: 4, courses: 5}
  - box: {group: footing, material: stone, min: [10, 0, 0], max: [11, 1, 0.5]}
  - box: {group: pier, material: stone, min: [10, 0, 0.5], max: [11, 1, 3]}
  - box: {group: beam, material: stone, min: [9, 0, 3], max: [12, 1, 3.4]}
contacts: {joint: dry}
supports: [{ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [0, 1, 0]}]}}
"""


def sections(text: str) -> dict[str, str]:
    """Text of each section of a deck by its key."""
    return {part.partition(":")[0]: part for part in re.findall(r"^\w+:.*\n(?:[ ].*\n)*", text, re.MULTILINE)}


@pytest.mark.parametrize("snippet", SNIPPETS, ids=[str(number) for number in range(1, len(SNIPPETS) + 1)])
def test_the_lines_fit_into_a_deck(snippet: str, tmp_path: Path) -> None:
    (tmp_path / "deck.yaml").write_text("".join({**sections(DECK), **sections(snippet)}.values()))
    model = build_model(read_deck(tmp_path / "deck.yaml"))
    assert len(model.load_cases) >= 1
    assert [notice.message for notice in model.notices if notice.severity == "warning"] == []


def test_there_are_as_many_as_the_page_has_answers() -> None:
    assert len(SNIPPETS) >= 15
