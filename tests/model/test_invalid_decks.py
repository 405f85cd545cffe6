"""Every deck of tests/invalid_decks/model_*.yaml is read, and refused by what follows before any case is solved.

That is the model stage, or the search for contacts, with exactly the messages of the deck.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from mbla.deck import read_deck
from mbla.errors import DeckError
from mbla.model import build_model
from mbla.run import contacts_of

FOLDER = Path(__file__).parents[1] / "invalid_decks"
DECKS = sorted(FOLDER.glob("model_*.yaml"))
MARK = "# expect: "


def test_there_are_enough() -> None:
    assert len(DECKS) >= 20


@pytest.mark.parametrize("path", DECKS, ids=lambda path: path.stem)
def test_messages(path: Path) -> None:
    lines = path.read_text(encoding="utf-8").splitlines()
    expected = [line.removeprefix(MARK) for line in lines if line.startswith(MARK)]
    deck = read_deck(path)
    with pytest.raises(DeckError) as caught:
        contacts_of(deck, build_model(deck))
    assert [fault.line().removeprefix(f"{path}:") for fault in caught.value.faults] == expected
    assert expected, "a faulty deck says what is expected of it"
