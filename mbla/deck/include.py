"""``include: [file.yaml]``: other decks merged into this one.

Mappings are merged key by key, lists are joined with the included items first. What both files define is a fault that
names both places, except the format version ``mbla``. A file that is reached twice is merged once.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from mbla.deck.reader import Document, read_yaml
from mbla.deck.sources import SourceText, read_source
from mbla.deck.tree import MappingMarks, SequenceMarks, Tree, key_text, own_mark
from mbla.errors import DeckError, Fault, FileError

MAX_FILES = 100
NAMED = frozenset({"parameters", "materials", "joints", "load_cases", "expected"})
"""Sections whose entries are things with a name, never merged with one another."""


@dataclass
class Reading:
    """Everything read so far: texts, faults, and marks of what is reported already (see ``Document``)."""

    sources: list[SourceText] = field(default_factory=list)
    faults: list[Fault] = field(default_factory=list)
    reported: set[int] = field(default_factory=set)
    damaged: set[int] = field(default_factory=set)
    active: list[Path] = field(default_factory=list)
    whole: bool = True


def read_files(path: Path) -> tuple[Tree, Reading]:
    """The deck of a file with everything it includes.

    Raises
    ------
    FileError
        if the file itself cannot be read
    DeckError
        if it is not a text
    """
    reading = Reading()
    tree = _read_file(reading, read_source(path, str(path)))
    return tree, reading


def _read_file(reading: Reading, source: SourceText) -> Tree:
    """One file with the files it includes merged into it."""
    number = len(reading.sources)
    reading.sources.append(source)
    document = read_yaml(source, number)
    reading.faults += document.faults
    reading.reported |= document.reported
    reading.damaged |= document.damaged
    reading.whole &= document.whole
    tree = _mapping_root(reading, document)
    if source.path is not None:
        reading.active.append(source.path)
        _merge_included(reading, tree, source)
        reading.active.pop()
    return tree


def _mapping_root(reading: Reading, document: Document) -> Tree:
    """The document as a tree; a fault and an empty tree where its root is no mapping."""
    if isinstance(document.data, dict) and isinstance(document.marks, MappingMarks):
        return Tree(document.data, document.marks, reading.sources)
    mark = own_mark(document.marks)
    tree = Tree({}, MappingMarks(mark), reading.sources)
    if not document.faults:
        found = "is empty" if document.data is None else "is not a mapping"
        reading.faults.append(Fault(tree.place_of(mark), "", f"{found}: a deck is a mapping that begins with mbla: 1"))
        reading.whole = False
    return tree


def _merge_included(reading: Reading, tree: Tree, source: SourceText) -> None:
    """Merge the files that a tree lists under `include`; wrong types there are left to the check of types."""
    names = tree.data.get("include")
    if not isinstance(names, list):
        return
    merged: Tree | None = None
    for index, name in enumerate(names):
        if not isinstance(name, str):
            continue
        try:
            included = _open(reading, source, name)
        except (FileError, DeckError) as error:
            reading.faults += _faults_of(error, tree, index)
            reading.whole = False
            continue
        if included is None:
            continue
        below = _read_file(reading, included)
        below.data.pop("include", None)
        merged = below if merged is None else _merge(reading, merged, below)
    if merged is not None:
        _merge(reading, merged, tree, into=tree)


def _open(reading: Reading, source: SourceText, name: str) -> SourceText | None:
    """Text of an included file; None where it is merged already."""
    assert source.path is not None
    path = confined(source.path.parent, name)
    label = os.path.normpath(Path(source.label).parent / name)
    if path in reading.active:
        raise FileError("includes itself" if path == source.path else "includes a file that includes it in turn")
    if any(path == other.path for other in reading.sources):
        return None
    if len(reading.sources) >= MAX_FILES:
        raise FileError(f"is one file too many: at most {MAX_FILES} are read")
    if path.suffix.lower() not in (".yaml", ".yml"):
        raise FileError("must be a .yaml file")
    try:
        return read_source(path, label)
    except FileError as error:
        raise FileError(str(error).removeprefix(f"{label}: ")) from error


def _faults_of(error: FileError | DeckError, tree: Tree, index: int) -> list[Fault]:
    if isinstance(error, DeckError):
        return list(error.faults)
    return [tree.fault(("include", index), str(error))]


def confined(folder: Path, name: str) -> Path:
    """Resolved path of a file named in a deck.

    Raises
    ------
    FileError
        if the name is absolute, or leads out of the folder tree of the file that names it, links followed
    """
    if "\0" in name or len(name) > 1000:
        raise FileError("is not a file name")
    if Path(name).is_absolute() or name.startswith(("/", "\\")):
        raise FileError("must be a path relative to the file that names it")
    root = folder.resolve()
    try:
        path = (root / name).resolve()
    except (OSError, RuntimeError) as error:
        raise FileError(f"cannot be found: {error}") from error
    if not path.is_relative_to(root):
        raise FileError("leads out of the folder tree of the file that names it")
    return path


def _merge(reading: Reading, first: Tree, second: Tree, into: Tree | None = None) -> Tree:
    """Content of both trees, in the given order of lists; the result replaces the content of ``into``."""
    data, marks = _merge_mappings(reading, first, second, (first.data, first.marks), (second.data, second.marks), ())
    target = into or Tree({}, MappingMarks(first.marks.own), reading.sources)
    target.data.clear()
    target.data.update(data)
    target.marks.keys = marks.keys
    target.marks.values = marks.values
    return target


def _merge_mappings(
    reading: Reading,
    first: Tree,
    second: Tree,
    a: tuple[dict[str, Any], MappingMarks],
    b: tuple[dict[str, Any], MappingMarks],
    path: tuple[str, ...],
) -> tuple[dict[str, Any], MappingMarks]:
    """Mapping with the keys of two; recursion ends with the reader's limit on depth."""
    data = dict(a[0])
    marks = MappingMarks(b[1].own)
    marks.keys = dict(a[1].keys)
    marks.values = dict(a[1].values)
    for key, value in b[0].items():
        value_marks = b[1].values[key]
        if key in data:
            other, other_marks = data[key], marks.values[key]
            named = bool(path) and path[0] in NAMED
            if isinstance(value, dict) and isinstance(other, dict) and not named:
                assert isinstance(value_marks, MappingMarks)
                assert isinstance(other_marks, MappingMarks)
                data[key], marks.values[key] = _merge_mappings(
                    reading, first, second, (other, other_marks), (value, value_marks), (*path, key)
                )
                marks.keys[key] = b[1].keys[key]
                continue
            if isinstance(value, list) and isinstance(other, list) and not path:
                assert isinstance(value_marks, SequenceMarks)
                assert isinstance(other_marks, SequenceMarks)
                joined = SequenceMarks(value_marks.own)
                joined.items = [*other_marks.items, *value_marks.items]
                data[key], marks.values[key] = [*other, *value], joined
                marks.keys[key] = b[1].keys[key]
                continue
            if not (key == "mbla" and not path and value == other):
                there = first.place_of(marks.keys[key])
                place = second.place_of(b[1].keys[key])
                reading.faults.append(Fault(place, key_text((*path, key)), f"is defined in {there} too"))
        data[key], marks.values[key], marks.keys[key] = value, value_marks, b[1].keys[key]
    return data, marks
