"""The texts a deck is made of, read from disk with care, and the place of a character in them."""

from __future__ import annotations

import os
import re
import stat
from array import array
from bisect import bisect_right
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from mbla.errors import DeckError, Fault, FileError, Message, Place


@dataclass(frozen=True)
class FileKind:
    """One kind of file.

    name     : after ``a``, in a sentence
    begins   : key and value that such a file has first
    includes : its key `include` names files that are merged into it
    """

    name: str
    begins: str
    includes: bool


DECK = FileKind(name="deck", begins="mbla: 1", includes=True)
MAX_BYTES = 16 * 1024 * 1024
"""Larger decks are refused: geometry of that size belongs in a mesh file."""
_BREAK = re.compile("\r\n|\r|\n")
# Every control character but tab, line feed and carriage return, and the two characters that Unicode never assigns.
_CONTROL = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x84\x86-\x9f\ufffe\uffff]")


@dataclass(frozen=True)
class SourceText:
    """A text with its name in messages.

    path     : the file, resolved; None for the text of an override
    line     : for the text of an override, which one it is (from 1); None for a file
    """

    label: str
    text: str
    path: Path | None = None
    line: int | None = None

    @cached_property
    def _lines(self) -> array[int]:
        """Offset at which each line begins."""
        return array("q", (0, *(match.end() for match in _BREAK.finditer(self.text))))

    def place(self, offset: int) -> Place:
        """Place of the character at an offset of the text."""
        if self.line is not None:
            return Place(self.label, self.line, offset + 1)
        row = bisect_right(self._lines, offset)
        return Place(self.label, row, offset - self._lines[row - 1] + 1)


def _read_bytes(path: Path, label: str) -> bytes:
    """Content of a regular file.

    Raises FileError if it cannot be opened, or is a folder, pipe or device (opening does not block, so a pipe cannot
    hang).
    """
    try:
        descriptor = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0))
    except (OSError, ValueError) as error:
        raise FileError(
            "file-unreadable", f"{label}: cannot be opened: {getattr(error, 'strerror', None) or error}"
        ) from error
    if not stat.S_ISREG(os.fstat(descriptor).st_mode):
        os.close(descriptor)
        raise FileError("not-a-regular-file", f"{label}: is not a regular file")
    with os.fdopen(descriptor, "rb") as file:
        try:
            return file.read(MAX_BYTES + 1)
        except OSError as error:
            raise FileError("file-unreadable", f"{label}: cannot be read: {error.strerror or error}") from error


def read_source(path: Path, label: str, kind: FileKind = DECK) -> SourceText:
    """Text of a deck or another file of that kind: strict UTF-8, a byte order mark allowed, no control characters.

    Raises
    ------
    FileError
        if the file cannot be read
    DeckError
        if its content is not such a text, or too large
    """
    content = _read_bytes(path, label)
    return SourceText(label, _decode(content, label, kind), path.resolve())


def source_of_text(text: str, path: Path, label: str) -> SourceText:
    """A text as that of a file; DeckError as ``read_source``."""
    content = text.encode("utf-8", "surrogatepass")  # a lone surrogate is no text: reported like any bad byte
    return SourceText(label, _decode(content, label, DECK), path.resolve())


def has_control_character(text: str) -> bool:
    """Whether a string holds a control character; line breaks and tabs do not count."""
    return _CONTROL.search(text) is not None


def _decode(content: bytes, label: str, kind: FileKind) -> str:
    start = SourceText(label, "")
    if len(content) > MAX_BYTES:
        words = f"is larger than {MAX_BYTES // 1024**2} MB: put large geometry and tables in files of their own"
        raise _refusal(start, 0, Message("file-too-large", words))
    if content.startswith(b"\x89HDF"):
        raise _refusal(start, 0, Message("not-utf-8", f"is an HDF5 file, not a {kind.name}: mbla show reads results"))
    if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
        raise _refusal(start, 0, Message("not-utf-8", "is UTF-16 text: save it as UTF-8"))
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        # `errors="replace"` keeps every line break in front of the bad byte, so line and column are right.
        before = content[: error.start].decode("utf-8-sig", "replace")
        byte = content[error.start]
        words = f"byte 0x{byte:02X} is not UTF-8: save the {kind.name} as UTF-8"
        raise _refusal(SourceText(label, before), len(before), Message("not-utf-8", words)) from None
    if match := _CONTROL.search(text):
        words = f"control character U+{ord(match.group()):04X} is not allowed in a {kind.name}"
        raise _refusal(SourceText(label, text), match.start(), Message("control-character", words))
    return text


def _refusal(source: SourceText, offset: int, message: Message) -> DeckError:
    return DeckError([Fault(source.place(offset), "", message)])
