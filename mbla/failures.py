"""What went wrong, in words and as a record."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from mbla import __version__
from mbla.errors import DeckError, FileError, LimitError, MblaError


def identifiers_of(error: Exception) -> list[str]:
    """The identifier of an error, or of each fault of a deck; ``mbla explain`` says what it means."""
    if isinstance(error, DeckError):
        return [fault.identifier for fault in error.faults]
    if isinstance(error, MblaError):
        return [error.identifier]
    if isinstance(error, MemoryError):
        return ["out-of-memory"]
    return ["file-system" if isinstance(error, OSError) else "internal-error"]


def lines_of(error: Exception) -> list[str]:
    """What went wrong as it is printed: a line for each fault of a deck, else one text, its identifier in brackets."""
    if isinstance(error, DeckError):
        return [fault.line() for fault in error.faults]
    (identifier,) = identifiers_of(error)
    return [f"{with_notes(words_of(error)[1], error)}  [{identifier}]"]


def words_of(error: Exception) -> tuple[int, str]:
    """Exit status, and what went wrong in words."""
    if isinstance(error, MblaError):
        return error.exit_status, str(error)
    if isinstance(error, MemoryError):
        return LimitError.exit_status, "out of memory"
    if isinstance(error, OSError):
        return FileError.exit_status, f"{error.filename or 'standard output'}: {error.strerror or error}"
    words = " ".join(str(error).split())
    return 1, f"internal error, please report it with the deck: {type(error).__name__}: {words}"


def with_notes(text: str, error: BaseException) -> str:
    """The text of an error, and behind it what was noted where it passed through (``add_note``), in one line."""
    return "; ".join([text, *getattr(error, "__notes__", ())])


def failure_record(path: Path, error: Exception, code: int, about: str = "deck") -> dict[str, Any]:
    """The object that ``--json`` prints of a deck that could not be run, or of what else it is about."""
    return {
        "mbla": __version__,
        about: path.name,
        "exit_code": code,
        "errors": lines_of(error),
        "identifiers": identifiers_of(error),
    }
