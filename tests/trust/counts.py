"""What the full checks counted: a file each in ``counts/``, and the table of README.md written from these alone.

::

    python -m tests.trust.counts
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from pathlib import Path

from mbla import __version__
from tests.performance.recording import machine

COUNTS = Path(__file__).parent / "counts"
README = Path(__file__).with_name("README.md")
BEGIN, END = "<!-- trust:begin -->\n", "<!-- trust:end -->\n"


@dataclass(frozen=True)
class Record:
    """The counts of one check.

    check  : its name, that of the file
    order  : place in the table
    claim  : what is claimed, one sentence without a full stop
    counts : numbers by what they count, in the order of the table
    """

    check: str
    order: int
    claim: str
    counts: Mapping[str, int]
    date: str
    version: str
    machine: str


def record_counts(check: str, order: int, claim: str, counts: Mapping[str, int]) -> Record:
    """Keep what a full check counted, in place of what it counted before."""
    today = datetime.now(UTC).date().isoformat()
    record = Record(check, order, claim, dict(counts), today, __version__, machine())
    COUNTS.mkdir(exist_ok=True)
    (COUNTS / f"{check}.json").write_text(json.dumps(asdict(record), indent=2) + "\n", encoding="utf-8")
    return record


def recorded() -> list[Record]:
    """All records in the order of the table."""
    texts = [path.read_text(encoding="utf-8") for path in sorted(COUNTS.glob("*.json"))]
    return sorted((Record(**json.loads(text)) for text in texts), key=lambda record: (record.order, record.check))


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
