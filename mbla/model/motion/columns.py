"""Columns of text with times and values (CSV), with headers of any kind.

Columns are separated by semicolons, and then numbers may have decimal commas; or by commas; or by blanks. Data begin
where the column of times first has a number; lines before are headers, and so are lines that begin with ``#`` or
``%``, anywhere. Every later line is a row of data. In a file without times the first column of values tells where.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.suggestions import did_you_mean, listed
from mbla.errors import Message
from mbla.model.motion.record import Record, checked, refused
from mbla.model.tables import TableRefused, finite_number, text_of
from mbla.model.wording import counted

COMMENTS = ("#", "%")
WIDE = re.compile(r"\t|\s{2,}")
"""between columns of a header whose names have blanks"""


@dataclass(frozen=True)
class _Line:
    """A line of a file that says something: its number from 1, and its text without the sign of a comment."""

    number: int
    text: str
    comment: bool

    @property
    def separator(self) -> str:
        """Of its columns; empty for blanks."""
        return next((sign for sign in ";," if sign in self.text), "")

    def fields(self, separator: str) -> list[str]:
        """Its columns."""
        parts = self.text.split(separator) if separator else self.text.split()
        return [part.strip().strip('"').strip() for part in parts]


def read_columns(path: Path, wanted: Sequence[str | int] | None, interval: float | None = None) -> Record:
    """Times and values of a file.

    wanted   : columns of the time and of the values, by name or by number from 1; None for the first two
    interval : of a file without times, s between one value and the next; ``wanted`` has columns of values alone then

    Raises TableRefused for files that cannot be read, columns that there are not, and what is no number.
    """
    name, lines = path.name, list(_lines(text_of(path)))
    if not any(not line.comment for line in lines):
        raise refused(f"{name}: is empty: it must have a row for each time")
    asked = ([1, 2] if interval is None else [1]) if wanted is None else wanted
    header, places = _places(name, lines, asked)
    below = [line for line in lines if not line.comment and line.number > header]
    separator = _separator(below, places[0])
    first = [row for row, line in enumerate(below) if _number(line, places[0], separator) is not None][:1]
    if not first:
        what = "time" if interval is None else "value"
        raise refused(f"{name}: no line has a number for its {what} in column {places[0] + 1}")
    data, texts = below[first[0] :], [line.fields(separator) for line in below[first[0] :]]
    widest = max(map(len, texts))
    if max(places) >= widest:
        raise refused(f"{name}:{data[0].number}: no column {max(places) + 1}: rows have {counted(widest, 'column')}")
    titles = [column if isinstance(column, str) else f"column {column}" for column in asked]
    numbers = _numbers(name, data, separator, dict(zip(titles, places, strict=True)))
    if interval is not None:
        numbers = np.column_stack([interval * np.arange(len(numbers)), numbers])
    return checked(path, numbers[:, 0], numbers[:, 1:], [line.number for line in data])


def _numbers(file: str, data: Sequence[_Line], separator: str, places: dict[str, int]) -> FloatArray:
    """Columns as numbers, (n, k); raises TableRefused for what is none."""
    numbers, faults = np.zeros((len(data), len(places))), list[Message]()
    for row, line in enumerate(data):
        fields = line.fields(separator)
        for column, (title, place) in enumerate(places.items()):
            text = fields[place] if place < len(fields) else ""
            number = finite_number(text, separator == ";")
            if number is None:
                words = f"{file}:{line.number}: {title} = {text or '(empty)'}: must be a finite number"
                faults.append(Message("table-number", words))
            else:
                numbers[row, column] = number
    if faults:
        raise TableRefused(*faults)
    return numbers


def _lines(text: str) -> list[_Line]:
    """Lines that are not empty."""
    found = []
    for number, line in enumerate(text.splitlines(), start=1):
        comment = line.lstrip().startswith(COMMENTS)
        text = line.strip().lstrip("".join(COMMENTS)).strip() if comment else line.strip()
        if text.strip(",;\t "):
            found.append(_Line(number, text, comment))
    return found


def _separator(lines: Sequence[_Line], time: int) -> str:
    """That with which a line first has a number in the column of times."""
    return next((line.separator for line in lines if _number(line, time, line.separator) is not None), ",")


def _number(line: _Line, column: int, separator: str) -> float | None:
    fields = line.fields(separator)
    return finite_number(fields[column], separator == ";") if column < len(fields) else None


def _places(file: str, lines: Sequence[_Line], asked: Sequence[str | int]) -> tuple[int, list[int]]:
    """Number of the line of the header, 0 without names, and the places of columns from 0."""
    names = [column.casefold() for column in asked if isinstance(column, str)]
    headers = [
        (line.number, fields)
        for line in lines
        for fields in (line.fields(line.separator), [part.strip() for part in WIDE.split(line.text)])
        if finite_number(line.fields(line.separator)[0], False) is None
    ]
    if not names:
        return 0, [int(column) - 1 for column in asked]
    if not headers:
        raise refused(f"{file}: has no header with names of columns: give their numbers, from 1")
    number, fields = max(headers, key=lambda header: len(set(names).intersection(map(str.casefold, header[1]))))
    known = [field.casefold() for field in fields]
    missing = next((name for name in names if name not in known), None)
    if missing is not None:
        hint = did_you_mean(missing, fields) or ";"
        raise refused(f"{file}:{number}: no column {missing}{hint} its header has {listed(fields, 'and')}")
    return number, [known.index(each.casefold()) if isinstance(each, str) else each - 1 for each in asked]
