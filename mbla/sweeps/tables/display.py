"""How the table of a sweep shows itself: as lines in a terminal, as a table in a notebook."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np

from mbla.results.listing.text import WIDTH, counted, number, table

if TYPE_CHECKING:
    from mbla.sweeps.design.design import SweepColumn
    from mbla.sweeps.tables.sweep_table import SweepTable

MOST_POINTS = 20
"""points that are shown; the table has all of them"""
LEFT_OUT = ("exit_code", "tries", "seconds")
"""roles of columns that are not shown: how points were solved"""


def sweep_lines(sweep: SweepTable) -> list[str]:
    """Title, first points, and what is not shown, as wide as a terminal."""
    columns = every = _columns(sweep)
    while max(map(len, lines := _lines(sweep, columns)), default=0) >= WIDTH and len(columns) > 1:
        columns = columns[:-1]
    others = [column.name for column, _ in every[len(columns) :]]
    return [_title(sweep), *lines, *_more(sweep), *([f"not shown: {', '.join(others)}"] if others else [])]


def sweep_html(sweep: SweepTable) -> str:
    """The same for a notebook, all columns."""
    columns = _columns(sweep)

    def row(cells: Sequence[str], tag: str) -> str:
        return f"<tr>{''.join(f'<{tag}>{escape(cell)}</{tag}>' for cell in cells)}</tr>"

    rows = row(_heads(columns), "th") + "".join(row(cells, "td") for cells in _rows(sweep, columns))
    more = "".join(f"<p>{escape(words)}</p>" for words in _more(sweep))
    return f"<div><strong>{escape(_title(sweep))}</strong><table>{rows}</table>{more}</div>"


def _title(sweep: SweepTable) -> str:
    return f"{sweep.title or 'sweep'}: {counted(len(sweep), 'point')}"


def _columns(sweep: SweepTable) -> list[tuple[SweepColumn, Any]]:
    """Columns that are shown, with their values; those without any value are left out."""
    both = zip(sweep.columns, sweep.values, strict=True)
    return [(column, cells) for column, cells in both if column.role not in LEFT_OUT and any(map(_cell, cells))]


def _heads(columns: Sequence[tuple[SweepColumn, Any]]) -> list[str]:
    return [column.header for column, _ in columns]


def _rows(sweep: SweepTable, columns: Sequence[tuple[SweepColumn, Any]]) -> list[list[str]]:
    return [[_cell(cells[point]) for _, cells in columns] for point in range(min(len(sweep), MOST_POINTS))]


def _lines(sweep: SweepTable, columns: Sequence[tuple[SweepColumn, Any]]) -> list[str]:
    return table(_heads(columns), _rows(sweep, columns), left=0)


def _more(sweep: SweepTable) -> list[str]:
    return [f"and {len(sweep) - MOST_POINTS} more points"] if len(sweep) > MOST_POINTS else []


def _cell(value: object) -> str:
    """A value as it is read; empty where there is none."""
    if value is None or value is np.ma.masked:
        return ""
    if isinstance(value, float | np.floating):
        return "" if np.isnan(value) else number(float(value))
    return str(value)
