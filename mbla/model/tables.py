"""Tables of text (CSV) that a deck names: a header line with the names of the columns, then one row per line.

Columns are separated by commas; or by semicolons, and then numbers may have decimal commas, as spreadsheets write them
in some countries. Empty lines and lines that begin with # are passed over. Every fault is told with file and line.
"""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.suggestions import did_you_mean, listed
from mbla.errors import Message

MOST_FAULTS = 10
"""faults of one table that are told one by one"""


class TableRefused(Exception):  # noqa: N818 - an answer, not a defect
    """The table cannot be used; ``faults`` has a sentence with file and line for each reason."""

    def __init__(self, faults: Sequence[Message]) -> None:
        told = list(faults[:MOST_FAULTS])
        if len(faults) > MOST_FAULTS:
            told.append(Message("more-faults", f"{len(faults) - MOST_FAULTS} more faults of this table"))
        self.faults = tuple(told)
        super().__init__("; ".join(told))


@dataclass(frozen=True)
class Table:
    """Rows of a table as texts.

    columns : texts by name, (n,) each; missing optional columns are not there
    rest    : what a row has beyond the named columns, where the table may have that
    lines   : (n,) numbers of lines, from 1
    """

    file: str
    columns: dict[str, list[str]]
    rest: list[list[str]]
    lines: list[int]
    decimal_comma: bool

    def __len__(self) -> int:
        return len(self.lines)

    def place(self, row: int) -> str:
        """``stones.csv:7``."""
        return f"{self.file}:{self.lines[row]}"

    def numbers(self, names: Sequence[str], faults: list[Message]) -> FloatArray:
        """Columns as numbers, (n, k); what is no finite number is told in ``faults`` and left at zero."""
        values = np.zeros((len(self), len(names)))
        for column, name in enumerate(names):
            for row, text in enumerate(self.columns[name]):
                number = _number(text, self.decimal_comma)
                if number is None:
                    faults.append(
                        Message(
                            "table-number", f"{self.place(row)}: {name} = {text or '(empty)'}: must be a finite number"
                        )
                    )
                else:
                    values[row, column] = number
        return values


def read_table(path: Path, required: Sequence[str], optional: Sequence[str] = (), *, with_rest: bool = False) -> Table:
    """The table of a file; columns may stand in any order.

    with_rest : rows go on after the required columns, which then come first and in order, with a number of columns of
                their own

    Raises
    ------
    TableRefused
        for files that cannot be read, headers that lack or misspell a column, and rows that do not fit the header
    """
    name = path.name
    try:
        text = path.read_bytes().decode("utf-8-sig")
    except OSError as error:
        raise TableRefused(
            [Message("table-unreadable", f"{name}: cannot be read: {error.strerror or error}")]
        ) from error
    except UnicodeDecodeError as error:
        raise TableRefused([Message("table-unreadable", f"{name}: is not UTF-8 text: save it as CSV UTF-8")]) from error
    semicolons = ";" in next((line for line in text.splitlines() if _counts(line)), "")
    rows = _rows(name, text, ";" if semicolons else ",")
    if not rows:
        raise TableRefused(
            [
                Message(
                    "table-unreadable",
                    f"{name}: is empty: its first line must name the columns {listed(required, 'and')}",
                )
            ]
        )
    (line, header), *rows = rows
    header = [each.lower() for each in header]
    if faults := _header_faults(name, line, header, required, optional, with_rest):
        raise TableRefused(faults)
    known = list(required) if with_rest else [each for each in header if each]
    faults = [fault for number, row in rows if (fault := _row_fault(name, number, row, known, with_rest))]
    if faults:
        raise TableRefused(faults)
    if not rows:
        raise TableRefused([Message("table-unreadable", f"{name}: has no rows below its header")])
    columns = {each: [row[place] for _, row in rows] for place, each in enumerate(known)}
    rest = [[text for text in row[len(known) :] if text] for _, row in rows] if with_rest else []
    return Table(name, columns, rest, [number for number, _ in rows], semicolons)


def _counts(line: str) -> bool:
    """Whether a line says anything."""
    return bool(line.strip(" \t,;")) and not line.lstrip().startswith("#")


def _rows(name: str, text: str, delimiter: str) -> list[tuple[int, list[str]]]:
    """Rows with the numbers of their lines; quoted texts may hold delimiters, but no line breaks."""
    rows = []
    for number, line in enumerate(text.splitlines(), start=1):
        if _counts(line):
            try:
                fields = next(csv.reader(io.StringIO(line), delimiter=delimiter, strict=True))
            except csv.Error as error:
                raise TableRefused(
                    [Message("table-unreadable", f"{name}:{number}: cannot be read: {error}")]
                ) from error
            rows.append((number, [field.strip() for field in fields]))
    return rows


def _header_faults(
    name: str, line: int, header: list[str], required: Sequence[str], optional: Sequence[str], with_rest: bool
) -> list[Message]:
    place = f"{name}:{line}"
    if with_rest:
        if header[: len(required)] == list(required):
            return []
        begins = f"{place}: the header must begin with {','.join(required)}, not {','.join(header[: len(required)])}"
        return [Message("table-columns", begins)]
    allowed = [*required, *optional]
    faults = [
        f"{place}: unknown column {each}{did_you_mean(each, allowed) or ';'} columns are {listed(allowed, 'and')}"
        for each in header
        if each and each not in allowed
    ]
    faults += [f"{place}: column {each} is missing" for each in required if each not in header]
    faults += [f"{place}: column {each} is there twice" for each in allowed if header.count(each) > 1]
    return [Message("table-columns", fault) for fault in faults]


def _row_fault(name: str, number: int, row: list[str], known: list[str], with_rest: bool) -> Message | None:
    if len(row) < len(known):
        return Message(
            "table-columns", f"{name}:{number}: has {len(row)} columns instead of {len(known)} ({', '.join(known)})"
        )
    if not with_rest and any(row[len(known) :]):
        return Message("table-columns", f"{name}:{number}: has more columns than the header ({', '.join(known)})")
    return None


def _number(text: str, decimal_comma: bool) -> float | None:
    plain = text.replace(",", ".", 1) if decimal_comma else text
    if "_" in plain:  # Python would read 1_000
        return None
    try:
        value = float(plain)
    except ValueError:
        return None
    return value if math.isfinite(value) else None
