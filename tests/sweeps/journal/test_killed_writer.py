"""A writer killed at any moment loses no row that it reported, and leaves none that is torn."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from pathlib import Path
from random import Random

import pytest

from mbla.sweeps.journal import open_journal, read_journal
from tests.sweeps.journal.forked import forked
from tests.sweeps.journal.points import HEADER, as_read, point

pytestmark = pytest.mark.long


KILLS = 50
IN_PIECES, AT_ONCE = 41, 10**9
"""bytes of a write; a kill hardly ever divides a row that is one write"""
PAUSE = 5e-5
"""seconds after each piece, so that most kills find a row half written"""
LONGEST_WAIT = 1e-3
"""seconds from a reported row to the kill"""
POINTS = [point(number) for number in range(1, 301)]
EXPECTED = {task.key: as_read(outcome) for task, outcome in POINTS}


def write_on(path: Path, piece: int) -> Callable[[Callable[[str], None]], None]:
    """A run that goes on with the journal, in writes of at most ``piece`` bytes as of a nearly full disk."""

    def work(report: Callable[[str], None]) -> None:
        write = os.write

        def slow(descriptor: int, row: memoryview) -> int:
            time.sleep(PAUSE if piece == IN_PIECES else 0.0)
            return write(descriptor, row[:piece])

        os.write = slow  # type: ignore[assignment]
        with open_journal(path, HEADER, resume=True, force=False) as journal:
            report(str(len(journal.finished)))
            for task, outcome in POINTS:
                if task.key not in journal.finished:
                    journal.add(task, outcome)
                    report(task.key)

    return work


def test_fifty_kills(tmp_path: Path) -> None:
    path, draw = tmp_path / "journal.csv", Random(1)
    reported: set[str] = set()
    torn = 0
    for kill in range(KILLS):
        with forked(write_on(path, IN_PIECES if kill % 2 else AT_ONCE)) as child:
            assert int(child.line()) >= len(reported)
            reported.update(child.line() for _ in range(draw.randrange(5)))
            time.sleep(draw.random() * LONGEST_WAIT)
            child.kill()
            reported.update(child.lines())
        rows = read_journal(path, HEADER)
        assert reported <= rows.finished.keys()
        assert rows.finished.items() <= EXPECTED.items()
        assert len(rows.finished) < len(POINTS)  # the kill found it at work
        torn += rows.torn > 0
    assert torn > KILLS // 10
    with forked(write_on(path, AT_ONCE)) as child:
        child.lines()
    rows = read_journal(path, HEADER)
    assert (rows.finished, rows.torn) == (EXPECTED, 0)
    keys = [line.split(b",")[0] for line in path.read_bytes().splitlines()[2:]]
    assert len(keys) == len(set(keys)) == len(POINTS)  # no point was begun again that was in the journal
