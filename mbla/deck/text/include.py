"""``include: [file.yaml]``: other decks merged into this one.

Mappings are merged key by key, lists are joined with the included items first. What both files define is a fault that
names both places, except the format version ``mbla``. A file that is reached twice is merged once.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from mbla.deck.text.reader import Document, Remarks, read_yaml
from mbla.deck.text.sources import DECK, FileKind, SourceText, read_source, source_of_text
from mbla.deck.text.tree import MappingMarks, Marks, SequenceMarks, Tree, key_text, own_mark
from mbla.errors import DeckError, Fault, FileError, Message

MAX_FILES = 100
NAMED = frozenset({"parameters", "materials", "joints", "groups", "loads", "load_cases", "expected"})
"""Sections whose entries are things with a name, never merged with one another."""


@dataclass
class Reading(Remarks):
    """Everything read so far: texts, and what was found wrong with them; ``active`` are files not yet at an end."""

    kind: FileKind = DECK
    sources: list[SourceText] = field(default_factory=list)
    active: list[Path] = field(default_factory=list)


def read_files(path: Path, text: str | None = None, kind: FileKind = DECK) -> tuple[Tree, Reading]:
    """The deck of a file with everything it includes; of a text in its place if one is given.

    Raises
    ------
    FileError
        if the file itself cannot be read
    DeckError
        if it is not a text
    """
    reading = Reading(kind=kind)
    source = read_source(path, str(path), kind) if text is None else source_of_text(text, path, str(path))
    tree = _read_file(reading, source)
    return tree, reading


def _read_file(reading: Reading, source: SourceText) -> Tree:
    """One file with the files it includes merged into it."""
    number = len(reading.sources)
    reading.sources.append(source)
    document = read_yaml(source, number, kind=reading.kind)
    reading.faults += document.faults
    reading.reported |= document.reported
    reading.damaged |= document.damaged
    reading.complete &= document.complete
    tree = _mapping_root(reading, document)
    if source.path is not None and reading.kind.includes:
        reading.active.append(source.path)
        tree = _with_included(reading, tree, source)
        reading.active.pop()
    return tree


def _mapping_root(reading: Reading, document: Document) -> Tree:
    """The document as a tree; a fault and an empty tree where its root is no mapping."""
    if isinstance(document.data, dict) and isinstance(document.marks, MappingMarks):
        return Tree(document.data, document.marks, reading.sources)
    mark = own_mark(document.marks)
    tree = Tree({}, MappingMarks(mark), reading.sources)
    if document.complete:
        found = "is empty" if document.data is None else "is not a mapping"
        words = f"{found}: a {reading.kind.name} is a mapping that begins with {reading.kind.begins}"
        reading.faults.append(Fault(tree.place_of(mark), "", Message("not-a-mapping", words)))
    reading.complete = False
    return tree


def _with_included(reading: Reading, tree: Tree, source: SourceText) -> Tree:
    """A tree with the files it lists under `include`; wrong types there are left to the check of types."""
    names = tree.data.get("include")
    if not isinstance(names, list):
        return tree
    merged: Tree | None = None
    if len(names) > MAX_FILES:
        words = f"names {len(names)} files: at most {MAX_FILES} are read"
        reading.faults.append(tree.fault(("include",), Message("too-many-files", words)))
        reading.complete = False
        return tree
    for index, name in enumerate(names):
        if not isinstance(name, str):
            continue
        try:
            included = _open(reading, source, name)
        except (FileError, DeckError) as error:
            reading.faults += (
                error.faults if isinstance(error, DeckError) else [tree.fault(("include", index), error.message)]
            )
            reading.complete = False
            continue
        if included is None:
            continue
        below = _read_file(reading, included)
        below.data.pop("include", None)
        merged = below if merged is None else _merge(reading, merged, below)
    return tree if merged is None else _merge(reading, merged, tree)


def _open(reading: Reading, source: SourceText, name: str) -> SourceText | None:
    """Text of an included file; None where it is merged already."""
    assert source.path is not None
    path = confined(source.path.parent, name)
    label = os.path.normpath(Path(source.label).parent / name)
    if path in reading.active:
        raise FileError(
            "include-refused", "includes itself" if path == source.path else "includes a file that includes it in turn"
        )
    if any(path == other.path for other in reading.sources):
        return None
    if len(reading.sources) >= MAX_FILES:
        raise FileError("include-refused", f"is one file too many: at most {MAX_FILES} are read")
    if path.suffix.lower() not in (".yaml", ".yml"):
        raise FileError("include-refused", "must be a .yaml file")
    try:
        return read_source(path, label)
    except FileError as error:
        raise FileError(error.identifier, str(error).removeprefix(f"{label}: ")) from error


def confined(folder: Path, name: str) -> Path:
    """Resolved path of a file named in a deck.

    Raises FileError if the name is absolute, or leads out of the folder tree of the file that names it, links followed.
    """
    if "\0" in name or len(name) > 1000:
        raise FileError("bad-file-name", "is not a file name")
    if Path(name).is_absolute() or name.startswith(("/", "\\")):
        raise FileError("file-outside-folder", "must be a path relative to the file that names it")
    root = folder.resolve()
    try:
        path = (root / name).resolve()
    except (OSError, RuntimeError) as error:
        raise FileError("file-missing", f"cannot be found: {error}") from error
    if not path.is_relative_to(root):
        raise FileError("file-outside-folder", "leads out of the folder tree of the file that names it")
    return path


def _merge(reading: Reading, first: Tree, second: Tree, path: tuple[str, ...] = ()) -> Tree:
    """Mapping with the keys of two at the same path; the recursion ends with the reader's limit on depth."""
    data = first.data | second.data
    marks = MappingMarks(second.marks.own)
    marks.keys = first.marks.keys | second.marks.keys
    marks.values = first.marks.values | second.marks.values
    for key in second.data:
        if key in first.data:
            data[key], marks.values[key] = _merge_values(reading, first, second, (*path, key))
    return Tree(data, marks, reading.sources)


def _merge_values(reading: Reading, first: Tree, second: Tree, path: tuple[str, ...]) -> tuple[Any, Marks]:
    """Value, and its marks, of a key that both mappings have; that of the second where they cannot be merged."""
    key = path[-1]
    a, b = first.data[key], second.data[key]
    a_marks, b_marks = first.marks.values[key], second.marks.values[key]
    is_section = len(path) == 1 or path[0] not in NAMED
    if isinstance(a_marks, MappingMarks) and isinstance(b_marks, MappingMarks) and is_section:
        merged = _merge(reading, Tree(a, a_marks, reading.sources), Tree(b, b_marks, reading.sources), path)
        return merged.data, merged.marks
    if isinstance(a_marks, SequenceMarks) and isinstance(b_marks, SequenceMarks) and len(path) == 1:
        joined = SequenceMarks(b_marks.own)
        joined.items = a_marks.items + b_marks.items
        return a + b, joined
    if path != ("mbla",) or a != b:
        there = first.place_of(first.marks.keys[key])
        place = second.place_of(second.marks.keys[key])
        reading.faults.append(Fault(place, key_text(path), Message("duplicate-key", f"is defined in {there} too")))
    return b, b_marks
