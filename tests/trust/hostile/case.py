"""A hostile file: how it is made, which command it is given to, and how that must end."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

REFUSED, NOT_READ = 3, 6
"""exit status of what is no deck, and of what cannot be read"""

Write = Callable[[Path], None]
"""writes into a folder what the case needs"""


@dataclass(frozen=True)
class Case:
    """A command on a hostile file.

    write     : makes the folder in which the command is called
    arguments : of the command line
    status    : exit status
    """

    name: str
    write: Write
    arguments: tuple[str, ...] = ("run", "deck.yaml")
    status: int = REFUSED


def deck(name: str, content: bytes | str, status: int = REFUSED, **files: bytes | str) -> Case:
    """A hostile deck; other files by name, with ``__`` for the dot."""
    contents = {"deck.yaml": content} | {key.replace("__", "."): text for key, text in files.items()}
    return Case(name, lambda folder: write_all(folder, contents), status=status)


def sweep(name: str, content: bytes | str, status: int = REFUSED, **files: bytes | str) -> Case:
    """A hostile sweep file; other files as for ``deck``."""
    contents = {"sweep.yaml": content} | {key.replace("__", "."): text for key, text in files.items()}
    return Case(name, lambda folder: write_all(folder, contents), ("sweep", "sweep.yaml"), status)


def write_all(folder: Path, contents: dict[str, bytes | str]) -> None:
    """Files by name."""
    for name, content in contents.items():
        (folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())
