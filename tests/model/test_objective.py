"""What of supports and ties counts to a force through a cut, and what is said of it."""

from __future__ import annotations

from pathlib import Path

import pytest

from mbla.deck import read_deck
from mbla.errors import DeckError
from mbla.model import Model, build_model
from tests.asked import settlement_of

DECK = """mbla: 1
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.6}}
blocks:
  - box: {group: one, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
  - box: {group: two, material: stone, min: [1, 0, 0], max: [2, 1, 1]}
contacts: {joint: dry}
"""


def asked(folder: Path, force: str, guide: str = "fixed: [x, rz]") -> Model:
    """Two cubes of which the first is guided, tied to each other and the second to the ground twice."""
    path = folder / "deck.yaml"
    path.write_text(f"""{DECK}
supports: [{{ground: {{z: 0}}}}, {{blocks: one, {guide}}}]
ties:
  - {{through: [[0, 0.5, 1], [2, 0.5, 1]], on: [one, two], capacity: 1}}
  - through: [[2, 0.5, 1], [3, 0.5, 1]]
    on: [two, ground]
    capacity: 1
    repeat: {{count: 2, translate: [0, 0.2, 0]}}
load_cases: {{f: {{objective: {{force: {{{force}}}}}}}}}
""")
    return build_model(read_deck(path))


@pytest.mark.parametrize(
    ("guide", "direction"),
    [
        ("fixed: [x, rz]", "[1, 0, 1e-3]"),
        ("slide: [1, 0, 1]", "[1, 0, 0]"),
        ("turn: {axis: [0, 1, 0], about: [0, 0, 0.5]}", "[0, 0, 1]"),
    ],
)
def test_a_guide_that_takes_part_of_the_force_of_supports_is_refused(
    tmp_path: Path, guide: str, direction: str
) -> None:
    with pytest.raises(DeckError, match=r"a guide holds one\[0\] that way"):
        asked(tmp_path, f"on: one, direction: {direction}", guide)


@pytest.mark.parametrize(
    ("force", "guide"),
    [
        ("on: one, direction: [0, 3, 4]", "fixed: [x, rz]"),
        ("on: one, direction: [-1, 0, -1]", "slide: [1, 0, 1]"),
        ("on: two, direction: [1, 0, 0]", "fixed: [x, rz]"),
        ("from: two, direction: [1, 0, 0]", "fixed: [x, rz]"),
    ],
)
def test_guides_that_take_nothing_of_it_are_not(tmp_path: Path, force: str, guide: str) -> None:
    assert len(asked(tmp_path, force, guide).load_cases) == 2


@pytest.mark.parametrize(
    ("sides", "words"),
    [
        ("on: two", "of the supports on 1 block (without 2 ties)"),
        ("from: one, on: two", "of 1 block on 1 block (without 1 tie)"),
        ("from: two", "of 1 block on all other blocks (without 1 tie)"),
        ("on: one", "of the supports on 1 block"),
    ],
)
def test_ties_across_a_cut_are_named_for_they_do_not_count(tmp_path: Path, sides: str, words: str) -> None:
    settlement = settlement_of(asked(tmp_path, f"{sides}, direction: [0, 0, 1]").load_cases[0])
    assert settlement.words == f"force {words} along (0, 0, 1)"
