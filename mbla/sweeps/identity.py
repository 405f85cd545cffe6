"""Which deck and which mbla this is: hashes and versions, by which points of one sweep belong together."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from mbla import __version__
from mbla.deck.deck import Deck, check_regular, read_deck
from mbla.deck.parameter_keys import path_of_key
from mbla.deck.references import side_files
from mbla.deck.text.include import confined, read_files
from mbla.deck.text.overrides import RefusedError, apply_override
from mbla.deck.text.tree import Tree, key_text
from mbla.errors import DeckError, FileError, KeyPath

WITHOUT_EFFECT = ("title", "output", "expected", "include")
"""keys that do not change what a deck gives; what `include` names is merged in"""


def effective_tree(path: Path, overrides: Sequence[str]) -> Tree:
    """A deck as read, with what it includes and with overrides in it, not evaluated.

    Raises DeckError where the text or an override is at fault; what only checks find is left to ``read_deck``.
    """
    tree, reading = read_files(path)
    for number, text in enumerate(overrides, start=1):
        reading.faults += apply_override(tree, text, number)
    if reading.faults:
        raise DeckError(reading.faults)
    return tree


def fingerprint_of(path: Path, overrides: Sequence[str]) -> str:
    """Fingerprint of a deck file with its overrides, as workers compare it; errors as of ``read_deck``."""
    return deck_fingerprint(read_deck(path, overrides), effective_tree(path, overrides))


def deck_fingerprint(deck: Deck, tree: Tree) -> str:
    """Hash of the content of a deck and of the files that it names, 64 hex digits.

    Comments, the order of keys, titles, expectations and what is written do not count; names of files do, as the
    ending says how they are read.

    Raises DeckError where a file is missing or outside the deck's folder.
    """
    content = {key: value for key, value in tree.data.items() if key not in WITHOUT_EFFECT}
    return _hash([canonical(content), *file_hashes(side_files(content), deck.resolve_file)])


def file_hashes(named: Iterable[tuple[KeyPath, str]], resolve_file: Callable[[KeyPath, str], Path]) -> list[str]:
    """Place and hash of each file, in the order of places."""
    return sorted(f"{key_text(path)} {_file_hash(resolve_file(path, name))}" for path, name in named)


def canonical(value: Any) -> str:
    """JSON with keys in order; floats so that no two of them are written alike."""
    return json.dumps(value, sort_keys=True, separators=(",", ":"), allow_nan=False)


def key_hash(fingerprint: str, settings: Any, files: Sequence[str]) -> str:
    """Hash of an effective deck by its base, the values set in it, and the hashes of files that these name."""
    return _hash([fingerprint, canonical(settings), *files])


@dataclass(frozen=True)
class PointKeys:
    """Keys of points: hash of the base deck, of the values set in it, and of the files that these name.

    fingerprint : of the base deck
    deck        : the base deck, in whose folder the files are
    """

    fingerprint: str
    deck: Deck
    _files: dict[tuple[KeyPath, str], str] = field(default_factory=dict, repr=False, compare=False)

    def of(self, settings: Mapping[str, Any]) -> str:
        """Key of a point, 64 hex digits."""
        texts = ((key, value) for key, value in settings.items() if isinstance(value, str | list | dict))
        named = [each for key, value in texts for each in side_files(value, path_in(self.deck, key))]
        return key_hash(self.fingerprint, settings, sorted(map(self._line, named)))

    def _line(self, named: tuple[KeyPath, str]) -> str:
        """Place and hash of a file, read once; one that is missing is the fault of its points."""
        if named not in self._files:
            try:
                self._files[named] = file_hashes([named], self._side_file)[0]
            except FileError:
                self._files[named] = f"{key_text(named[0])} cannot be read"
        return self._files[named]

    def _side_file(self, path: KeyPath, name: str) -> Path:
        """A file that a point names: relative to the deck, as what ``--set`` sets; raises FileError for none."""
        found = confined(self.deck.path.resolve().parent, name)
        check_regular(found)
        return found


def path_in(deck: Deck, key: str) -> KeyPath:
    """Path of the value that a key path names in a deck, or would have in it."""
    try:
        return path_of_key(deck.data, key)
    except RefusedError:
        return tuple(int(word) if word.isdecimal() else word for word in key.strip().split("."))


def _hash(lines: Sequence[str]) -> str:
    return hashlib.sha256("\n".join(lines).encode()).hexdigest()


def _file_hash(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


PACKAGE = Path(__file__).parents[1]
LETTERS = 12
"""of the hash, 48 bits: it distinguishes versions, it is no protection against a forged one"""
LIBRARIES = ("numpy", "scipy", "clarabel", "qdldl", "shapely", "manifold3d", "cvxopt")
"""libraries on which the last digits of an answer depend; the last two are used where they are found"""


@cache
def program_identity() -> str:
    """Version of mbla and hash of its sources, such as ``0.1.0+3f0a94c1d2e4``."""
    digest = hashlib.sha256()
    for path in sorted(PACKAGE.rglob("*.py"), key=lambda path: path.relative_to(PACKAGE).as_posix()):
        content = path.read_bytes()
        digest.update(f"{path.relative_to(PACKAGE).as_posix()} {len(content)}\n".encode())
        digest.update(content)
    return f"{__version__}+{digest.hexdigest()[:LETTERS]}"


def library_versions() -> dict[str, str]:
    """Version of each library; ``none`` for one that is not installed."""
    return {name: _version(name) for name in LIBRARIES}


def difference(ours: Mapping[str, str], theirs: Mapping[str, str]) -> str:
    """Versions that are not the same, in words; empty where all are."""
    names = [name for name in ours if theirs.get(name) != ours[name]]
    return ", ".join(f"its {name} is {theirs.get(name, 'none')}, here it is {ours[name]}" for name in names)


@cache
def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return "none"
