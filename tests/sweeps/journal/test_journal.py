"""A journal holds every finished point once, to the bit, and says what is wrong with one that it cannot go on with."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from zlib import crc32

import pandas as pd
import pytest

from mbla.errors import FileError, UsageError
from mbla.results.explanations import explanations
from mbla.sweeps.journal import Journal, JournalHeader
from mbla.sweeps.journal.header import header_text
from mbla.sweeps.journal.reading import read_journal
from mbla.sweeps.journal.rows import read_row, row_of
from mbla.sweeps.plan import DONE, FAILED, Outcome
from tests.sweeps.journal.points import HEADER, as_read, point

POINTS = [point(number) for number in range(1, 31)]
EXPECTED = {task.key: as_read(outcome) for task, outcome in POINTS}


def begun(path: Path) -> Journal:
    return Journal(path, HEADER, resume=False, force=False)


def gone_on(path: Path, header: JournalHeader = HEADER, *, retry_failed: bool = False) -> Journal:
    return Journal(path, header, resume=True, force=False, retry_failed=retry_failed)


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """A journal of all points, in a folder that is made for it."""
    path = tmp_path / "new" / "arch.out" / "journal.csv"
    with begun(path) as journal:
        for task, outcome in POINTS:
            journal.add(task, outcome)
        assert journal.finished == EXPECTED
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


def test_nothing_but_the_journal_is_left_in_the_folder(path: Path) -> None:
    assert [file.name for file in path.parent.iterdir()] == ["journal.csv"]


def test_pandas_reads_it(path: Path) -> None:
    table = pd.read_csv(path, comment="#", dtype={"key": str, "seconds": str})
    assert tuple(table.columns) == HEADER.all_columns
    assert list(table["key"]) == [task.key for task, _ in POINTS]
    assert list(table["number"]) == [task.number for task, _ in POINTS]
    assert list(table["seconds"]) == [repr(outcome.seconds) for _, outcome in POINTS]


def test_rows_are_there_before_the_journal_is_left(tmp_path: Path) -> None:
    path = tmp_path / "journal.csv"
    with begun(path) as journal:
        for count, (task, outcome) in enumerate(POINTS[:3], start=1):
            journal.add(task, outcome)
            assert len(read_journal(path, HEADER).finished) == count


def test_an_earlier_journal_is_refused_without_a_word_of_what_to_do_with_it(path: Path) -> None:
    before = path.read_bytes()
    with pytest.raises(FileError, match=r"journal\.csv: exists already; --resume goes on with it, --force begins anew"):
        begun(path).__enter__()
    assert path.read_bytes() == before


def test_force_begins_anew(path: Path) -> None:
    with Journal(path, HEADER, resume=False, force=True) as journal:
        assert journal.finished == {}
    assert path.read_text(encoding="utf-8") == header_text(HEADER)


def test_an_earlier_journal_stays_where_the_new_one_cannot_be_made(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object) -> int:
        raise OSError(28, "No space left on device")

    before = path.read_bytes()
    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(FileError, match=r"journal\.csv: No space left on device"):
        Journal(path, HEADER, resume=False, force=True).__enter__()
    assert path.read_bytes() == before
    assert [file.name for file in path.parent.iterdir()] == ["journal.csv"]


def test_to_go_on_and_to_begin_anew_is_no_choice(path: Path) -> None:
    before = path.read_bytes()
    with pytest.raises(UsageError, match="one of them"):
        Journal(path, HEADER, resume=True, force=True)
    assert path.read_bytes() == before


def test_to_go_on_where_nothing_is_begins(tmp_path: Path) -> None:
    with gone_on(tmp_path / "journal.csv") as journal:
        assert journal.finished == {}
        journal.add(*POINTS[0])
    assert list(read_journal(tmp_path / "journal.csv", HEADER).finished) == [POINTS[0][0].key]


@pytest.mark.parametrize(
    ("other", "words"),
    [
        (replace(HEADER, program="0.2.0+def"), r"was written by mbla 0\.1\.0\+abc, this is 0\.2\.0\+def"),
        (replace(HEADER, fingerprint="beef"), "is of another base deck, or of one that has changed since"),
        (
            replace(HEADER, libraries={"numpy": "2.4.0"}),
            r"was written with other libraries \(its numpy is 2\.3\.0, here it is 2\.4\.0\)",
        ),
        (replace(HEADER, cases=()), "is of load case push, not of all load cases"),
        (replace(HEADER, columns=("status", "gap")), r"has no result gap, has also load_factor, a,\"b\"#"),
        (replace(HEADER, columns=HEADER.columns[::-1]), "has its results in another order"),
    ],
)
def test_a_journal_of_something_else_is_refused_and_told_why(path: Path, other: JournalHeader, words: str) -> None:
    said = refusal(path, other)
    assert re.fullmatch(rf".*journal\.csv: {words}: it cannot be gone on with; --force begins anew .*", said)


def test_another_title_is_no_other_sweep(path: Path) -> None:
    with gone_on(path, replace(HEADER, title="")) as journal:
        assert journal.finished == EXPECTED


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "is no journal of a sweep"),
        (b"key,number\n1,2\n", "is no journal of a sweep"),
        (b"# {\n", "is no journal of a sweep"),
        (b"# {\xff}\n", "is no journal of a sweep"),
        (b'# {"mbla_sweep_journal": 1}\n', "is no whole journal of a sweep"),
        (b'# {"mbla_sweep_journal": 2}\n', "is a journal of format 2; this mbla has format 1"),
        (header_text(HEADER).replace("reason", "cause").encode(), ":2: the names of the columns were changed"),
    ],
)
def test_another_file_of_that_name_is_not_taken_for_a_journal(tmp_path: Path, content: bytes, words: str) -> None:
    path = tmp_path / "journal.csv"
    path.write_bytes(content)
    assert words in refusal(path)


def test_a_row_changed_by_a_spreadsheet_is_told_with_its_line(path: Path) -> None:
    lines = path.read_bytes().split(b"\n")
    lines[6] = lines[6].replace(b",1,", b",1.0,", 1)
    path.write_bytes(b"\n".join(lines))
    said = refusal(path)
    assert f"{path}:7: this row does not match its check sum, it was changed or damaged; put back" in said
    assert "or delete the line, so that its point is solved again" in said


def test_many_broken_rows_are_counted(path: Path) -> None:
    content = path.read_bytes().replace(b'"done",0', b'"done",00')
    path.write_bytes(content)
    broken = content.count(b'"done",00')
    told = refusal(path).splitlines()
    assert len(told) == 11
    assert told[-1] == f"and {broken - 10} more rows like these"


def test_a_row_with_another_number_of_columns_is_broken(path: Path) -> None:
    row = row_of(replace(HEADER, columns=("status",)), POINTS[0][0], replace(POINTS[0][1], results={}))
    path.write_bytes(path.read_bytes() + row)
    assert "has another number of columns" in refusal(path)


@pytest.mark.parametrize(
    ("cell", "text", "words"),
    [
        (0, '"ab"c', "a quotation mark is out of place"),
        (0, r'"a\qb"', r"\\q is no sign of a text"),
        (0, "7", "is no row of a journal"),
        (1, "0.5", "is no row of a journal"),
        (2, '"begun"', "is no row of a journal"),
        (4, "", "is no row of a journal"),
        (6, "3", "is no row of a journal"),
    ],
)
def test_a_row_with_a_right_check_sum_and_wrong_cells_is_broken(path: Path, cell: int, text: str, words: str) -> None:
    """As a program would write it that knows the check sum but not the cells."""
    good = ['"key"', "99", '"failed"', "4", '""', "1", "0.5", "", "", "", '"{}"']
    lines = []
    for cells in (good, [*good[:cell], text, *good[cell + 1 :]]):
        body = ",".join(cells).encode("utf-8") + b","
        lines.append(body + b'"%08x"\n' % crc32(body))
    assert read_row(HEADER, lines[0]).key == "key"
    path.write_bytes(path.read_bytes() + lines[1])
    assert re.search(words, refusal(path))


def test_a_deleted_row_is_a_point_to_be_solved(path: Path) -> None:
    lines = path.read_bytes().split(b"\n")
    del lines[4]
    path.write_bytes(b"\n".join(lines))
    with gone_on(path) as journal:
        assert EXPECTED.keys() - journal.finished.keys() == {POINTS[2][0].key}


def test_the_same_row_twice_counts_once(path: Path) -> None:
    lines = path.read_bytes().splitlines(keepends=True)
    path.write_bytes(b"".join(lines + lines[2:]))
    with gone_on(path) as journal:
        assert journal.finished == EXPECTED


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


def test_a_failed_row_never_stands_for_a_point_that_is_done(path: Path) -> None:
    task, outcome = next((task, outcome) for task, outcome in POINTS if outcome.state == DONE)
    failed = replace(outcome, state=FAILED, exit_code=4, results={})
    path.write_bytes(path.read_bytes() + row_of(HEADER, task, failed))
    with gone_on(path, retry_failed=True) as journal:
        assert journal.finished[task.key] == as_read(outcome)


def test_a_point_is_added_once_and_only_of_this_sweep(tmp_path: Path) -> None:
    task, outcome = POINTS[0]
    with begun(tmp_path / "journal.csv") as journal:
        journal.add(task, outcome)
        with pytest.raises(ValueError, match="finished already"):
            journal.add(task, outcome)
        with pytest.raises(ValueError, match="not one of this sweep"):
            journal.add(POINTS[1][0], outcome)
        with pytest.raises(ValueError, match="not one of this sweep"):
            journal.add(POINTS[1][0], replace(POINTS[1][1], results={"gap": 1.0}))
    assert len(read_journal(tmp_path / "journal.csv", HEADER).finished) == 1


def test_a_journal_that_is_taken_away_gets_no_rows_that_nobody_would_see(tmp_path: Path) -> None:
    path = tmp_path / "journal.csv"
    with begun(path) as journal:
        journal.add(*POINTS[0])
        path.write_bytes(path.read_bytes() + b"x")
        with pytest.raises(FileError, match="was changed by another program"):
            journal.add(*POINTS[1])
        path.unlink()
        with pytest.raises(FileError, match="No such file"):
            journal.add(*POINTS[1])


def test_what_is_cut_off_is_told(path: Path) -> None:
    torn = row_of(HEADER, *point(99))[:-5]
    path.write_bytes(path.read_bytes() + torn)
    with gone_on(path) as journal:
        assert journal.finished == EXPECTED
        assert [notice.identifier for notice in journal.notices] == ["journal-repaired"]
        assert f"({len(torn)} bytes)" in journal.notices[0].message
        journal.add(*point(99))
    assert read_journal(path, HEADER).finished.keys() == {*EXPECTED, point(99)[0].key}
    assert "journal-repaired" in explanations()


def test_an_outcome_without_results_is_read_with_every_column(tmp_path: Path) -> None:
    task, outcome = POINTS[0]
    died = Outcome(task.key, FAILED, 1, "its process died twice", {}, 2, 0.5)
    with begun(tmp_path / "journal.csv") as journal:
        journal.add(task, died)
        assert journal.finished[task.key].results == dict.fromkeys(HEADER.columns)
    assert outcome.key == task.key
