"""Openings that nothing spans are named where stones above them rest on nothing, and only there."""

from __future__ import annotations

from pathlib import Path

import pytest

from mbla.deck import read_deck
from mbla.model import build_model

DECK = """
mbla: 1
materials: {{stone: {{density: 2000}}}}
joints: {{dry: {{friction: 0.6}}}}
blocks:
  - {item}
contacts: {{joint: dry}}
supports: [{{ground: {{z: 0}}}}]
load_cases: {{push: {{live: [{{acceleration: [0, 1, 0]}}]}}}}
"""
WALL = "wall: {{group: front, material: stone, unit: [0.8, 0.6, 0.4], length: 4, courses: 10, openings: [{}]}}"
PLAN = (
    "walls: {{material: stone, unit: [0.8, 0.4, 0.4], courses: 10, plan: [[0, 0], [6.4, 0], [6.4, 6.4]], "
    "openings: [{}]}}"
)


def remarks(folder: Path, item: str, openings: str) -> list[str]:
    """Remarks on openings of a wall that nothing spans."""
    (folder / "wall.yaml").write_text(DECK.format(item=item.format(openings)))
    notices = build_model(read_deck(folder / "wall.yaml")).notices
    return [notice.message for notice in notices if notice.identifier == "opening-not-spanned"]


@pytest.mark.parametrize(
    ("openings", "stones"),
    [
        ("{from: [0.8, 0], to: [3.2, 2.0]}", "2 stones of course 5"),
        ("{from: [0.8, 0.4], to: [3.2, 1.6]}", "3 stones of course 4"),
        ("{from: [1.1, 0], to: [2.9, 2.0]}", "2 stones of course 5"),
    ],
)
def test_named_where_stones_would_fall(openings: str, stones: str, tmp_path: Path) -> None:
    (remark,) = remarks(tmp_path, WALL, openings)
    assert remark.startswith("openings[0] of front has neither lintel nor arch, and nothing is under ")
    assert stones in remark


@pytest.mark.parametrize(
    "openings",
    [
        "{from: [0.8, 0], to: [3.2, 2.0], lintel: {bearing: 0.4}}",
        "{from: [0.8, 0], to: [3.2, 2.0], arch: {voussoirs: 7}}",
        "{from: [1.6, 0], to: [2.4, 2.0]}",  # half of each stone above rests
        "{from: [1.7, 0], to: [2.3, 2.4]}",  # one stone spans it
        "{from: [0.8, 3.2], to: [3.2, 4.0]}",  # up to the top of the wall
    ],
)
def test_silent_where_stones_rest(openings: str, tmp_path: Path) -> None:
    assert remarks(tmp_path, WALL, openings) == []


def test_of_a_plan_the_wall_is_named(tmp_path: Path) -> None:
    (remark,) = remarks(tmp_path, PLAN, "{segment: 1, from: [1.6, 0], to: [4.0, 2.0]}")
    assert remark.startswith("openings[0] of walls, segment 1 has neither")
