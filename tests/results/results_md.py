"""The tables of schemas/results.md, read as a reader of the page would."""

from __future__ import annotations

import re
from pathlib import Path

PAGE = Path(__file__).parents[2] / "schemas" / "results.md"

Row = tuple[str, ...]


def section(title: str) -> str:
    """The text under a heading of any level, up to the next heading of that level or above."""
    lines = PAGE.read_text(encoding="utf-8").splitlines()
    first = next(row for row, line in enumerate(lines) if re.fullmatch(rf"#+ {re.escape(title)}", line))
    level = len(lines[first].split(" ")[0])
    ends = (row for row in range(first + 1, len(lines)) if re.match(rf"#{{1,{level}}} ", lines[row]))
    return "\n".join(lines[first + 1 : next(ends, len(lines))])


def tables(title: str) -> list[list[Row]]:
    """Rows of every table under a heading, without its head; names without their quotes."""
    blocks = re.findall(r"(?m)^\|.*\|\n\|[-|]+\|\n((?:\|.*\|(?:\n|$))+)", section(title))
    return [[cells(line) for line in block.splitlines()] for block in blocks]


def table(title: str) -> list[Row]:
    """Rows of the only table under a heading."""
    (only,) = tables(title)
    return only


def cells(line: str) -> Row:
    """Cells of a row; one that is nothing but a name in quotes as that name."""
    return tuple(re.sub(r"^`([^`]*)`$", r"\1", cell.strip()) for cell in line.strip("|").split(" | "))
