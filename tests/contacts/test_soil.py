"""Soil of cells that ends a small way beside what it should touch."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.model.soil.decks import GROUND, WALL, deck
from tests.model.soil.test_cells import built

SOIL = (
    "soil: {{group: clay, material: earth, outline: [{outline}], width: 1, cells: {{size: 0.3}}, friction_angle: 30}}"
)


def said(folder: Path, outline: str, *blocks: str, supports: str = GROUND) -> list[str]:
    _, contacts = built(deck(folder, *blocks, SOIL.format(outline=outline), supports=supports))
    return [notice.message for notice in contacts.report.notices if notice.identifier == "soil-beside"]


def test_a_gap_to_a_wall(tmp_path: Path) -> None:
    (words,) = said(tmp_path, "[0.02, 0], [1.6, 0], [1.6, 1], [0.02, 1]", WALL)
    assert words.startswith("soil clay ends up to 0.02 m beside wall[0], less than half a cell: they do not touch")


def test_a_gap_to_ground(tmp_path: Path) -> None:
    (words,) = said(tmp_path, "[0, 0.05], [1.6, 0.05], [1.6, 1], [0, 1]", WALL)
    assert words.startswith("soil clay ends up to 0.05 m beside ground z = 0")


def test_a_gap_to_other_soil(tmp_path: Path) -> None:
    other = SOIL.replace("clay", "sand").format(outline="[1.61, 0], [2, 0], [2, 1], [1.61, 1]")
    (first, second) = said(tmp_path, "[0, 0], [1.6, 0], [1.6, 1], [0, 1]", other)
    assert "soil clay ends up to 0.01 m beside soil sand" in second
    assert "soil sand ends up to 0.01 m beside soil clay" in first


@pytest.mark.parametrize(
    "outline",
    [
        "[0, 0], [1.6, 0], [1.6, 1], [0, 1]",  # touches
        "[0.5, 0], [1.6, 0], [1.6, 1], [0.5, 1]",  # well away
        "[0, 0], [1.6, 0], [1.6, 1.6], [0, 0.4]",  # rises from the wall, which is beside its top
        "[0, 0], [1.6, 0], [1.6, 1], [0.15, 1], [0, 0.2]",  # leans away from it
    ],
)
def test_no_gap(outline: str, tmp_path: Path) -> None:
    assert said(tmp_path, outline, WALL) == []


def test_parts_that_nothing_holds(tmp_path: Path) -> None:
    """Cells are told as soil."""
    high = WALL.replace("[-0.5, 0, 0]", "[-0.5, 0, 5]").replace("[0, 1, 1]", "[0, 1, 6]")
    foot = WALL.replace("group: wall", "group: foot")
    read = deck(tmp_path, foot, high, SOIL.format(outline="[0, 5], [1, 5], [0, 6]"), supports=GROUND)
    model, contacts = built(read)
    (words,) = [each.message for each in contacts.report.notices if each.identifier == "unsupported-parts"]
    cells = len(model.soils[0].triangles)
    assert f"the largest of 1 block and {cells} cells of soil: soil clay and wall[0]" in words
