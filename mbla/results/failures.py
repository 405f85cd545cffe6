"""What went wrong, in words and as a record."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mbla import __version__
from mbla.errors import DeckError, FileError, LimitError, MblaError
from mbla.process.signals import Terminated

if TYPE_CHECKING:
    from mbla.results.results import Results

SIGNALS: dict[type[BaseException], tuple[int, str]] = {
    KeyboardInterrupt: (130, "interrupted"),
    Terminated: (143, "terminated"),
}
"""exit status and word of the signals that end a command"""
ENDINGS: tuple[type[BaseException], ...] = (Exception, *SIGNALS)
"""whatever ends a command and is reported"""


class StoppedRun(BaseException):
    """A run that ended before its end when load cases were done.

    cause   : what ended it
    results : of those that were done; ``files`` has the names of their files
    """

    def __init__(self, cause: BaseException, results: Results) -> None:
        self.cause = cause
        self.results = results
        super().__init__(cause)


def identifiers_of(error: BaseException) -> list[str]:
    """The identifier of an error, or of each fault of a deck; ``mbla explain`` says what it means."""
    if type(error) in SIGNALS:
        return [f"exit-{SIGNALS[type(error)][0]}"]
    if isinstance(error, DeckError):
        return [fault.identifier for fault in error.faults]
    if isinstance(error, MblaError):
        return [error.identifier]
    if isinstance(error, MemoryError):
        return ["out-of-memory"]
    return ["file-system" if isinstance(error, OSError) else "internal-error"]


def lines_of(error: BaseException) -> list[str]:
    """What went wrong as it is printed: a line for each fault of a deck, else one text, its identifier in brackets."""
    if isinstance(error, DeckError):
        return [fault.line() for fault in error.faults]
    (identifier,) = identifiers_of(error)
    return [f"{with_notes(words_of(error)[1], error)}  [{identifier}]"]


def words_of(error: BaseException) -> tuple[int, str]:
    """Exit status, and what went wrong in words."""
    if type(error) in SIGNALS:
        return SIGNALS[type(error)]
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


def failure_record(error: BaseException, about: Mapping[str, Path]) -> dict[str, Any]:
    """The object that ``--json`` prints where a command failed.

    about : files that it is about, by the keys of their names (``deck``, ``result``); none where that is not known
    """
    return {
        "mbla": __version__,
        **{key: path.name or str(path) for key, path in about.items()},
        "exit_code": words_of(error)[0],
        "errors": lines_of(error),
        "identifiers": identifiers_of(error),
    }
