"""Fixed-width text: sections, wrapped sentences, name-value lines and tables, none wider than a listing may be.

A printed line is a :class:`Line`: text that knows the :class:`Block` it is a line of. The listing joins lines, the
report asks for their blocks: neither can say what the other does not.
"""

from __future__ import annotations

import math
import textwrap
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from mbla.questions.figures import significant


@dataclass(frozen=True)
class Block:
    """A part of a page.

    kind   : ``title``, ``paragraph``, ``entries`` (names and values) or ``table``
    text   : of a title or paragraph, caption of a table
    rows   : cells, not wrapped
    left   : columns of a table that are words; the others are figures
    detail : a paragraph belongs to what stands above it
    """

    kind: str
    text: str = ""
    rows: tuple[tuple[str, ...], ...] = ()
    head: tuple[str, ...] = ()
    left: int = 0
    detail: bool = False


class Line(str):
    """One line of text with the block that it is a line of."""

    __slots__ = ("block",)
    block: Block

    def __new__(cls, text: str, block: Block) -> Line:
        """Text as printed, and what it is a line of."""
        line = super().__new__(cls, text)
        line.block = block
        return line


# --- Fixed-width text -----------------------------------------------------------------------------------------------


WIDTH = 100
INDENT = "  "
MOST_ROWS = 20
"""of a table; the result files hold all of them"""


def heading(text: str) -> list[str]:
    """A section title with a rule under it, and an empty line before it."""
    block = Block("title", text)
    return ["", Line(text, block), Line("-" * min(len(text), WIDTH), block)]


def sentence(text: str, indent: str = INDENT) -> list[str]:
    """Text broken at WIDTH; line breaks and runs of spaces in it count as single spaces."""
    words = " ".join(text.split())
    block = Block("paragraph", words, detail=len(indent) > len(INDENT))
    lines = textwrap.wrap(words, WIDTH, initial_indent=indent, subsequent_indent=indent + INDENT)
    return [Line(line, block) for line in lines]


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
    block = Block("entries", rows=((name.strip(), value),))
    return [Line(line, block) for line in lines]


def table(head: Sequence[str], rows: Iterable[Sequence[str]], left: int = 1) -> list[str]:
    """Columns as wide as they need; the first ``left`` to the left, the others to the right.

    Where a table would be too wide, the first column is shortened in its middle.
    """
    lines = [list(head), *(list(row) for row in rows)]
    widths = [max(len(line[i]) for line in lines) for i in range(len(head))]
    excess = len(INDENT) + sum(widths) + 2 * (len(widths) - 1) - WIDTH
    if excess > 0:
        widths[0] = max(8, widths[0] - excess)
    block = Block("table", "", tuple(tuple(line) for line in lines[1:]), tuple(lines[0]), left)
    return [Line(_row(line, widths, left), block) for line in lines]


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
    return significant(value)


def within(value: float, error: float) -> str:
    """With the digits that an error leaves: ``0.65 (+- 0.05)``; six where that is less or not known."""
    if not 5e-7 * abs(value) < error < np.inf:
        return number(value)
    digits = max(-math.floor(math.log10(error)), 0)
    return f"{round(value, digits) + 0.0:.{digits}f} (+- {float(f'{error:.1g}'):g})"


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
