"""A deck made of another one, which can be read wherever it is written: the files that it names lie beside it."""

from __future__ import annotations

from collections.abc import Container, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass
from functools import reduce
from operator import getitem
from pathlib import Path
from typing import Any

from mbla.deck import Deck
from mbla.deck.content import DeckContent
from mbla.deck.text.writer import deck_text


@dataclass(frozen=True)
class MovableDeck:
    """What such decks are made of.

    stem  : with which the names of files begin
    data  : the deck as read, with inclusions and overrides in it, and files by their names beside it
    files : content of the meshes and tables that it names, by these names: ``STEM_NUMBER_NAME``
    """

    stem: str
    data: dict[str, Any]
    files: dict[str, bytes]


def movable_deck(deck: Deck, files: Sequence[tuple[str, bytes]], stem: str) -> MovableDeck:
    """A deck with the files that it names beside it.

    files : name from the folder of its main file, and content, of each
    """
    beside = {name: f"{stem}_{number}_{Path(name).name}" for number, (name, _) in enumerate(files, start=1)}
    data: Any = deepcopy(deck.data)
    for side in deck.side_files:
        reduce(getitem, side.key[:-1], data)[side.key[-1]] = beside[Path(side.name).as_posix()]
    return MovableDeck(stem, data, {beside[name]: content for name, content in files})


def sections_text(content: Mapping[str, Any], left_out: Container[str] = ()) -> str:
    """Text of the sections of a deck in their usual order, without inclusions, which are in it already."""
    kept = [key for key in DeckContent.model_fields if content.get(key) and key != "include" and key not in left_out]
    return deck_text({key: content[key] for key in kept})
