"""Keys of the deck that name other files: meshes and tables."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from mbla.deck.references import LOADS, find
from mbla.deck.tree import KeyPath

SIDE_FILES = (
    "blocks.#.mesh.file",
    "blocks.#.table.vertices",
    "blocks.#.table.faces",
    "contacts.table",
    *(f"{loads}.#.table" for loads in LOADS),
)
"""Key paths, in which ``#`` stands for every item and ``*`` for every key."""


def side_files(value: Any, at: KeyPath = ()) -> Iterator[tuple[KeyPath, str]]:
    """Key paths and names of the files that a value of the deck names; ``at`` is where it stands, () the whole deck."""
    for pattern in SIDE_FILES:
        words = pattern.split(".")
        if len(words) >= len(at) and all(_fits(word, key) for word, key in zip(words, at, strict=False)):
            for path, name in find(value, words[len(at) :], at):
                if isinstance(name, str):
                    yield path, name


def _fits(word: str, key: str | int) -> bool:
    return isinstance(key, int) if word == "#" else isinstance(key, str) and word in ("*", key)
