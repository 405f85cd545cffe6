"""What results say, as sections of blocks: made once, and rendered as fixed-width text (``text``) and in the report."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import ClassVar, TypeAlias

MOST_ROWS = 20
"""of a table; the result files hold all of them"""


@dataclass(frozen=True)
class Gap:
    """An empty line of text; nothing in a report."""

    kind: ClassVar[str] = "gap"


@dataclass(frozen=True)
class Paragraph:
    """A sentence or several.

    detail : it belongs to what stands above it
    flush  : as text it begins at the margin
    """

    text: str
    detail: bool = False
    flush: bool = False
    kind: ClassVar[str] = "paragraph"


@dataclass(frozen=True)
class Fact:
    """A value under its name, with sentences on it."""

    name: str
    value: str
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Facts:
    """Names and values, under a caption or none."""

    rows: tuple[Fact, ...]
    caption: str = ""
    kind: ClassVar[str] = "facts"


@dataclass(frozen=True)
class WordTable:
    """A table of cells in words.

    left     : columns that are words, and stand to the left; the others are figures
    caption  : without a stop
    left_out : rows that only the result files hold
    flush    : as text its caption begins at the margin
    """

    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    left: int = 1
    caption: str = ""
    left_out: int = 0
    flush: bool = False
    kind: ClassVar[str] = "table"


Block: TypeAlias = Gap | Paragraph | Facts | WordTable
GAP = Gap()


@dataclass(frozen=True)
class ListingSection:
    """Blocks on one subject."""

    title: str
    blocks: list[Block]


def paragraphs(*texts: str, detail: bool = False) -> list[Block]:
    """A paragraph for each text that is not empty."""
    return [Paragraph(text, detail) for text in texts if text]


def facts(rows: Iterable[Fact], caption: str = "") -> list[Block]:
    """Names and values; nothing without any."""
    chosen = tuple(rows)
    return [Facts(chosen, caption)] if chosen else []


def table_of(
    head: Sequence[str],
    rows: Iterable[Sequence[str]],
    left: int = 1,
    *,
    caption: str = "",
    total: int = 0,
    flush: bool = False,
) -> list[Block]:
    """A table of some of ``total`` rows, or of all; nothing without rows."""
    cells = tuple(map(tuple, rows))
    return [WordTable(tuple(head), cells, left, caption, max(total - len(cells), 0), flush)] if cells else []


def apart(blocks: list[Block]) -> list[Block]:
    """Blocks after an empty line; nothing where there are none."""
    return [GAP, *blocks] if blocks else []
