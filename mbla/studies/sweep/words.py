"""A finished sweep in words for the terminal: how many points, the range of each result, what failed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from mbla.results.words.text import INDENT, counted, entry, number, sentence
from mbla.studies.sweep.outcome import FAILED
from mbla.studies.sweep.progress import duration_words
from mbla.studies.sweep.tables.sweep_table import SweepColumn, SweepTable

SHOWN = 5
"""failed points that are named one by one; the table has all of them"""
COUNTED = 8
"""different texts of a result that are counted one by one"""
DESIGN = ("parameter", "azimuth", "elevation")


def sweep_lines(record: Mapping[str, Any], table: SweepTable) -> list[str]:
    """Everything that the terminal shows of a finished sweep; ``record`` as of ``sweep_json``."""
    lines = [f"{record['sweep']}: {record['title'] or record['deck']}"]
    lines += entry("points", points_words(record))
    for column in table.of_role("result"):
        lines += result_lines(table, column)
    lines += list(failure_lines(table))
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


def result_lines(table: SweepTable, column: SweepColumn) -> list[str]:
    """Least and greatest value of a number with their points; how often each text is there."""
    values = table[column.name]
    if column.kind in ("text", "bool"):
        return entry(column.name, _counts_words(column, values))
    finite = np.ma.filled(np.ma.masked_invalid(np.ma.asarray(values, dtype=np.float64)), np.nan)
    known = np.flatnonzero(np.isfinite(finite))
    if not known.size:
        return entry(column.name, "no value")
    least, greatest = known[np.argmin(finite[known])], known[np.argmax(finite[known])]
    unit = f" {column.unit}" if column.unit else ""
    first, last = f"{number(finite[least])}{unit}", f"{number(finite[greatest])}{unit}"
    if known.size == 1:
        words = f"{first} ({point_words(table, int(least))})"
    elif first == last:  # which of them is the least is then a matter of the last digits of the solver
        words = f"{first} at {'all' if known.size == len(table) else 'each of'} {counted(known.size, 'point')}"
    else:
        words = f"{first} ({point_words(table, int(least))}) to {last} ({point_words(table, int(greatest))})"
    missing = len(table) - known.size
    return entry(column.name, words + (f"; {counted(missing, 'point')} without" if missing else ""))


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
        shown = number(float(value)) if column.kind == "float" else str(value)
        words.append(f"{column.name} {shown}" + (f" {column.unit}" if column.unit else ""))
    return f"point {table['point'][row]}: {', '.join(words)}"


def failure_lines(table: SweepTable) -> Iterator[str]:
    """The first points that failed, each with its reason; how many others."""
    rows = [row for row, state in enumerate(table["state"].tolist()) if state == FAILED]
    for row in rows[:SHOWN]:
        yield from sentence(f"failed: {point_words(table, row)}: {table['reason'][row] or 'no reason known'}")
    if len(rows) > SHOWN:
        yield f"{INDENT}and {counted(len(rows) - SHOWN, 'other failed point')}; column reason of sweep.csv has why"
