"""Decks to begin with, which ``mbla new`` writes, one of each kind of structure; each is a file here."""

from __future__ import annotations

import os
from pathlib import Path

from mbla.errors import FileError, UsageError
from mbla.results.disk import file_errors, write_complete

KINDS = {
    "wall": "a dry-stone wall with a door, pushed in and out of its plane",
    "facade": "two storeys with a return wall, lintels, floor and roof, and what a code says of it",
    "arch": "a load at its quarter, an earthquake, the least and the greatest thrust",
    "bridge": "an arch with spandrels and fill under a travelling lorry",
    "vault": "a cross vault, shaken, and one of its springers spreading",
    "tower": "square, with openings, shaken along a side and the diagonal",
}
"""the first unless another is asked for, and what their decks are"""


def write_starter(name: str, *, kind: str, replace: bool) -> Path:
    """Write the starting deck of a kind under a name, with or without its ending; the path.

    Raises UsageError, FileError: it is no name, or cannot be written to.
    """
    path = Path(name if name.endswith((".yaml", ".yml")) else f"{name}.yaml")
    if path.stem.startswith("."):
        raise UsageError("command-line", f"new {name!r}: is no name of a deck")
    if not path.parent.is_dir():
        raise FileError("file-missing", f"{path}: there is no folder {path.parent}")
    if not replace and os.path.lexists(path):
        raise FileError("result-exists", f"{path}: exists already; --force replaces it")
    with file_errors(path):
        write_complete(path, starter_text(path, kind).encode("utf-8"))
    return path


def starter_text(path: Path, kind: str = "wall") -> str:
    """The starting deck of a kind as it stands at a path, with the address of its schema."""
    starter = Path(__file__).with_name(f"{kind}.yaml").read_text(encoding="utf-8")
    text = starter.replace("NAME.yaml", path.name).replace("NAME.out", f"{path.stem}.out")
    text = text.replace("NAME_positions", f"{path.stem}_positions")
    return text.replace("schemas/deck.schema.json", _schema_address())


def _schema_address() -> str:
    """Where editors find the schema that came with the program: inside the installed package, or next to its source."""
    package = Path(__file__).resolve().parents[2]
    places = [folder / "schemas" / "deck.schema.json" for folder in (package, package.parent)]
    return next((place.as_uri() for place in places if place.is_file()), "schemas/deck.schema.json")
