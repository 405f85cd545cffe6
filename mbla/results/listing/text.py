"""Fixed-width text: sections, wrapped sentences, name-value lines and tables, none wider than a listing may be.

A printed line is a :class:`Line`: text that knows the heading, sentence, entry or table it is a line of. The listing
joins lines; the report asks for their elements. Neither can say what the other does not.

Every line knows what it is a line of (:mod:`mbla.results.listing.text`): the report is made from the same lines.
"""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np


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


# --- Fixed-width text -----------------------------------------------------------------------------------------------


WIDTH = 100
INDENT = "  "
MOST_ROWS = 20
"""of a table; the result files hold all of them"""


def heading(text: str) -> list[str]:
    """A section title with a rule under it, and an empty line before it."""
    element = Heading(text)
    return ["", Line(text, element), Line("-" * min(len(text), WIDTH), element)]


def sentence(text: str, indent: str = INDENT) -> list[str]:
    """Text broken at WIDTH; line breaks and runs of spaces in it count as single spaces."""
    words = " ".join(text.split())
    element = Sentence(words, detail=len(indent) > len(INDENT))
    lines = textwrap.wrap(words, WIDTH, initial_indent=indent, subsequent_indent=indent + INDENT)
    return [Line(line, element) for line in lines]


def full_sentence(text: str) -> str:
    """With a capital and a full stop; a first word that is a name of something keeps its small letter."""
    if not text:
        return ""
    stop = "" if text.endswith((".", ":")) else "."
    first = text.split()[0].rstrip(",;:")
    return (text[0].upper() + text[1:] if first.isalpha() else text) + stop


def entry(name: str, value: str) -> list[str]:
    """``name   value`` with the values in one column, wrapped inside it; below a name that reaches into the column."""
    column = 34
    label = f"{INDENT}{name}"
    if len(label) + 1 < column:
        lead = f"{label:<{column}}"
        lines = textwrap.wrap(value, WIDTH, initial_indent=lead, subsequent_indent=" " * column) or [lead.rstrip()]
    else:
        lines = [label, *textwrap.wrap(value, WIDTH, initial_indent=" " * column, subsequent_indent=" " * column)]
    element = Entry(name, value)
    return [Line(line, element) for line in lines]


def table(head: Sequence[str], rows: Iterable[Sequence[str]], left: int = 1) -> list[str]:
    """Columns as wide as they need; the first ``left`` to the left, the others to the right.

    Where a table would be too wide, the first column is shortened in its middle.
    """
    lines = [list(head), *(list(row) for row in rows)]
    widths = [max(len(line[i]) for line in lines) for i in range(len(head))]
    excess = len(INDENT) + sum(widths) + 2 * (len(widths) - 1) - WIDTH
    if excess > 0:
        widths[0] = max(8, widths[0] - excess)
    element = Table(tuple(lines[0]), tuple(tuple(line) for line in lines[1:]), left)
    return [Line(_row(line, widths, left), element) for line in lines]


def long_table(head: Sequence[str], rows: Sequence[Sequence[str]], total: int, left: int = 1) -> list[str]:
    """A table after an empty line, and below it how many of ``total`` rows are left out; nothing without rows."""
    if not rows:
        return []
    more = sentence(f"and {total - len(rows)} more; the result files hold them all") if total > len(rows) else []
    return ["", *table(head, rows, left), *more]


def _row(cells: Sequence[str], widths: Sequence[int], left: int) -> str:
    shown = [shortened(cell, width) for cell, width in zip(cells, widths, strict=True)]
    aligned = [
        f"{cell:<{width}}" if i < left else f"{cell:>{width}}"
        for i, (cell, width) in enumerate(zip(shown, widths, strict=True))
    ]
    return (INDENT + "  ".join(aligned)).rstrip()


def shortened(text: str, width: int) -> str:
    """Text with its middle left out if it is longer than ``width``."""
    if len(text) <= width:
        return text
    head = (width - 2) // 2
    return f"{text[:head]}..{text[len(text) - (width - 2 - head) :]}"


def number(value: float) -> str:
    """Six significant digits; ``-`` where there is no number."""
    return "-" if np.isnan(value) else f"{value + 0.0:.6g}"


def percent(share: float) -> str:
    """``12.3`` of a share of 0.123; ``-`` where there is none."""
    return "-" if np.isnan(share) else f"{round(100 * share, 1) + 0.0:.1f}"


def small(value: float) -> str:
    """A residual: two digits; ``-`` where there is none."""
    return "-" if np.isnan(value) else f"{value + 0.0:.1e}"


def vector(values: Iterable[float], size: float = 0.0) -> str:
    """``(x, y, z)``; components below 1e-9 of ``size`` are zero."""
    shown = [0.0 if abs(value) <= 1e-9 * size else float(value) for value in values]
    return "(" + ", ".join(f"{value + 0.0:.4g}" for value in shown) + ")"


def counted(count: int, word: str) -> str:
    """``1 hinge``, ``4 hinges``."""
    return f"{count} {word}" if count == 1 else f"{count} {word}s"
