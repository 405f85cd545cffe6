"""A journal holds every finished point once, to the bit, wherever it was cut; it says why it cannot be gone on with."""

from __future__ import annotations

from contextlib import AbstractContextManager
from dataclasses import replace
from pathlib import Path

import pandas as pd
import pytest

from mbla.errors import FileError, UsageError
from mbla.results.explanations import explanations
from mbla.sweeps.journal import Journal, JournalHeader, header_bytes, open_journal, read_journal, row_bytes
from mbla.sweeps.plan import DONE, FAILED
from tests.sweeps.journal.points import HEADER, as_read, other_header, point

POINTS = [point(number) for number in range(1, 31)]
EXPECTED = {task.key: as_read(outcome) for task, outcome in POINTS}


Opened = AbstractContextManager[Journal]


def begun(path: Path) -> Opened:
    return open_journal(path, HEADER, resume=False, force=False)


def gone_on(path: Path, header: JournalHeader = HEADER, *, retry_failed: bool = False) -> Opened:
    return open_journal(path, header, resume=True, force=False, retry_failed=retry_failed)


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """A journal of all points, in a folder that is made for it."""
    path = tmp_path / "new" / "arch.out" / "journal.csv"
    with begun(path) as journal:
        for task, outcome in POINTS:
            journal.add(task, outcome)
        assert journal.finished == EXPECTED
    assert [file.name for file in path.parent.iterdir()] == ["journal.csv"]
    return path


def refusal(path: Path, header: JournalHeader = HEADER) -> str:
    before = path.read_bytes()
    with pytest.raises(FileError) as refused, gone_on(path, header):
        pass
    assert path.read_bytes() == before
    return str(refused.value)


def test_every_value_is_read_back_to_the_bit_and_of_its_kind(path: Path) -> None:
    with gone_on(path) as journal:
        assert journal.finished == EXPECTED
        assert journal.notices == ()
        for key, outcome in journal.finished.items():
            assert repr(outcome.results) == repr(EXPECTED[key].results)  # True is not 1, 1.0 not 1
    assert {FAILED, DONE} == {outcome.state for outcome in EXPECTED.values()}


def test_pandas_reads_it(path: Path) -> None:
    table = pd.read_csv(path, comment="#", dtype={"key": str, "seconds": str})
    assert tuple(table.columns) == HEADER.all_columns
    assert list(table["key"]) == [task.key for task, _ in POINTS]
    assert list(table["number"]) == [task.number for task, _ in POINTS]
    assert list(table["seconds"]) == [repr(outcome.seconds) for _, outcome in POINTS]


def test_an_earlier_journal_is_refused_without_a_word_of_what_to_do_with_it(path: Path) -> None:
    before = path.read_bytes()
    with pytest.raises(FileError, match=r"journal\.csv: exists already; --resume continues it, --force starts over"):
        begun(path).__enter__()
    assert path.read_bytes() == before


def test_force_begins_anew(path: Path) -> None:
    with open_journal(path, HEADER, resume=False, force=True) as journal:
        assert journal.finished == {}
    assert path.read_bytes() == header_bytes(HEADER)


def test_to_go_on_and_to_begin_anew_is_no_choice(path: Path) -> None:
    before = path.read_bytes()
    with pytest.raises(UsageError, match="one of them"):
        open_journal(path, HEADER, resume=True, force=True).__enter__()
    assert path.read_bytes() == before


def test_to_go_on_where_nothing_is_begins(tmp_path: Path) -> None:
    with gone_on(tmp_path / "journal.csv") as journal:
        assert journal.finished == {}
        journal.add(*POINTS[0])
    assert list(read_journal(tmp_path / "journal.csv", HEADER).finished) == [POINTS[0][0].key]


@pytest.mark.parametrize(
    ("other", "words"),
    [
        (other_header(mbla="0.2.0+def"), "its mbla is 0.1.0+abc, here it is 0.2.0+def"),
        (other_header(base_deck="beef"), "its base deck is f00d, here it is beef"),
        (other_header(numpy="2.4.0"), "its numpy is 2.3.0, here it is 2.4.0"),
        (other_header(load_cases="lift"), "its load cases is push, here it is lift"),
        (
            replace(HEADER, columns={"gap": "float"}),
            'its results is status load_factor a,"b"# verified, here it is gap',
        ),
    ],
)
def test_a_journal_of_something_else_is_refused_and_told_why(path: Path, other: JournalHeader, words: str) -> None:
    assert f"{path}: of another sweep ({words}): it cannot be continued; --force starts" in refusal(path, other)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "is no journal of a sweep"),
        (b"key,number\n1,2\n", "is no journal of a sweep"),
        (b"# {\n", "is no journal of a sweep"),
        (b"# {\xff}\n", "is no journal of a sweep"),
        (b'# {"mbla_sweep_journal": 3}\n', "is no journal of a sweep"),
        (b'# {"mbla_sweep_journal": 1}\n', "is no journal of a sweep of format 3"),
        (header_bytes(HEADER).replace(b"reason", b"cause"), "is no journal of a sweep of format 3"),
    ],
)
def test_another_file_of_that_name_is_not_taken_for_a_journal(tmp_path: Path, content: bytes, words: str) -> None:
    path = tmp_path / "journal.csv"
    path.write_bytes(content)
    assert words in refusal(path)


