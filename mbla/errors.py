"""Everything that mbla raises on purpose, and the remarks that do not stop a run.

::

    MblaError                     exit status
    ├── UsageError                2   the command line is wrong
    ├── DeckError                 3   the deck is wrong; carries every Fault found
    ├── SolverError               4   a program that should have been solved was not
    ├── FileError                 6   reading or writing failed, or a result would be overwritten
    └── LimitError                7   out of time or memory

Anything else that reaches the command line is a defect of mbla (exit status 1).

Every error has an identifier, one for each kind of error: what differs in cause and remedy, not in wording. It is
stable and in kebab case; the command line prints it in brackets behind the message, JSON has it under ``identifiers``,
and ``mbla explain`` says what it means. A new error takes the identifier of its kind where there is one. Else

1. it is written as a literal where the message is made: ``FileError("result-exists", f"{path}: exists already")``,
   or ``Message("face-not-planar", "...")`` for what becomes a :class:`Fault` where its place is known; whoever hands
   an error on keeps the identifier: ``FileError(error.identifier, ...)``, ``error.message.around(before=...)``;
2. its identifier goes into ``mbla/results/messages.toml``: into the list ``message_says_all`` of its section, or, where
   cause and remedy say more than the message does, next to similar ones with both;
3. it gets a test: a line of the table of ``tests/invalid_decks`` or ``tests/invalid_sweeps`` for what is
   wrong in one, else a case in ``tests/trust/messages``, whose checks find what lacks any of the three.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Literal, TypeAlias

KeyPath: TypeAlias = tuple[str | int, ...]
"""of a value in a deck: ("blocks", 3, "wall", "length")"""


class Message(str):
    """What is wrong and what is allowed, in words, with the identifier of its kind.

    It is a text like any other; a sentence with places for values may be one, which ``format`` fills. What else is
    made of it is a plain text, without identifier.
    """

    __slots__ = ("identifier",)
    identifier: str

    def __new__(cls, identifier: str, words: str) -> Message:
        """A text of a kind."""
        message = super().__new__(cls, words)
        message.identifier = identifier
        return message

    def __getnewargs__(self) -> tuple[str, str]:  # type: ignore[override]  # of a text: its words alone
        return self.identifier, self.words

    @property
    def words(self) -> str:
        """The text alone."""
        return str.__str__(self)

    def format(self, *values: object, **named: object) -> Message:
        """The same kind of message with values in its places."""
        return Message(self.identifier, str.format(self, *values, **named))

    def around(self, *, before: str = "", after: str = "") -> Message:
        """The same kind of message with more words."""
        return Message(self.identifier, f"{before}{self}{after}")


class Refusal(Exception):  # noqa: N818 - an answer, not a defect
    """What a part of the program says no to; whoever knows the place makes a :class:`Fault` of its message."""

    def __init__(self, identifier: str, words: str) -> None:
        self.message = Message(identifier, words)
        super().__init__(identifier, words)

    def __str__(self) -> str:
        return self.message.words


class ValueRefused(Refusal, ValueError):  # noqa: N818 - an answer, not a defect
    """A value that is not among those allowed there."""


class MblaError(Exception):
    """Root of the tree; ``exit_status`` is what the command line returns.

    identifier : of its kind
    words      : what is wrong and what is allowed, a line or several
    """

    exit_status = 1

    def __init__(self, identifier: str, words: str) -> None:
        self.identifier = identifier
        self.message = Message(identifier, words)
        super().__init__(identifier, words)

    def __str__(self) -> str:
        return self.message.words


class UsageError(MblaError):
    """The command line asks for something that does not exist."""

    exit_status = 2


class SolverError(MblaError):
    """The cone solver refused or broke on a program that was handed to it."""

    exit_status = 4


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
    message: Message
    value: str | None = None

    @property
    def identifier(self) -> str:
        """Of its kind."""
        return self.message.identifier

    def line(self) -> str:
        """As it is printed: with the identifier in brackets behind it."""
        return f"{self}  [{self.identifier}]"

    def __post_init__(self) -> None:
        if not isinstance(self.message, Message):
            raise TypeError(f"a fault takes a Message, which has an identifier, not {self.message!r}")

    def __str__(self) -> str:
        subject = self.key if self.value is None else f"{self.key} = {self.value}"
        return printable(f"{self.place} {subject}: {self.message}" if subject else f"{self.place} {self.message}")


class Finding(tuple[KeyPath, Message]):
    """What a check of a part of a deck finds wrong: the key path below that part, and the message."""

    __slots__ = ()

    def __new__(cls, identifier: str, words: str, *path: str | int) -> Finding:
        """A message of a kind about the value at a path, about the part itself without one."""
        return super().__new__(cls, (path, Message(identifier, words)))

    def below(self, *path: str | int) -> Finding:
        """The same seen from further up."""
        return Finding(self[1].identifier, self[1].words, *path, *self[0])


MOST_FAULTS = 1000
"""of one kind that are reported; a file that has more is not corrected fault by fault"""


def first_faults(faults: Iterable[Fault]) -> list[Fault]:
    """The first of many faults, and where the others are left out a last one that says so."""
    listed = list(islice(faults, MOST_FAULTS + 1))
    if len(listed) > MOST_FAULTS:
        words = f"more faults follow: only the first {MOST_FAULTS} are listed"
        listed[-1] = Fault(listed[-1].place, "", Message("more-faults", words))
    return listed


class DeckError(MblaError):
    """The deck is not valid; ``faults`` lists everything found wrong with it, in file order."""

    exit_status = 3

    def __init__(self, faults: Sequence[Fault]) -> None:
        self.faults = tuple(sorted(faults, key=lambda f: (f.place.file, f.place.line, f.place.column)))
        super().__init__("deck-invalid", "\n".join(str(fault) for fault in self.faults))

    def __reduce__(self) -> tuple[type[DeckError], tuple[tuple[Fault, ...]]]:
        return type(self), (self.faults,)  # what it was made of: a process hands it on with its places


@dataclass(frozen=True)
class Notice:
    """A remark that does not stop the run; ``identifier`` is stable and in kebab case (``faces-turned-outwards``).

    case : load case that it is about; empty where it is about the entire run
    """

    severity: Literal["notice", "warning"]
    identifier: str
    message: str
    case: str = ""

    def __str__(self) -> str:
        return printable(f"{self.severity} [{self.identifier}]: {self.message}")


def printable(text: str) -> str:
    """A text with nothing in it that a terminal acts on: names and content of files come from anywhere.

    >>> printable("stone" + chr(27) + ".obj")
    'stone�.obj'
    """
    if text.isprintable():
        return text
    return "".join(character if character.isprintable() else "\ufffd" for character in text)
