"""The decks of tests/invalid_decks: what is wrong with each by its place and identifier, and the sentences of all.

The table says place and identifier of each fault. Its sentence stands in sentences.txt, which
``python -m tests.faulty_decks --update`` writes anew.
"""

from __future__ import annotations

import sys
from functools import cache
from pathlib import Path

from mbla.assembly import build_assembly
from mbla.deck import read_deck
from mbla.errors import DeckError
from mbla.model import build_model
from tests.faulty_files import told_of, write_faulty_files

SENTENCES = Path(__file__).parent / "invalid_decks" / "sentences.txt"
FOLDER, DECKS = write_faulty_files(SENTENCES.parent)


@cache
def refusal_of(path: Path) -> tuple[str, DeckError]:
    """The stage that refuses a deck, ``deck`` or ``model``, which the name of the file begins with, and its error."""
    stage = "deck"
    try:
        deck = read_deck(path)
        stage = "model"
        build_assembly(deck, build_model(deck))
    except DeckError as error:
        return stage, error
    raise AssertionError(f"{path.name} is not refused")


def sentences() -> str:
    """What is said of each deck."""
    return "\n".join(told_of(path, refusal_of(path)[1].faults) for path in DECKS)


if __name__ == "__main__" and sys.argv[1:] == ["--update"]:
    SENTENCES.write_text(sentences(), encoding="utf-8")
