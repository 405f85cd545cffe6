"""The deck as the later stages get it: checked content, and the place of every value for their own messages."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from mbla.deck.types import AnalysisSection, ContactsSection, DeckContent
from mbla.deck.units import Units
from mbla.errors import Fault, Notice

KeyPath = tuple[str | int, ...]


@dataclass(frozen=True)
class Source:
    """One file that the deck is made of, as read."""

    path: Path
    text: str


@dataclass(frozen=True)
class Deck:
    """A checked deck.

    folder  : folder of the main file; files that the deck names are relative to it and confined to it
    sources : the main file first, then the included ones
    sha256  : of the effective deck (sources, side files excluded, and overrides), 64 hex digits
    """

    path: Path
    sources: tuple[Source, ...]
    overrides: tuple[str, ...]
    sha256: str
    content: DeckContent
    units: Units
    notices: tuple[Notice, ...]
    fault_at: Callable[[KeyPath, str], Fault]
    """Fault for a key path such as ("blocks", 3, "wall", "length") with a message; finds place and value itself."""
    resolve_file: Callable[[KeyPath, str], Path]
    """Path of a file named by the value at a key path; DeckError if missing, not a regular file, or outside the folder."""

    @property
    def folder(self) -> Path:
        return self.path.parent

    @property
    def analysis(self) -> AnalysisSection:
        return self.content.analysis

    @property
    def contacts(self) -> ContactsSection:
        return self.content.contacts
