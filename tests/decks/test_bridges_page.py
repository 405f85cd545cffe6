"""Every snippet of decks/bridges/README.md is a part of a deck that is built; its figures are those of the decks."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from mbla.deck import read_deck
from mbla.model import build_model
from tests.decks.folder import DECKS
from tests.decks.test_what_stands_for_what import sections

FOLDER = DECKS / "bridges"
PAGE = (FOLDER / "README.md").read_text(encoding="utf-8")
SNIPPETS = re.findall(r"```yaml\n(.*?)```", PAGE, re.DOTALL)


@pytest.mark.parametrize("snippet", SNIPPETS, ids=[str(number) for number in range(1, len(SNIPPETS) + 1)])
def test_the_lines_fit_into_a_deck(snippet: str, tmp_path: Path) -> None:
    shutil.copytree(FOLDER / "vehicles", tmp_path / "vehicles")
    base = FOLDER / ("flooded_spandrel.yaml" if "on: wall" in snippet else "partial_factors.yaml")
    parts = {**sections(base.read_text(encoding="utf-8")), **sections(snippet)}
    parts.pop("expected")
    (tmp_path / "deck.yaml").write_text("".join(parts.values()), encoding="utf-8")
    model = build_model(read_deck(tmp_path / "deck.yaml"))
    assert len(model.load_cases) >= 1
    assert [notice.message for notice in model.notices if notice.severity == "warning"] == []


def test_figures_are_those_of_the_decks() -> None:
    factors = read_deck(FOLDER / "partial_factors.yaml").content.expected
    wall = read_deck(FOLDER / "flooded_spandrel.yaml").content.expected
    for figure, shown in (
        (factors["characteristic"].load_factor, "1.044"),
        (factors["weight_favourable"].load_factor, "0.773"),
        (wall["drained"].load_factor, "2.23"),
        (wall["flooded"].load_factor, "1.54"),
    ):
        assert figure is not None
        assert f"{figure:.{len(shown.partition('.')[2])}f}" == shown
        assert f" {shown}" in PAGE
