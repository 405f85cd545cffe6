"""What lines of a listing are made of, kept with them, so that other formats are made from the same source.

A printed line is a :class:`Line`: text that knows the heading, sentence, entry or table it is a line of. The listing
joins lines; the report asks for their elements. Neither can say what the other does not.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TypeAlias


@dataclass(frozen=True, eq=False)
class Heading:
    """Title of a section."""

    text: str


@dataclass(frozen=True, eq=False)
class Sentence:
    """Running text; ``detail`` where it belongs to what stands above it."""

    text: str
    detail: bool = False


@dataclass(frozen=True, eq=False)
class Entry:
    """A name and its value."""

    name: str
    value: str


@dataclass(frozen=True, eq=False)
class Table:
    """Names of columns and rows of cells, whole; the first ``left`` columns are words, the others figures."""

    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    left: int


Element: TypeAlias = Heading | Sentence | Entry | Table


class Line(str):
    """One line of text with the element that it is a line of."""

    __slots__ = ("element",)
    element: Element

    def __new__(cls, text: str, element: Element) -> Line:
        """Text as printed, and what it is a line of."""
        line = super().__new__(cls, text)
        line.element = element
        return line


def elements_of(lines: Iterable[str]) -> list[Element]:
    """Elements of lines in their order, each once; a line of no element is a sentence, an empty one nothing."""
    found: list[Element] = []
    for line in lines:
        if isinstance(line, Line):
            if not found or found[-1] is not line.element:
                found.append(line.element)
        elif line.strip():
            found.append(Sentence(line.strip()))
    return found
