"""A sweep in words for the terminal: how far it is; then how many points, the range of each result, what failed."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mbla.results.listing.text import INDENT, counted, entry, number, sentence
from mbla.results.listing.text import table as text_table
from mbla.sweeps.answers import ALIKE, answers_of
from mbla.sweeps.plan import FAILED
from mbla.sweeps.tables.sweep_table import SweepColumn, SweepTable, as_text

MINUTE, HOUR = 60.0, 3600.0


@dataclass
class SweepProgress:
    """Count of finished points.

    total   : points to be solved in this run
    earlier : points that the journal had already
    seconds : since the first point was finished: before it, processes begin
    """

    total: int
    earlier: int = 0
    done: int = 0
    failed: int = 0
    seconds: float = 0.0
    _first: float = 0.0

    def add(self, failed: bool) -> None:
        """One more point is finished."""
        now = time.monotonic()
        self._first = self._first or now
        self.seconds = now - self._first
        self.done += 1
        self.failed += failed

    def words(self) -> str:
        """``312 of 1000 points, 2 failed, 29 s left``."""
        words = [f"{self.done} of {self.total} points"]
        if self.failed:
            words.append(f"{self.failed} failed")
        if self.seconds and self.done < self.total:
            words.append(f"{duration_words(self.seconds * (self.total - self.done) / (self.done - 1))} left")
        return ", ".join(words)


def duration_words(seconds: float) -> str:
    """``29 s``, ``4 min 10 s``, ``3 h 20 min``."""
    if seconds < MINUTE:
        return f"{max(int(seconds), 1)} s"
    if seconds < HOUR:
        return f"{int(seconds // MINUTE)} min {int(seconds % MINUTE)} s"
    return f"{int(seconds // HOUR)} h {int(seconds % HOUR // MINUTE)} min"


SHOWN = 5
"""failed points that are named one by one; the table has all of them"""
COUNTED = 8
"""different texts of a result that are counted one by one"""
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
    numeric = [column for column in columns if column.kind not in TEXTS]
    return lines + (_range_lines(table, numeric) if numeric else [])


def _range_cells(table: SweepTable, column: SweepColumn) -> tuple[list[str], list[int]]:
    """Least and greatest verified value of a result with their points, points without one; rows of these points.

    Where all values are the same as far as they are shown, which is the least is a matter of the solver's last digits.
    """
    answers = answers_of(table, column)
    known = np.flatnonzero(answers.good)
    without = str(len(table) - known.size)
    if not known.size:
        return [column.header, "-", "-", "-", "-", without], []
    values = answers.values[known]
    ends = float(values.min()), float(values.max())
    near = [np.abs(values - end) <= ALIKE * abs(end) for end in ends]
    alike = known.size > 1 and bool(near[0].all())
    rows = [] if alike else [int(known[np.argmax(own)]) for own in near]
    points = ["all", "all"] if alike else [str(table["point"][row]) for row in rows]
    return [column.header, number(ends[0]), points[0], number(ends[1]), points[1], without], rows


def _range_lines(table: SweepTable, columns: Sequence[SweepColumn]) -> list[str]:
    found = [_range_cells(table, column) for column in columns]
    head = ["result", "least", "point", "greatest", "point", "without"]
    lines = ["", *text_table(head, [cells for cells, _ in found])]
    for row in dict.fromkeys(row for _, rows in found for row in rows):
        lines += sentence(point_words(table, row))
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
