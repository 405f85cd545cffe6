"""Blocks as fixed-width text: sections, wrapped sentences, name-value lines and tables, none wider than ``WIDTH``."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Iterable, Sequence

import numpy as np

from mbla.questions.figures import significant
from mbla.results.listing.blocks import Block, Facts, ListingSection, Paragraph, WordTable

WIDTH = 100
INDENT = "  "
DETAIL = 2 * INDENT


def text_of(lines: Iterable[str]) -> str:
    """Lines without blanks at their ends, with a newline at the end of each."""
    return "\n".join(line.rstrip() for line in lines) + "\n"


def section_lines(sections: Iterable[ListingSection]) -> list[str]:
    """Sections below each other, each under its title."""
    return [line for each in sections for line in (*heading(each.title), *lines_of(each.blocks))]


def lines_of(blocks: Iterable[Block]) -> list[str]:
    """Blocks below each other."""
    lines: list[str] = []
    for block in blocks:
        match block:
            case Paragraph():
                lines += sentence(block.text, DETAIL if block.detail else "" if block.flush else INDENT)
            case Facts():
                lines += _fact_lines(block)
            case WordTable():
                lines += _table_lines(block)
            case _:
                lines.append("")
    return lines


def _fact_lines(facts: Facts) -> list[str]:
    lines, indent = sentence(facts.caption), INDENT * bool(facts.caption)
    for fact in facts.rows:
        lines += entry(indent + fact.name, fact.value)
        lines += [line for note in fact.notes for line in sentence(note, DETAIL)]
    return lines


def _table_lines(block: WordTable) -> list[str]:
    caption = sentence(f"{block.caption}:", "" if block.flush else INDENT) if block.caption else []
    more = sentence(f"and {block.left_out} more; the result files hold them all") if block.left_out else []
    return [*caption, *table(block.head, block.rows, block.left), *more]


def heading(text: str) -> list[str]:
    """A section title with a rule under it, and an empty line before it."""
    return ["", text, "-" * min(len(text), WIDTH)]


def sentence(text: str, indent: str = INDENT) -> list[str]:
    """Text broken at WIDTH; line breaks and runs of spaces in it count as single spaces."""
    words = " ".join(text.split())
    return textwrap.wrap(words, WIDTH, initial_indent=indent, subsequent_indent=indent + INDENT)


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
        return textwrap.wrap(value, WIDTH, initial_indent=lead, subsequent_indent=" " * column) or [lead.rstrip()]
    return [label, *textwrap.wrap(value, WIDTH, initial_indent=" " * column, subsequent_indent=" " * column)]


def table(head: Sequence[str], rows: Iterable[Sequence[str]], left: int = 1) -> list[str]:
    """Columns as wide as they need; the first ``left`` to the left, the others to the right.

    Where a table would be too wide, the first column is shortened in its middle.
    """
    lines = [list(head), *(list(row) for row in rows)]
    widths = [max(len(line[i]) for line in lines) for i in range(len(head))]
    excess = len(INDENT) + sum(widths) + 2 * (len(widths) - 1) - WIDTH
    if excess > 0:
        widths[0] = max(8, widths[0] - excess)
    return [_row(line, widths, left) for line in lines]


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
