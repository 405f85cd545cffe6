"""The table of counts in README.md beside this file, written from the records and from nothing else.

::

    python -m tests.trust.table
"""

from __future__ import annotations

from pathlib import Path

from tests.trust.counts import Record, recorded

README = Path(__file__).with_name("README.md")
BEGIN, END = "<!-- trust:begin -->\n", "<!-- trust:end -->\n"


def table() -> str:
    """The table, a line for each check."""
    lines = ["| claim | counted | on |", "|---|---|---|", *(_line(record) for record in recorded())]
    return "\n".join(lines) + "\n"


def _line(record: Record) -> str:
    counted = "; ".join(f"{number:,} {name}" for name, number in record.counts.items())
    return f"| {record.claim} | {counted} | {record.date} |"


def section(readme: str) -> str:
    """What stands between the marks of a README."""
    return readme.split(BEGIN, 1)[1].split(END, 1)[0]


def write() -> None:
    """Put the table in place of the one that is there."""
    text = README.read_text(encoding="utf-8")
    README.write_text(text.replace(BEGIN + section(text), BEGIN + table()), encoding="utf-8")


if __name__ == "__main__":
    write()
