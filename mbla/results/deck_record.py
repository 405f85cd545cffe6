"""A deck as results keep it, with everything that it is made of, and the way back from there to the deck."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from mbla.deck import Deck, read_deck
from mbla.deck.include import confined
from mbla.errors import FileError
from mbla.model.geometry.geometry import companions
from mbla.results.results import DeckRecord


def deck_record(deck: Deck) -> DeckRecord:
    """Texts, overrides and side files of a deck; FileError where a side file has gone since it was read."""
    return DeckRecord(
        name=deck.path.name,
        sources=tuple((source.name, source.text) for source in deck.sources),
        overrides=deck.overrides,
        sha256=deck.sha256,
        files=tuple(dict(_side_files(deck)).items()),
    )


def _side_files(deck: Deck) -> Iterator[tuple[str, bytes]]:
    """Name and content of each file that the deck names, and of those that belong to it."""
    for side in deck.side_files:
        file = deck.resolve_file(side.key, side.value)
        for each in (file, *companions(file)):
            beside = Path(os.path.relpath(each, file.parent)) if each != file else Path(Path(side.name).name)
            try:
                yield (Path(side.name).parent / beside).as_posix(), each.read_bytes()
            except OSError as error:
                raise FileError("file-unreadable", f"{each}: cannot be read: {error.strerror or error}") from error


def deck_of(record: DeckRecord, folder: Path, *, expected: bool) -> Deck:
    """The deck read again from its record, in an empty folder that holds nothing but what it is made of.

    expected : whether its expectations are read

    Raises
    ------
    DeckError
        it is not valid
    FileError
        it is not complete, or the folder cannot be written
    """
    texts = ((name, text.encode()) for name, text in record.sources)
    for name, content in (*texts, *record.files):
        path = confined(folder, name)
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        except (OSError, ValueError) as error:
            raise FileError("file-unreadable", f"{name}: cannot be put in place: {error}") from error
    return read_deck(folder / record.sources[0][0], record.overrides, expected=expected)
