"""The page shows the counts that were recorded, and each of them was made by a check that is there."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.trust.counts import README, Record, recorded, section, table

FOLDER = Path(__file__).parent


def test_the_readme_has_the_table_of_the_records() -> None:
    assert section(README.read_text(encoding="utf-8")) == table(), "python -m tests.trust.counts writes it"


@pytest.mark.parametrize("record", recorded(), ids=lambda record: record.check)
def test_each_record_is_of_a_check_that_is_there(record: Record) -> None:
    call = re.compile(rf'record_counts\(\s*"{record.check}"')
    calls = [path for path in FOLDER.rglob("*.py") if call.search(path.read_text("utf-8"))]
    assert len(calls) == 1, "the record of a check that is gone, or of several"
    assert record.counts
    assert all(number >= 0 for number in record.counts.values())
