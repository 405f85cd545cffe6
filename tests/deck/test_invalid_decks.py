"""Every deck of tests/invalid_decks/deck_*.yaml is refused with exactly the messages that its last comments expect."""

from __future__ import annotations

from pathlib import Path

import pytest

from mbla.deck import read_deck
from mbla.errors import DeckError

FOLDER = Path(__file__).parents[1] / "invalid_decks"
DECKS = sorted(FOLDER.glob("deck_*.yaml"))
MARK = "# expect: "


def test_there_are_enough() -> None:
    assert len(DECKS) >= 60


@pytest.mark.parametrize("path", DECKS, ids=lambda path: path.stem)
def test_messages(path: Path) -> None:
    lines = path.read_text(encoding="utf-8").splitlines()
    expected = [line.removeprefix(MARK) for line in lines if line.startswith(MARK)]
    with pytest.raises(DeckError) as caught:
        read_deck(path)
    assert [fault.line().removeprefix(f"{path}:") for fault in caught.value.faults] == expected
    assert expected, "a faulty deck says what is expected of it"
