"""The text of a deck that the program writes is read back to the same values."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from mbla.deck.deck import read_deck
from mbla.deck.text.reader import read_yaml
from mbla.deck.text.sources import SourceText
from mbla.deck.text.writer import WIDTH, deck_text
from tests.decks.folder import PATHS

ODD = {
    "texts": [
        "",
        "true",
        "null",
        "1e3",
        "017",
        "0x1F",
        "=2*t",
        "18 kN/m^3",
        " a ",
        'says "no": #1',
        "it's",
        "µ, \\ [x]",
    ],
    "1e5": {"on": True, "no": False, "-": "-", "~": "~", "a.b-c_d": "a/b"},
    "numbers": [0, -3, 1e-05, 1e16, 0.1 + 0.2, 123456789012, -2.5e-300],
    "empty": {"list": [], "mapping": {}},
    "long": [{"key": "x" * 50, "further": ["y" * 50, ["z" * 50]]}, ["w" * 90, "v" * 90]],
    "many": [{"group": "wall", "index": index} for index in range(100)],
}


def read(text: str) -> Any:
    document = read_yaml(SourceText("deck", text), 0)
    assert not document.faults
    return document.data


def test_odd_values() -> None:
    assert read(deck_text(ODD)) == ODD


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)
def test_every_deck(path: Path) -> None:
    data = read_deck(path).data
    text = deck_text(data)
    assert read(text) == data
    assert all(len(line) <= WIDTH or " " not in line.strip() or '"' in line for line in text.splitlines())
