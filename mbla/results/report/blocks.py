"""Lines of the words as blocks of a page: a sentence that ends in a colon becomes the caption of the table below it.

A detail below an entry joins its value.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TypeAlias

from mbla.results.listing.text import Element, Entry, Heading, Sentence, Table, elements_of


@dataclass(frozen=True)
class Title:
    """Title of a part of a section."""

    text: str
    kind: str = "title"


@dataclass(frozen=True)
class Paragraph:
    """Running text; ``detail`` where it belongs to what stands above it."""

    text: str
    detail: bool
    kind: str = "paragraph"


@dataclass(frozen=True)
class Entries:
    """Names and values."""

    rows: tuple[tuple[str, str], ...]
    kind: str = "entries"


@dataclass(frozen=True)
class DataTable:
    """A table; the first ``left`` columns are words, the others figures."""

    caption: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    left: int
    kind: str = "table"


Block: TypeAlias = Title | Paragraph | Entries | DataTable


def blocks_of(lines: Iterable[str]) -> list[Block]:
    """Blocks of lines in their order; nothing that the lines say is left out."""
    blocks: list[Block] = []
    for element in elements_of(lines):
        last = blocks[-1] if blocks else None
        if isinstance(element, Entry) and isinstance(last, Entries):
            blocks[-1] = Entries((*last.rows, _row(element)))
        elif isinstance(element, Sentence) and element.detail and isinstance(last, Entries):
            name, value = last.rows[-1]
            blocks[-1] = Entries((*last.rows[:-1], (name, f"{value}\n{element.text}")))
        elif isinstance(element, Table) and isinstance(last, Paragraph) and last.text.endswith(":"):
            blocks[-1] = DataTable(last.text[:-1], element.head, element.rows, element.left)
        else:
            blocks.append(_block(element))
    return blocks


def _block(element: Element) -> Block:
    if isinstance(element, Heading):
        return Title(element.text)
    if isinstance(element, Entry):
        return Entries((_row(element),))
    if isinstance(element, Table):
        return DataTable("", element.head, element.rows, element.left)
    return Paragraph(element.text, element.detail)


def _row(entry: Entry) -> tuple[str, str]:
    return entry.name.strip(), entry.value
