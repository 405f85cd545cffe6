"""What is said of one identifier."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Kind = Literal[
    "notice",
    "warning",
    "warning or notice",
    "status of a load case",
    "exit status",
    "verification",
    "figure",
    "mode",
    "standing",
    "error in a deck",
    "error",
]


@dataclass(frozen=True)
class Explanation:
    """One entry of ``mbla explain``.

    identifier : stable, in kebab case; what stands in brackets in listings and under ``identifier`` in JSON
    kind       : what carries it
    title      : one line
    meaning    : what it means for the load factor
    cause      : what brings it about
    remedy     : what to do
    example    : a message or a remedy as it looks; may be empty
    aliases    : other words by which the program prints it
    says       : parts of the messages by which a pasted message is recognised
    """

    identifier: str
    kind: Kind
    title: str
    meaning: str
    cause: str
    remedy: str
    example: str = ""
    aliases: tuple[str, ...] = ()
    says: tuple[str, ...] = ()
