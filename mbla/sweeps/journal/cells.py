r"""Cells of a journal: plain values as text that is read back to the same value of the same kind.

::

    nothing         an empty cell
    True, False     True, False
    whole number    digits
    number          the shortest text that is read back to the same bits, always with a full stop or an exponent
    text            in quotation marks, which are doubled inside; a backslash, a line break and other signs that do not
                    print are written as JSON does: \\ \n \u0000; a bracket or brace at the beginning is \[ or \{
    list, object    JSON in quotation marks

So every row is one line, a cell without quotation marks is never a text, and one with them that begins with a bracket
or a brace is a list or an object.
"""

from __future__ import annotations

import json
import re
from collections.abc import Sequence

from mbla.sweeps.plan import Plain

_UNPRINTED = re.compile(r"[\\\x00-\x1f\x7f-\x9f\u2028\u2029\ud800-\udfff]")
"""backslash, controls, line breaks of any kind, halves of surrogate pairs, which UTF-8 has no bytes for"""
_SHORT = {"\\": "\\\\", "\n": "\\n", "\r": "\\r", "\t": "\\t"}
_LONG = {short: sign for sign, short in _SHORT.items()} | {"\\[": "[", "\\{": "{"}
_ESCAPED = re.compile(r"\\(?:u[0-9a-f]{4}|.?)")
_CELL = re.compile(r'"((?:[^"]|"")*)"|([^",]*)')
_WHOLE = re.compile(r"-?[0-9]+")


def cell_of(value: Plain) -> str:
    """Text of one cell."""
    if value is None:
        return ""
    if isinstance(value, str):
        return quoted(_escaped(value))
    if isinstance(value, (bool, int, float)):
        return repr(value)
    return quoted(json.dumps(value))


def quoted(text: str) -> str:
    """A cell with this text as it stands."""
    return '"' + text.replace('"', '""') + '"'


def split_cells(line: str) -> list[tuple[str, bool]]:
    """Cells of a line, and whether they stood in quotation marks.

    Raises
    ------
    ValueError
        a quotation mark is not where one can be
    """
    cells: list[tuple[str, bool]] = []
    place = 0
    while True:
        match = _CELL.match(line, place)
        assert match is not None  # it matches no text at all
        in_marks = match[1] is not None
        cells.append((match[1].replace('""', '"') if in_marks else match[2], in_marks))
        place = match.end()
        if place == len(line):
            return cells
        if line[place] != ",":
            raise ValueError("a quotation mark is out of place")
        place += 1


def values_of_cells(cells: Sequence[tuple[str, bool]]) -> list[Plain]:
    """The values that ``cell_of`` was given.

    Raises
    ------
    ValueError
        a cell is nothing that ``cell_of`` writes
    """
    return [_value_of(text, in_marks) for text, in_marks in cells]


def _value_of(text: str, in_marks: bool) -> Plain:
    if in_marks and text[:1] in ("[", "{"):
        value: Plain = json.loads(text)
        return value
    if in_marks:
        return _ESCAPED.sub(lambda match: _sign(match[0]), text)
    if text == "":
        return None
    if text in ("True", "False"):
        return text == "True"
    return int(text) if _WHOLE.fullmatch(text) else float(text)


def _escaped(text: str) -> str:
    text = _UNPRINTED.sub(lambda match: _SHORT.get(match[0]) or f"\\u{ord(match[0]):04x}", text)
    return "\\" + text if text[:1] in ("[", "{") else text


def _sign(escaped: str) -> str:
    if len(escaped) > 2:
        return chr(int(escaped[2:], 16))
    if escaped not in _LONG:
        raise ValueError(f"{escaped} is no sign of a text")
    return _LONG[escaped]
