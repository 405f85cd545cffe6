"""What the full checks counted: a file each in ``counts/``, with date, version and machine."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from pathlib import Path

from mbla import __version__
from tests.performance.recording import machine

COUNTS = Path(__file__).parent / "counts"


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
