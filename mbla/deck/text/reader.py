"""YAML text to plain data with marks (only importer of yaml).

The events of the parser are put together here rather than by the library's loaders, which let duplicate keys pass,
read numbers by YAML 1.1, and crash the process on deeply nested input.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import yaml

from mbla.deck.text.sources import DECK, FileKind, SourceText, has_control_character
from mbla.deck.text.tree import (
    FILE_SHIFT,
    OFFSET_MASK,
    MappingMarks,
    Marks,
    SequenceMarks,
    key_text,
    own_mark,
    plain_scalar,
    shorten,
)
from mbla.errors import MOST_FAULTS, Fault, KeyPath, Message, Place, ValueRefused

MAX_DEPTH = 64
"""Nesting of brackets and indentation; the deck's own types need ten."""
TOO_DEEP = Message("nested-too-deeply", f"is nested more than {MAX_DEPTH} levels deep")

MOST_KEYS, MOST_ITEMS = 10_000, 100_000
"""of one mapping, and of one list; what is larger is no deck, or geometry that belongs in a file of its own"""
KEY_TOO_MANY = f"is one key too many: a mapping has at most {MOST_KEYS:,}"
ITEM_TOO_MANY = f"is one item too many: a list has at most {MOST_ITEMS:,}"

_PARSER: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


@dataclass
class Remarks:
    """What was found wrong while reading.

    faults  : everything that was wrong with the texts
    reported: marks of the values that are reported already, so that none is reported twice
    damaged : marks of the mappings in which a key had to be left out
    complete: false where a text could not be read to its end
    """

    faults: list[Fault] = field(default_factory=list)
    reported: set[int] = field(default_factory=set)
    damaged: set[int] = field(default_factory=set)
    complete: bool = True


@dataclass
class Document(Remarks):
    """What was read from one text.

    data  : plain dicts, lists and scalars; None stands for a value that is already reported
    marks : places of all keys and values
    """

    data: Any = None
    marks: Marks = 0


def read_yaml(source: SourceText, file: int, offset: int = 0, kind: FileKind = DECK) -> Document:
    """Read the one document in a text, from a character offset on; ``file`` goes into the marks."""
    builder = _Builder(source, (file << FILE_SHIFT) + offset, kind)
    parser = _PARSER(source.text[offset:] if offset else source.text)
    try:
        next_event = parser.get_event
        while (event := next_event()) is not None:
            if type(event) is yaml.ScalarEvent:
                builder.scalar(event)
            else:
                builder.event(event)
    except yaml.YAMLError as error:
        builder.syntax_fault(error)
    except _StopError:
        builder.document.complete = False
    finally:
        parser.dispose()
    return builder.document


class _StopError(Exception):
    """Nothing sensible can follow: nesting too deep, or a second document."""


_NO_KEY: Any = None
_DROPPED: Any = object()
"""key of a value that has no place in the mapping: a repeated key, or one that is not text"""


