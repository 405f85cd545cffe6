"""Wherever a journal was cut, every whole row is read back and nothing else; a row that nobody finished is none."""

from __future__ import annotations

from pathlib import Path

import pytest

from mbla.errors import FileError
from mbla.sweeps.journal import Journal, header_bytes, read_journal, row_bytes
from tests.sweeps.journal.points import HEADER, as_read, point

HEAD = header_bytes(HEADER)
SHORT = [number for number in range(1, 60) if len(row_bytes(HEADER, *point(number))) < 260][:4]
POINTS = [point(number) for number in SHORT]
ROWS = [row_bytes(HEADER, *of_point) for of_point in POINTS]
ENDS = [len(HEAD) + sum(map(len, ROWS[:count])) for count in range(len(ROWS) + 1)]
WHOLE = HEAD + b"".join(ROWS)


def whole_rows(size: int) -> int:
    return sum(end <= size for end in ENDS) - 1


def check(path: Path, content: bytes, count: int) -> None:
    """The first rows are there and no others, reading changes nothing, and what is gone on with it ends whole."""
    path.write_bytes(content)
    expected = {task.key: as_read(outcome) for task, outcome in POINTS[:count]}
    rows = read_journal(path, HEADER)
    assert rows.finished == expected
    assert (rows.whole, rows.torn) == (ENDS[count], len(content) - ENDS[count])
    assert path.read_bytes() == content


def test_cut_at_every_byte(tmp_path: Path) -> None:
    for size in range(len(HEAD), len(WHOLE) + 1):
        check(tmp_path / "journal.csv", WHOLE[:size], whole_rows(size))


def test_bytes_that_had_not_reached_the_disk(tmp_path: Path) -> None:
    """After a loss of power a file can have its length but not yet its content: NUL bytes stand there."""
    for size in range(len(HEAD), len(WHOLE), 3):
        for zeros in (1, 5, 5000):
            check(tmp_path / "journal.csv", WHOLE[:size] + bytes(zeros), whole_rows(size))


def test_the_end_of_a_row_reached_the_disk_and_its_beginning_did_not(tmp_path: Path) -> None:
    last = ROWS[-1]
    for lost in range(1, len(last)):
        check(tmp_path / "journal.csv", WHOLE[: ENDS[-2]] + bytes(lost) + last[lost:], len(ROWS) - 1)


@pytest.mark.parametrize("size", [ENDS[2], ENDS[2] + 1, ENDS[3] - 1])
def test_what_is_gone_on_with_is_whole(tmp_path: Path, size: int) -> None:
    path = tmp_path / "journal.csv"
    path.write_bytes(WHOLE[:size])
    with Journal(path, HEADER, resume=True, force=False) as journal:
        assert len(journal.notices) == (size != ENDS[2])
        for of_point in POINTS[2:]:
            journal.add(*of_point)
    assert path.read_bytes() == WHOLE


def test_nul_bytes_before_the_last_row_are_told_not_cut_off(tmp_path: Path) -> None:
    path = tmp_path / "journal.csv"
    path.write_bytes(WHOLE[: ENDS[1] + 3] + bytes(5) + WHOLE[ENDS[1] + 8 :])
    with pytest.raises(FileError, match=rf"{path}:4: this row has NUL bytes"):
        read_journal(path, HEADER)
