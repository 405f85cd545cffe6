"""Tables of text (CSV) that a deck names: a header line with the names of the columns, then one row per line.

Columns are separated by commas; or by semicolons, and then numbers may have decimal commas, as spreadsheets write them
in some countries. Empty lines and lines that begin with # are passed over. Every fault is reported with file and line.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.deck.suggestions import did_you_mean, listed
from mbla.errors import Finding, Message

MOST_FAULTS = 10
"""faults of one table that are reported one by one"""


class TableRefused(Exception):  # noqa: N818 - an answer, not a defect
    """The table cannot be used; ``faults`` has a sentence with file and line for each reason."""

    def __init__(self, *faults: Message) -> None:
        listed = faults[:MOST_FAULTS]
        if len(faults) > MOST_FAULTS:
            listed = (*listed, Message("more-faults", f"{len(faults) - MOST_FAULTS} more faults of this table"))
        self.faults = listed
        super().__init__("; ".join(listed))

    def findings(self, *path: str | int) -> list[Finding]:
        """The faults at the key that names the file."""
        return [Finding(fault.identifier, fault.words, *path) for fault in self.faults]


@dataclass(frozen=True)
class CsvTable:
    """Rows of a table as texts.

    columns : texts by name, (n,) each; missing optional columns are not there
    rest    : what a row has beyond the named columns, where the table may have that
    lines   : (n,) numbers of lines, from 1
    faults  : what was found wrong with its rows so far
    """

    file: str
    columns: dict[str, list[str]]
    rest: list[list[str]]
    lines: list[int]
    decimal_comma: bool
    faults: list[Message] = field(default_factory=list)

    def __len__(self) -> int:
        return len(self.lines)

    def refuse(self, row: int, words: str) -> None:
        """Something is wrong with a row."""
        self.faults.append(Message("table-row", f"{self.file}:{self.lines[row]}: {words}"))

    def check(self) -> None:
        """Raises TableRefused where something is wrong with a row."""
        if self.faults:
            raise TableRefused(*self.faults)

    def numbers(self, names: Sequence[str]) -> FloatArray:
        """Columns as numbers, (n, k); what is no finite number is among the faults and left at zero."""
        values = np.zeros((len(self), len(names)))
        for column, name in enumerate(names):
            for row, text in enumerate(self.columns[name]):
                number = finite_number(text, self.decimal_comma)
                if number is None:
                    words = f"{self.file}:{self.lines[row]}: {name} = {text or '(empty)'}: must be a finite number"
                    self.faults.append(Message("table-number", words))
                else:
                    values[row, column] = number
        return values

    def place_in(self, column: str, row: int, known: IntArray, otherwise: str) -> int | None:
        """Which of some blocks, (n,), the number in a column means; None, and a fault, where there is none.

        otherwise : ends the message, after the name of the group
        """
        text = self.columns[column][row]
        if text.isdecimal() and int(text) < len(known):
            return int(known[int(text)])
        self.refuse(row, f"{column} = {text or '(empty)'}: {otherwise}")
        return None


def read_table(
    path: Path, required: Sequence[str], optional: Sequence[str] = (), *, with_rest: bool = False
) -> CsvTable:
    """The table of a file; columns may stand in any order.

    with_rest : rows go on after the required columns, which then come first and in order, with a number of columns of
                their own

    Raises TableRefused for files that cannot be read, headers that lack or misspell a column, and rows that do not fit
    the header.
    """
    name, text = path.name, text_of(path)
    try:
        (line, header), *rows = _rows(text)
    except csv.Error as error:
        raise _unreadable(f"{name}:{error}") from error
    except ValueError:
        words = f"{name}: is empty: its first line must name the columns {listed(required, 'and')}"
        raise _unreadable(words) from None
    header = [each.lower() for each in header]
    faults = _header_faults(header, required, optional, with_rest)
    known = list(required) if with_rest else [each for each in header if each]
    faults = [f"{name}:{line}: {fault}" for fault in faults] or [
        f"{name}:{number}: {fault}" for number, row in rows if (fault := _misfit(row, known, with_rest))
    ]
    if faults:
        raise TableRefused(*(Message("table-columns", fault) for fault in faults))
    if not rows:
        raise _unreadable(f"{name}: has no rows below its header")
    columns = {each: [row[place] for _, row in rows] for place, each in enumerate(known)}
    rest = [[text for text in row[len(known) :] if text] for _, row in rows] if with_rest else []
    return CsvTable(name, columns, rest, [number for number, _ in rows], _separator(text) == ";")


def text_of(path: Path) -> str:
    """Text of a file; raises TableRefused where it cannot be read."""
    try:
        return path.read_bytes().decode("utf-8-sig")
    except OSError as error:
        raise _unreadable(f"{path.name}: cannot be read: {error.strerror or error}") from error
    except UnicodeDecodeError as error:
        raise _unreadable(f"{path.name}: is not UTF-8 text: save it as CSV UTF-8") from error


def _unreadable(words: str) -> TableRefused:
    return TableRefused(Message("table-unreadable", words))


def _counts(line: str) -> bool:
    """Whether a line says anything."""
    return bool(line.strip(" \t,;")) and not line.lstrip().startswith("#")


def _separator(text: str) -> str:
    """Of columns, by the first line."""
    return ";" if ";" in next(filter(_counts, text.splitlines()), "") else ","


def _rows(text: str) -> list[tuple[int, list[str]]]:
    """Rows with the numbers of their lines; quoted texts may hold separators, but no line breaks."""
    rows, separator = [], _separator(text)
    for number, line in enumerate(text.splitlines(), start=1):
        if _counts(line):
            try:
                fields = next(csv.reader([line], delimiter=separator, strict=True))
            except csv.Error as error:
                raise csv.Error(f"{number}: cannot be read: {error}") from error
            rows.append((number, [field.strip() for field in fields]))
    return rows


def _header_faults(header: list[str], required: Sequence[str], optional: Sequence[str], with_rest: bool) -> list[str]:
    if with_rest:
        given, wanted = ",".join(header[: len(required)]), ",".join(required)
        return [] if given == wanted else [f"the header must begin with {wanted}, not {given}"]
    allowed = [*required, *optional]
    faults = [
        f"unknown column {each}{did_you_mean(each, allowed) or ';'} columns are {listed(allowed, 'and')}"
        for each in header
        if each and each not in allowed
    ]
    faults += [f"column {each} is missing" for each in required if each not in header]
    return faults + [f"column {each} is there twice" for each in allowed if header.count(each) > 1]


def _misfit(row: list[str], known: Sequence[str], with_rest: bool) -> str:
    """What is wrong with the number of columns of a row."""
    if len(row) < len(known):
        return f"has {len(row)} columns instead of {len(known)} ({', '.join(known)})"
    more = not with_rest and any(row[len(known) :])
    return f"has more columns than the header ({', '.join(known)})" if more else ""


def finite_number(text: str, decimal_comma: bool) -> float | None:
    """The finite number that a text is; None where it is none."""
    plain = text.replace(",", ".", 1) if decimal_comma else text
    try:
        value = math.nan if "_" in plain else float(plain)  # Python would read 1_000
    except ValueError:
        return None
    return value if math.isfinite(value) else None