class _Builder:
    """The container being filled, and the stack of those around it."""

    def __init__(self, source: SourceText, base: int, kind: FileKind) -> None:
        self.source = source
        self.kind = kind
        self.base = base
        self.document = Document(marks=base)
        self.documents = 0
        self.data: Any = None
        self.marks: Any = None
        self.key: Any = _NO_KEY
        self.stack: list[tuple[Any, Any, Any, Any]] = []  # data, marks, key of what is being filled, key after it
        self.plain: dict[str, Any] = {}  # values of plain scalars seen before: indices and coordinates repeat

    # --- one method per kind of event ---

    def scalar(self, event: Any) -> None:
        mark = self.base + event.start_mark.index
        text = event.value
        if event.style:
            value = text
            if event.style == '"' and has_control_character(text):
                self.fault(mark, Message("control-character", "control characters are not allowed in a text"))
        elif (value := self.plain.get(text)) is None:
            value = self.plain_value(text, mark)
        if event.anchor or event.tag:
            self.refuse_properties(event, mark)
        if type(self.data) is dict and self.key is _NO_KEY:
            self.take_key(value, text, mark)
        else:
            self.put_value_or_key(value, mark)

    def event(self, event: Any) -> None:
        kind = type(event)
        if kind is yaml.SequenceEndEvent or kind is yaml.MappingEndEvent:
            self.data, self.marks, _, self.key = self.stack.pop()
            return
        mark = self.base + event.start_mark.index
        if kind is yaml.SequenceStartEvent:
            self.open([], SequenceMarks(mark), event)
        elif kind is yaml.MappingStartEvent:
            self.open({}, MappingMarks(mark), event)
        elif kind is yaml.AliasEvent:
            message = f"aliases (*{shorten(event.anchor)}) are not allowed: write the value out, or use a parameter"
            self.fault(mark, Message("yaml-not-allowed", message))
            self.document.reported.add(mark)
            self.put_value_or_key(None, mark)
        elif kind is yaml.DocumentStartEvent:
            self.start_document(event, mark)

    def start_document(self, event: Any, mark: int) -> None:
        """A document begins; raises _StopError at a second one."""
        self.documents += 1
        if self.documents == 2:
            words = f"a second document begins here: a {self.kind.name} is one document"
            self.fault(mark, Message("yaml-not-allowed", words), path=())
            raise _StopError
        if event.version == (1, 1) or event.tags:
            self.fault(mark, Message("yaml-not-allowed", "directives other than %YAML 1.2 are not allowed"), path=())

    # --- putting values where they belong ---

    def open(self, data: Any, marks: Any, event: Any) -> None:
        """A list or a mapping begins; raises _StopError where it is nested too deeply."""
        if event.anchor or event.tag:
            self.refuse_properties(event, marks.own)
        if len(self.stack) >= MAX_DEPTH:
            self.fault(marks.own, TOO_DEEP, path=())
            raise _StopError
        key = self.key
        self.put_value_or_key(data, marks)
        self.stack.append((self.data, self.marks, key, self.key))
        self.data, self.marks, self.key = data, marks, _NO_KEY

    def put_value_or_key(self, value: Any, marks: Any) -> None:
        data = self.data
        if type(data) is list:
            if len(data) == MOST_ITEMS:
                self.refuse_entry(own_mark(marks), ITEM_TOO_MANY, self.path())
            data.append(value)
            self.marks.items.append(marks)
        elif type(data) is not dict:
            self.document.data, self.document.marks = value, marks
        elif self.key is not _NO_KEY:
            if self.key is not _DROPPED:
                data[self.key] = value
                self.marks.values[self.key] = marks
            self.key = _NO_KEY
        else:
            if value is not None:  # an alias is already reported
                self.fault(marks.own, Message("key-not-text", "a key must be text"))
            self.leave_out()

    def take_key(self, value: Any, text: str, mark: int) -> None:
        if text == "<<":
            self.leave_out()
            words = "merge keys (<<) are not allowed: write the values out, or use a parameter"
            self.fault(mark, Message("yaml-not-allowed", words))
        elif not isinstance(value, str):
            self.leave_out()
            words = f'a key must be text: write "{shorten(text)}" in quotes' if text else "a key is missing"
            self.fault(mark, Message("key-not-text", words))
        elif value in self.data:
            self.key = _DROPPED
            first = self.place(self.marks.keys[value])
            words = f"is given twice, first in line {first.line}"
            self.fault(mark, Message("duplicate-key", words), path=(*self.path(), value))
        else:
            if len(self.data) == MOST_KEYS:
                self.refuse_entry(mark, KEY_TOO_MANY, (*self.path(), value))
            self.key = value
            self.marks.keys[value] = mark

    def leave_out(self) -> None:
        """Drop the value of a key that is already reported."""
        self.key = _DROPPED
        self.document.damaged.add(self.marks.own)

    def plain_value(self, text: str, mark: int) -> Any:
        """Value of a plain scalar; None, and reported, for what no key of a deck takes."""
        try:
            value = plain_scalar(text)
        except ValueRefused as error:
            self.fault(mark, error.message, text)
            self.document.reported.add(mark)
            return None
        if value is None and not (type(self.data) is dict and self.key is _NO_KEY):
            if self.stack:  # an empty document has its own message
                self.fault(mark, Message("no-value", "has no value: give one, or leave the key out"), text or None)
                self.document.reported.add(mark)
        else:
            self.plain[text] = value
        return value

    # --- faults ---

    def place(self, mark: int) -> Place:
        return self.source.place(mark & OFFSET_MASK)

    def path(self) -> KeyPath:
        """Path of the value that is about to be put."""
        levels = [*self.stack[1:], (self.data, self.marks, self.key, None)] if self.stack else []
        return tuple(
            len(data) - (depth < len(levels) - 1) if type(data) is list else key
            for depth, (data, _, key, _) in enumerate(levels)
            if type(data) is list or isinstance(key, str)
        )

    def fault(self, mark: int, message: Message, value: str | None = None, path: KeyPath | None = None) -> None:
        """Add a fault; raises _StopError once there are ``MOST_FAULTS``."""
        key = key_text(self.path() if path is None else path)
        self.document.faults.append(Fault(self.place(mark), key, message, shorten(value) if value else None))
        if len(self.document.faults) == MOST_FAULTS:
            words = Message("more-faults", f"is read no further after {MOST_FAULTS} faults")
            self.document.faults.append(Fault(self.place(mark), "", words))
            raise _StopError

    def refuse_entry(self, mark: int, words: str, path: KeyPath) -> None:
        """Refuse a key or an item that is one too many; raises _StopError, for nothing is read any more."""
        self.fault(mark, Message("too-many-entries", words), path=path)
        raise _StopError

    def refuse_properties(self, event: Any, mark: int) -> None:
        if event.anchor:
            self.fault(mark, Message("yaml-not-allowed", f"anchors (&{shorten(event.anchor)}) are not allowed"))
        if event.tag:
            tag = event.tag.replace("tag:yaml.org,2002:", "!!")
            self.fault(mark, Message("yaml-not-allowed", f"tags ({shorten(tag)}) are not allowed"))

    def syntax_fault(self, error: yaml.YAMLError) -> None:
        self.document.complete = False
        mark = getattr(error, "problem_mark", None) or getattr(error, "context_mark", None)
        begun = getattr(error, "context_mark", None)
        problem = getattr(error, "problem", None) or getattr(error, "reason", None) or "cannot be read"
        context = getattr(error, "context", None)
        words = f"not YAML: {context}: {problem}" if context else f"not YAML: {problem}"
        first = self.base & OFFSET_MASK
        offset = first + (mark.index if mark else 0)
        if begun and offset >= len(self.source.text.rstrip()):
            offset = first + begun.index  # what never ends is better shown where it begins
        elif begun and (line := self.source.place(first + begun.index).line) != self.source.place(offset).line:
            words += f" (it began in line {line})"
        if self.source.text[offset : offset + 1] == "\t":
            words += " (indent with spaces, not with tabs)"
        # libyaml has a limit of its own, which a line of brackets may meet before the first of them is an event
        message = TOO_DEEP if "nesting depth" in problem else Message("not-yaml", words)
        self.document.faults.append(Fault(self.source.place(offset), "", message))
