"""Everything that mbla raises on purpose, and the remarks that do not stop a run.

::

    MblaError                     exit status
    ├── UsageError                2   the command line is wrong
    ├── DeckError                 3   the deck is wrong; carries every Fault found
    ├── SolverError               4   a program that should have been solved was not
    │   └── UnfitSolverError          the solver that the deck names takes no program of that kind
    ├── FileError                 6   reading or writing failed, or a result would be overwritten
    └── LimitError                7   out of time or memory

Anything else that reaches the command line is a defect of mbla (exit status 1).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Literal


class MblaError(Exception):
    """Root of the tree; ``exit_status`` is what the command line returns."""

    exit_status = 1


class UsageError(MblaError):
    """The command line asks for something that does not exist."""

    exit_status = 2


class SolverError(MblaError):
    """The cone solver refused or broke on a program that was handed to it."""

    exit_status = 4


class UnfitSolverError(SolverError):
    """The solver that the deck names does not take programs of the kind that the load case is."""


class FileError(MblaError):
    """A file cannot be read or written, is not what it should be, or would be overwritten."""

    exit_status = 6


class LimitError(MblaError):
    """The run needs more time or memory than it was given."""

    exit_status = 7


@dataclass(frozen=True)
class Place:
    """Where something stands in a file; line and column count from 1."""

    file: str
    line: int
    column: int

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}"


@dataclass(frozen=True)
class Fault:
    """One thing wrong with a deck: place, key path with its value as written, what is wrong and what is allowed."""

    place: Place
    key: str
    message: str
    value: str | None = None

    def __str__(self) -> str:
        subject = self.key if self.value is None else f"{self.key} = {self.value}"
        return printable(f"{self.place} {subject}: {self.message}" if subject else f"{self.place} {self.message}")


MOST_FAULTS = 1000
"""of one kind that are told; a file that has more is none that somebody corrects fault by fault"""


def first_faults(faults: Iterable[Fault]) -> list[Fault]:
    """The first of many faults, and where the others are left out a last one that says so."""
    told = list(islice(faults, MOST_FAULTS + 1))
    if len(told) > MOST_FAULTS:
        told[-1] = Fault(told[-1].place, "", f"more faults follow: only the first {MOST_FAULTS} are told")
    return told


class DeckError(MblaError):
    """The deck is not valid; ``faults`` lists everything found wrong with it, in file order."""

    exit_status = 3

    def __init__(self, faults: Sequence[Fault]) -> None:
        self.faults = tuple(sorted(faults, key=lambda f: (f.place.file, f.place.line, f.place.column)))
        super().__init__("\n".join(str(fault) for fault in self.faults))

    def __reduce__(self) -> tuple[type[DeckError], tuple[tuple[Fault, ...]]]:
        return type(self), (self.faults,)  # what it was made of: a process hands it on with its places


@dataclass(frozen=True)
class Notice:
    """A remark that does not stop the run; ``identifier`` is stable and in kebab case (``faces-turned-outwards``).

    case : load case that it is about; empty where it is about the whole run
    """

    severity: Literal["notice", "warning"]
    identifier: str
    message: str
    case: str = ""

    def __str__(self) -> str:
        return printable(f"{self.severity} [{self.identifier}]: {self.message}")


def printable(text: str) -> str:
    """A text with nothing in it that a terminal acts on: names of files, and what files hold, come from anybody.

    >>> printable("stone" + chr(27) + ".obj")
    'stone�.obj'
    """
    if text.isprintable():
        return text
    return "".join(character if character.isprintable() else "\ufffd" for character in text)