@pytest.mark.parametrize(
    ("column", "text", "words"),
    [
        (2, "begun", "is no row of a journal: state 'begun'"),
        (3, "many", "invalid literal"),
        (8, "half", "could not convert"),
        (10, "maybe", "is no row of a journal: 'maybe'"),
        (None, "", "has another number of columns"),
    ],
)
def test_a_broken_row_is_told_with_its_line(path: Path, column: int | None, text: str, words: str) -> None:
    cells = ["key", "99", "failed", "4", "", "1", "0.5", "", "", "", "", "{}"]
    cells = cells[:-1] if column is None else [*cells[:column], text, *cells[column + 1 :]]
    lines = path.read_bytes().splitlines(keepends=True)
    broken = ",".join(cells).encode() + b"\n"
    path.write_bytes(b"".join([*lines[:3], broken, broken, *lines[3:]]))
    said = refusal(path)
    assert f"{path}:4: this row {words}" in said
    assert "or delete the line, so that its point is solved again" in said


def test_failed_points_are_begun_anew_on_request_and_their_last_row_counts(path: Path) -> None:
    failed = [(task, outcome) for task, outcome in POINTS if outcome.state == FAILED]
    with gone_on(path, retry_failed=True) as journal:
        assert journal.finished == {key: outcome for key, outcome in EXPECTED.items() if outcome.state == DONE}
        better = replace(failed[0][1], state=DONE, exit_code=0, reason="", results={"load_factor": 0.25}, tries=2)
        journal.add(failed[0][0], better)
        journal.add(failed[1][0], replace(failed[1][1], tries=2))
    with gone_on(path) as journal:
        assert journal.finished[better.key] == as_read(better)
        assert journal.finished[failed[1][0].key].tries == 2
        assert journal.finished.keys() == EXPECTED.keys()


def test_what_is_cut_off_is_told(path: Path) -> None:
    torn = row_bytes(HEADER, *point(99))[:-5]
    path.write_bytes(path.read_bytes() + torn)
    with gone_on(path) as journal:
        assert journal.finished == EXPECTED
        assert [notice.identifier for notice in journal.notices] == ["journal-repaired"]
        assert f"({len(torn)} bytes)" in journal.notices[0].message
        journal.add(*point(99))
    assert read_journal(path, HEADER).finished.keys() == {*EXPECTED, point(99)[0].key}
    assert "journal-repaired" in explanations()


HEAD = header_bytes(HEADER)
SHORT = [number for number in range(1, 60) if len(row_bytes(HEADER, *point(number))) < 260][:4]
SHORT_POINTS = [point(number) for number in SHORT]
ROWS = [row_bytes(HEADER, *of_point) for of_point in SHORT_POINTS]
ENDS = [len(HEAD) + sum(map(len, ROWS[:count])) for count in range(len(ROWS) + 1)]
WHOLE_FILE = HEAD + b"".join(ROWS)


def whole_rows(size: int) -> int:
    return sum(end <= size for end in ENDS) - 1


def check(path: Path, content: bytes, count: int) -> None:
    """The first rows are there and no others, reading changes nothing, and what is gone on with it ends whole."""
    path.write_bytes(content)
    expected = {task.key: as_read(outcome) for task, outcome in SHORT_POINTS[:count]}
    rows = read_journal(path, HEADER)
    assert rows.finished == expected
    assert (rows.complete, rows.torn) == (ENDS[count], len(content) - ENDS[count])
    assert path.read_bytes() == content


def test_cut_at_every_byte(tmp_path: Path) -> None:
    for size in range(len(HEAD), len(WHOLE_FILE) + 1):
        check(tmp_path / "journal.csv", WHOLE_FILE[:size], whole_rows(size))


def test_the_end_of_a_row_reached_the_disk_and_its_beginning_did_not(tmp_path: Path) -> None:
    last = ROWS[-1]
    for lost in range(1, len(last)):
        check(tmp_path / "journal.csv", WHOLE_FILE[: ENDS[-2]] + bytes(lost) + last[lost:], len(ROWS) - 1)


@pytest.mark.parametrize("size", [ENDS[2], ENDS[2] + 1, ENDS[3] - 1])
def test_what_is_gone_on_with_is_whole(tmp_path: Path, size: int) -> None:
    path = tmp_path / "journal.csv"
    path.write_bytes(WHOLE_FILE[:size])
    with open_journal(path, HEADER, resume=True, force=False) as journal:
        assert len(journal.notices) == (size != ENDS[2])
        for of_point in SHORT_POINTS[2:]:
            journal.add(*of_point)
    assert path.read_bytes() == WHOLE_FILE


def test_nul_bytes_before_the_last_row_are_told_not_cut_off(tmp_path: Path) -> None:
    path = tmp_path / "journal.csv"
    path.write_bytes(WHOLE_FILE[: ENDS[1] + 3] + bytes(5) + WHOLE_FILE[ENDS[1] + 8 :])
    with pytest.raises(FileError, match=rf"{path}:4: this row has NUL bytes"):
        read_journal(path, HEADER)
