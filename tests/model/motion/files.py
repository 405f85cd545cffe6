"""Records for tests, written where they ask for them."""

from __future__ import annotations

from pathlib import Path


def written(folder: Path, text: str, name: str = "record.csv") -> Path:
    """A file with a text."""
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path
