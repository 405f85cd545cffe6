"""The decks of tests/invalid_decks: what is wrong with each by its place and identifier, and the sentences of all.

The last comments of a deck say place and identifier of each fault. Its sentence stands in sentences.txt, which
``python -m tests.faulty_decks --update`` writes anew.
"""

from __future__ import annotations

import sys
from functools import cache
from pathlib import Path

from mbla.assembly import build_assembly
from mbla.deck import read_deck
from mbla.errors import DeckError, Fault
from mbla.model import build_model

FOLDER = Path(__file__).parent / "invalid_decks"
DECKS = sorted(FOLDER.glob("*.yaml"))
SENTENCES = FOLDER / "sentences.txt"
MARK = "# expect: "


def expected_of(path: Path) -> list[str]:
    """Place and identifier of each fault, ``16:42  [out-of-bounds]``."""
    lines = path.read_text(encoding="utf-8").splitlines()
    return [line.removeprefix(MARK) for line in lines if line.startswith(MARK)]


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


def place_and_kind(fault: Fault, path: Path) -> str:
    """A fault as the deck expects it."""
    return f"{fault.place}  [{fault.identifier}]".removeprefix(f"{path}:")


def sentences() -> str:
    """What is said of each deck."""
    text = []
    for path in DECKS:
        lines = [fault.line().removeprefix(f"{path}:") for fault in refusal_of(path)[1].faults]
        text.append("\n".join([path.stem, *(f"  {line}" for line in lines), ""]))
    return "\n".join(text)


if __name__ == "__main__" and sys.argv[1:] == ["--update"]:
    SENTENCES.write_text(sentences(), encoding="utf-8")
