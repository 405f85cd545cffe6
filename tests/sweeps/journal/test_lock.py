"""Two runs on one journal exclude each other; shards of one sweep do not, and a killed run holds nothing."""

from __future__ import annotations

import errno
import fcntl
import os
import re
import socket
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from mbla.errors import FileError
from mbla.results.disk import lock_path, locked
from mbla.sweeps.journal import journal_name, open_journal, read_journal
from tests.sweeps.journal.forked import forked
from tests.sweeps.journal.points import HEADER, point


def held(path: Path) -> Callable[[Callable[[str], None]], None]:
    """A run that is at work until it is killed."""

    def work(report: Callable[[str], None]) -> None:
        with open_journal(path, HEADER, resume=False, force=False) as journal:
            journal.add(*point(1))
            report("at work")
            time.sleep(60)

    return work


def refused(path: Path) -> str:
    with pytest.raises(FileError) as error:
        open_journal(path, HEADER, resume=False, force=True).__enter__()
    return str(error.value)


def test_a_second_run_is_refused_with_who_is_at_work(tmp_path: Path) -> None:
    path = tmp_path / "journal.csv"
    with forked(held(path)) as child:
        assert child.line() == "at work"
        before = path.read_bytes()
        words = f"{path}: process {child.pid} on {socket.gethostname()} is at work on it; wait for its end or stop it"
        assert refused(path) == words
        assert path.read_bytes() == before
        child.kill()
        child.lines()
        with open_journal(path, HEADER, resume=True, force=False) as journal:  # at once, nothing is left to be removed
            assert journal.finished.keys() == {point(1)[0].key}
    assert [file.name for file in tmp_path.iterdir()] == ["journal.csv"]


def test_shards_run_side_by_side(tmp_path: Path) -> None:
    first, second = (tmp_path / journal_name(part, 2) for part in (1, 2))
    with forked(held(first)) as child:
        assert child.line() == "at work"
        with open_journal(second, HEADER, resume=False, force=False) as journal:
            journal.add(*point(2))
            assert f"{first}: process {child.pid}" in refused(first)
    assert read_journal(second, HEADER).finished.keys() == {point(2)[0].key}


def test_a_whole_run_waits_for_the_shards_and_they_for_it(tmp_path: Path) -> None:
    shard, whole = tmp_path / journal_name(1, 2), tmp_path / "journal.csv"
    with forked(held(shard)) as child:
        assert child.line() == "at work"
        assert refused(whole).startswith(f"{shard}: process {child.pid} on ")
        assert not whole.exists()
    with forked(held(tmp_path / "two" / "journal.csv")) as child:
        assert child.line() == "at work"
        told = refused(tmp_path / "two" / journal_name(1, 2))
        assert told.startswith(f"{tmp_path / 'two' / 'journal.csv'}: process {child.pid} on ")


def test_of_many_at_once_one_gets_it(tmp_path: Path) -> None:
    """Each removes the file of the lock at its end; whoever opened it before must not hold what is no more there."""
    path, inside = tmp_path / "journal.csv", tmp_path / "inside"

    def work(report: Callable[[str], None]) -> None:
        for _ in range(60):
            try:
                with locked(path):
                    os.close(os.open(inside, os.O_CREAT | os.O_EXCL))  # raises where another is inside
                    inside.unlink()
            except FileError:
                continue
        report("well")

    with forked(work) as first, forked(work) as second, forked(work) as third:
        assert [child.lines() for child in (first, second, third)] == [["well"]] * 3
    assert not lock_path(path).exists()


@pytest.mark.parametrize("number", [errno.ENOSYS, errno.ENOLCK])
def test_a_file_system_without_locks_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, number: int) -> None:
    def none(*_: object) -> None:
        raise OSError(number, os.strerror(number))

    monkeypatch.setattr(fcntl, "flock", none)
    with pytest.raises(FileError, match=re.escape("its file system has no locks to keep two runs apart; -o FOLDER")):
        open_journal(tmp_path / "journal.csv", HEADER, resume=False, force=False).__enter__()
    assert not (tmp_path / "journal.csv").exists()
