"""The deck as the later stages get it: checked content, and the place of every value for their own messages."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from mbla.deck.content import DeckContent
from mbla.deck.sections.analysis import AnalysisSection
from mbla.deck.sections.contacts import ContactsSection
from mbla.deck.tree import KeyPath
from mbla.deck.units import Units
from mbla.errors import Fault, Message, Notice


@dataclass(frozen=True)
class Source:
    """One file that the deck is made of, as read; ``name`` is its path from the folder of the main file, with ``/``."""

    path: Path
    text: str
    name: str


@dataclass(frozen=True)
class SideFile:
    """A file that the deck names, a mesh or a table: key path and value that name it, ``name`` as of ``Source``."""

    key: KeyPath
    value: str
    name: str


@dataclass(frozen=True)
class Deck:
    """A checked deck.

    sources : the main file first, then the included ones
    side_files : in the order of the deck
    sha256  : of the texts of all sources and overrides, 64 hex digits; neither file names nor side files count
    """

    path: Path
    sources: tuple[Source, ...]
    side_files: tuple[SideFile, ...]
    overrides: tuple[str, ...]
    sha256: str
    content: DeckContent
    units: Units
    notices: tuple[Notice, ...]
    fault_at: Callable[[KeyPath, Message], Fault]
    """Fault for a key path such as ("blocks", 3, "wall", "length") with a message; finds place and value itself."""
    resolve_file: Callable[[KeyPath, str], Path]
    """Path of a file named by the value at a key path; relative to the file that names it and confined to its folder
    tree. DeckError if missing, not a regular file, or outside."""

    @property
    def folder(self) -> Path:
        """Folder of the main file."""
        return self.path.parent

    @property
    def analysis(self) -> AnalysisSection:
        """How the load factor is computed."""
        return self.content.analysis

    @property
    def contacts(self) -> ContactsSection:
        """How contacts are found."""
        return self.content.contacts
