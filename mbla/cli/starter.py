"""The decks that ``mbla new`` begins a structure with, one of each kind."""

from __future__ import annotations

import os
from pathlib import Path

from mbla.cli import starters
from mbla.errors import FileError, UsageError
from mbla.results.disk import file_errors, write_complete


def write_starter(name: str, *, kind: str, replace: bool) -> Path:
    """Write the starting deck of a kind under a name, with or without its ending; the path.

    Raises
    ------
    UsageError, FileError
        it is no name, or cannot be written to
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
    starter = (Path(starters.__file__).parent / f"{kind}.yaml").read_text(encoding="utf-8")
    text = starter.replace("NAME.yaml", path.name).replace("NAME.out", f"{path.stem}.out")
    text = text.replace("NAME_positions", f"{path.stem}_positions")
    return text.replace("schemas/deck.schema.json", _schema_address())


def _schema_address() -> str:
    """Where editors find the schema that came with the program: inside the installed package, or next to its source."""
    package = Path(__file__).resolve().parents[1]
    places = [folder / "schemas" / "deck.schema.json" for folder in (package, package.parent)]
    return next((place.as_uri() for place in places if place.is_file()), "schemas/deck.schema.json")
