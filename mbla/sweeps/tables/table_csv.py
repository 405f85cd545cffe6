"""The table of a sweep as CSV."""

from __future__ import annotations

from mbla.results.tables.csv_file import csv_text
from mbla.sweeps.tables.sweep_table import SweepTable


def sweep_csv(table: SweepTable) -> str:
    """The text of sweep.csv: units in the header, a row for each point; see ``csv_text`` for the cells."""
    return csv_text([column.header for column in table.columns], table.values)
