"""The deck as the later stages get it, and the way there from a file: read, include, override, evaluate, validate."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable, Iterable, Sequence
from copy import deepcopy
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mbla.deck.content import DeckContent, UnitsSection, with_flow_rule
from mbla.deck.expressions import Parameters, is_expression
from mbla.deck.groups import put_groups_in_place
from mbla.deck.notices import notices_of
from mbla.deck.parameter_keys import parameter_faults
from mbla.deck.references import check_references, side_files
from mbla.deck.section import validator
from mbla.deck.sections.analysis import AnalysisSection
from mbla.deck.sections.contacts import ContactsSection
from mbla.deck.text.include import Reading, confined, read_files
from mbla.deck.text.overrides import apply_override
from mbla.deck.text.tree import Tree
from mbla.deck.units import Units
from mbla.deck.validation import validate
from mbla.errors import MOST_FAULTS, DeckError, Fault, FileError, KeyPath, Message, Notice, first_faults
from mbla.process.collector import no_collection


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
    data    : as read, with inclusions, overrides and named groups in their places; expressions are not evaluated
    sha256  : of the texts of all sources and overrides, 64 hex digits; neither file names nor side files count
    """

    path: Path
    sources: tuple[Source, ...]
    side_files: tuple[SideFile, ...]
    overrides: tuple[str, ...]
    sha256: str
    data: dict[str, Any]
    content: DeckContent
    units: Units
    notices: tuple[Notice, ...]
    fault_at: Callable[[KeyPath, Message], Fault]
    """Fault for a key path such as ("blocks", 3, "wall", "length") with a message; finds place and value itself."""
    resolve_file: Callable[[KeyPath, str], Path]
    """Path of a file named by the value at a key path; relative to the file that names it and confined to its folder
    tree. DeckError if missing, not a regular file, or outside."""

    @property
    def title(self) -> str:
        """Its title; the name of its file where it has none."""
        return self.content.title or self.path.name

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


def read_deck(path: str | Path, overrides: Sequence[str] = (), *, expected: bool = True) -> Deck:
    """Read and check a deck.

    path      : the deck file
    overrides : ``key.path=value`` texts, applied in order before anything is evaluated
    expected  : whether its expectations are read; they are for the deck as written, and may have no value, or not be
                defined at all, with what a study sets in it

    Raises
    ------
    DeckError
        with every fault found
    FileError
        if the deck file itself cannot be opened
    """
    with no_collection():
        return _read(Path(path), read_files(Path(path)), overrides, expected=expected)


def read_deck_text(text: str, path: Path, overrides: Sequence[str] = (), *, expected: bool = True) -> Deck:
    """Read and check a deck that is at hand as text.

    path     : the file it stands for, in messages and for the files that it names; not opened
    expected : as for ``read_deck``

    Raises DeckError with every fault found.
    """
    with no_collection():
        return _read(path, read_files(path, text), overrides, expected=expected)


def deck_of_files(
    path: Path, files: tuple[Tree, Reading], overrides: Sequence[str] = (), *, expected: bool = True
) -> Deck:
    """As ``read_deck``, of files that ``read_files`` has read and that are to be taken again: they stay as they are."""
    with no_collection():
        return _read(path, deepcopy(files), overrides, expected=expected)


def _read(path: Path, files: tuple[Tree, Reading], overrides: Sequence[str], *, expected: bool) -> Deck:
    tree, reading = files
    for number, text in enumerate(overrides, start=1):
        reading.faults += apply_override(tree, text, number)
    if not reading.complete:  # what could not be read would be reported as missing
        raise DeckError(reading.faults)
    if "mbla_sweep" in tree.data and "mbla" not in tree.data:
        words = "this is a sweep file, not a deck: mbla sweep runs it"
        raise DeckError([tree.fault(("mbla_sweep",), Message("sweep-file-and-deck", words), at_key=True)])
    if not expected:
        tree.data.pop("expected", None)
    put_groups_in_place(tree)
    units = _units(tree.data)
    parameters = Parameters(given if isinstance(given := tree.data.get("parameters"), dict) else {})
    content, faults = validate(
        tree,
        DeckContent,
        lambda text, dim: parameters.evaluate(text) if is_expression(text) else units.convert(text, dim),
        reading.reported,
        reading.damaged,
    )
    if len(faults) > MOST_FAULTS:  # no more of them are reported
        raise DeckError(list(dict.fromkeys(faults + reading.faults)))
    faults += [tree.fault(("parameters", name), message) for name, message in parameters.failures()]
    faults += reading.faults
    # What is no name at all is not looked up as well.
    seen = {(fault.place, fault.key) for fault in faults}
    faults += [fault for fault in first_faults(check_references(tree)) if (fault.place, fault.key) not in seen]
    faults += first_faults(parameter_faults(tree, None if faults else content))
    if content is None or faults:
        raise DeckError(list(dict.fromkeys(faults)))
    content = with_flow_rule(content)
    return Deck(
        path=path,
        sources=tuple(
            Source(source.path, source.text, _from_main(tree, source.label))
            for source in tree.sources
            if source.path is not None
        ),
        side_files=tuple(SideFile(at, name, _side_name(tree, at, name)) for at, name in side_files(tree.data)),
        overrides=tuple(overrides),
        sha256=sha256_of(source.text for source in tree.sources),
        data=tree.data,
        content=content,
        units=units,
        notices=notices_of(tree, content, units, parameters),
        fault_at=tree.fault,
        resolve_file=_resolver(tree, path),
    )


def _units(data: dict[str, Any]) -> Units:
    """Units of the deck; the defaults where they are at fault, which is reported with everything else."""
    try:
        section = validator(UnitsSection).validate_python(data.get("units", {}))
    except ValueError:
        return Units()
    return Units(section.length, section.force, section.mass)


def _from_main(tree: Tree, label: str) -> str:
    """Path of a source from the folder of the main file, with ``/``."""
    return Path(os.path.relpath(label, Path(tree.sources[0].label).parent)).as_posix()


def _side_name(tree: Tree, at: KeyPath, name: str) -> str:
    """The same of a file that the value at a key path names, relative to the file that names it."""
    naming = tree.source_of(tree.value_mark(at))
    label = tree.sources[0].label if naming.path is None else naming.label
    return _from_main(tree, os.path.normpath(Path(label).parent / name))


def sha256_of(texts: Iterable[str]) -> str:
    """Hash of the texts of a deck and its overrides in the order they were read, each with its length."""
    digest = hashlib.sha256()
    for text in texts:
        content = text.encode()
        digest.update(f"{len(content)}\n".encode())
        digest.update(content)
    return digest.hexdigest()


def _resolver(tree: Tree, deck_path: Path) -> Callable[[KeyPath, str], Path]:
    """Function from a key path and the file name there to a path."""

    def resolve_file(path: KeyPath, name: str) -> Path:
        source = tree.source_of(tree.value_mark(path)).path or deck_path.resolve()
        try:
            found = confined(source.parent, name)
            check_regular(found)
        except FileError as error:
            raise DeckError([tree.fault(path, error.message)]) from error
        return found

    return resolve_file


def check_regular(path: Path) -> None:
    """Raises FileError unless a path is a regular file that can be opened."""
    try:
        if not path.exists():
            raise FileError("file-missing", "does not exist")
        if not path.is_file():
            raise FileError("not-a-regular-file", "is not a regular file")
        with path.open("rb"):
            pass
    except OSError as error:
        raise FileError("file-unreadable", f"cannot be opened: {error.strerror or error}") from error
