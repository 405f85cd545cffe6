"""A finished sweep in words for the terminal: how many points, the range of each result, what failed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.results.listing.text import INDENT, counted, entry, number, sentence
from mbla.results.listing.text import table as text_table
from mbla.sweeps.answers import ALIKE, answers_of
from mbla.sweeps.outcome import FAILED
from mbla.sweeps.progress import duration_words
from mbla.sweeps.tables.from_outcomes import as_text
from mbla.sweeps.tables.sweep_table import SweepColumn, SweepTable

SHOWN = 5
"""failed points that are named one by one; the table has all of them"""
COUNTED = 8
"""different texts of a result that are counted one by one"""
NAMED = 6
"""points with a least or greatest value whose parameters are told"""
TEXTS = ("text", "bool")
"""kinds of results that are counted; others have a least and a greatest value"""
DESIGN = ("parameter", "azimuth", "elevation")


def sweep_lines(record: Mapping[str, Any], table: SweepTable) -> list[str]:
    """Everything that the terminal shows of a finished sweep; ``record`` as of ``sweep_json``."""
    lines = [f"{record['sweep']}: {record['title'] or record['deck']}"]
    lines += entry("points", points_words(record))
    lines += result_lines(table)
    lines += failure_lines(table)
    for notice in record["notices"]:
        lines += sentence(f"{notice['severity']}: {notice['message']}")
    lines += entry("time", duration_words(record["time"]["total"]))
    return lines


def points_words(record: Mapping[str, Any]) -> str:
    """``1000: 998 done, 2 failed; constraints left out 24 more``."""
    points = record["points"]
    words = [f"{points['done']} done"]
    words += [f"{points[state]} {state}" for state in ("failed", "unfinished") if points[state]]
    left_out = f"; constraints left out {points['left_out']} more" if points["left_out"] else ""
    return f"{points['all']}: {', '.join(words)}{left_out}"


def result_lines(table: SweepTable) -> list[str]:
    """How often each text is there; a table of the least and greatest verified numbers, and their points."""
    columns = table.of_role("result")
    lines: list[str] = []
    for column in columns:
        if column.kind in TEXTS:
            lines += entry(column.name, _counts_words(column, table[column.name]))
    ranges = [_range_of(table, column) for column in columns if column.kind not in TEXTS]
    return lines + (_range_lines(table, ranges) if ranges else [])


@dataclass(frozen=True)
class Range:
    """Least and greatest verified value of a result, nan where no point has one.

    rows    : of the first points that have them, as far as can be told; none where all are alike
    without : points that have none
    alike   : all are the same as far as they are shown: which is the least is a matter of the solver's last digits
    """

    column: SweepColumn
    least: float
    greatest: float
    rows: tuple[int, ...]
    without: int
    alike: bool = False


def _range_of(table: SweepTable, column: SweepColumn) -> Range:
    answers = answers_of(table, column)
    known = np.flatnonzero(answers.good)
    if not known.size:
        return Range(column, np.nan, np.nan, (), len(table))
    values = answers.values[known]
    least, greatest = float(values.min()), float(values.max())
    alike = known.size > 1 and bool(_near(values, least).all())
    rows = () if alike else tuple(int(known[np.argmax(_near(values, end))]) for end in (least, greatest))
    return Range(column, least, greatest, rows, len(table) - known.size, alike)


def _near(values: FloatArray, end: float) -> BoolArray:
    """Those that cannot be told from an end of the range."""
    return np.abs(values - end) <= ALIKE * abs(end)


def _range_lines(table: SweepTable, ranges: Sequence[Range]) -> list[str]:
    missing = any(one.without for one in ranges)
    cells = []
    for one in ranges:
        at = [str(table["point"][row]) for row in one.rows] or (["all", "all"] if one.alike else ["-", "-"])
        shown = [one.column.header, number(one.least), at[0], number(one.greatest), at[1]]
        cells.append([*shown, *([str(one.without)] if missing else [])])
    head = ["result", "least", "point", "greatest", "point", *(["without"] if missing else [])]
    lines = ["", *text_table(head, cells)]
    named = list(dict.fromkeys(row for one in ranges for row in one.rows))
    for row in named[:NAMED]:
        lines += sentence(point_words(table, row))
    if len(named) > NAMED:
        lines += sentence(f"{counted(len(named) - NAMED, 'further point')}: see sweep.csv")
    return [*lines, ""]


def _counts_words(column: SweepColumn, values: Any) -> str:
    texts = [str(value) for value in np.ma.asarray(values).tolist() if value is not None and value != ""]
    common = Counter(texts).most_common()
    words = [f"{text} {count}" for text, count in common[:COUNTED]]
    if len(common) > COUNTED:
        words.append(f"{len(common) - COUNTED} others")
    return ", ".join(words) or "no value"


def point_words(table: SweepTable, row: int) -> str:
    """``point 12: mu 0.3, t 0.1 m``."""
    words = []
    for column in table.of_role(*DESIGN):
        value = table[column.name][row]
        shown = number(float(value)) if column.kind == "float" else as_text(value)
        words.append(f"{column.name} {shown}" + (f" {column.unit}" if column.unit else ""))
    return f"point {table['point'][row]}: {', '.join(words)}"


def failure_lines(table: SweepTable) -> Iterator[str]:
    """The first points that failed, each with its reason; how many others."""
    rows = [row for row, state in enumerate(table["state"].tolist()) if state == FAILED]
    for row in rows[:SHOWN]:
        yield from sentence(f"failed: {point_words(table, row)}: {table['reason'][row] or 'no reason known'}")
    if len(rows) > SHOWN:
        yield f"{INDENT}and {counted(len(rows) - SHOWN, 'other failed point')}; column reason of sweep.csv has why"
