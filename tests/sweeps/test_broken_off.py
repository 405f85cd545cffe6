"""A sweep that a full disk, a loss of power or another run breaks off: what it says, and that it is gone on with."""

from __future__ import annotations

import os
import re
import signal
import time
from collections.abc import Iterator
from pathlib import Path
from random import Random

import pytest

from mbla.cli import main
from mbla.sweeps.journal import journal_name
from tests.sweeps.commands import Command, check_clean, rows_in, run
from tests.sweeps.engine.test_supervised import wait_for
from tests.sweeps.journal.forked import forked
from tests.sweeps.killed_sweeps import written

pytestmark = pytest.mark.long

POINTS = 24
HEADER = 2
"""lines of a journal before its rows"""


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Of a sweep file whose sweep has run undisturbed, into the folder ``clean`` beside it."""
    path = written(tmp_path_factory.mktemp("sweep"), POINTS)
    assert main(["sweep", str(path), "-o", str(path.with_name("clean")), "-q"]) == 8
    return path


@pytest.fixture
def clean(path: Path) -> Path:
    """Folder of the sweep that ran undisturbed."""
    return path.with_name("clean")


def go_on(path: Path, folder: Path) -> int:
    """In this process; the exit status."""
    return main(["sweep", str(path), "-o", str(folder), "--resume", "-q"])


def test_a_full_disk(path: Path, clean: Path, tmp_path: Path) -> None:
    """The system refuses what lies beyond a size that is reached in the middle of the journal."""
    room = (clean / "journal.csv").stat().st_size // 2
    ended = run(path, tmp_path / "full", "-q", file_size=room)
    said = re.search(
        r"^mbla: \S+/full/journal\.csv: File too large; "
        r"(\d+) finished points in the journal, --resume goes on  \[file-not-written\]$",
        ended.said,
        re.M,
    )
    assert (ended.status, said is not None) == (6, True), ended.said
    assert said
    assert 0 < int(said[1]) == rows_in(tmp_path / "full") < POINTS
    assert [each.name for each in (tmp_path / "full").iterdir()] == ["journal.csv"]
    assert (tmp_path / "full" / "journal.csv").read_bytes().endswith(b'"\n')
    assert go_on(path, tmp_path / "full") == 8
    check_clean(tmp_path / "full", clean)


def lengths(clean: Path, count: int) -> Iterator[int]:
    """Where a journal is cut off, at random, behind its header."""
    whole = (clean / "journal.csv").read_bytes()
    header = len(b"".join(whole.splitlines(keepends=True)[:HEADER]))
    draw = Random(5)
    yield from (draw.randint(header, len(whole)) for _ in range(count))


def test_a_loss_of_power(path: Path, clean: Path, tmp_path: Path) -> None:
    check_cut(path, clean, tmp_path / "cut", next(lengths(clean, 1)), b"\0" * 300)


def check_cut(path: Path, clean: Path, folder: Path, length: int, after: bytes) -> None:
    """What reached the disk, and NUL bytes in place of what had not."""
    folder.mkdir()
    (folder / "journal.csv").write_bytes((clean / "journal.csv").read_bytes()[:length] + after)
    assert go_on(path, folder) == 8
    check_clean(folder, clean)


def test_two_runs_at_once(path: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The second is told who has the journal, and takes nothing from the first."""
    folder = tmp_path / "two"
    command = ["sweep", str(path), "-o", str(folder), "-q"]
    with forked(lambda report: report(f"exit {main(command)}")) as first:
        wait_for(lambda: rows_in(folder))
        os.kill(first.pid, signal.SIGSTOP)  # so that it is still at work when the others come
        for options in ("--resume",), ("--force",), ("--shard", "1/2"):
            assert main([*command, *options]) == 6
            said = capsys.readouterr().err
            assert re.fullmatch(rf"mbla: \S+/journal\.csv: process {first.pid} on \S+ is at work on it; .*\n", said)


def test_a_job_array(path: Path, clean: Path, tmp_path: Path) -> None:
    """Four jobs together, one of which is killed in the middle; a run of the whole goes on with what they left."""
    folder = tmp_path / "array"
    with (
        Command(path, folder, "--shard", "1/4") as first,
        Command(path, folder, "--shard", "2/4") as second,
        Command(path, folder, "--shard", "3/4") as third,
        Command(path, folder, "--shard", "4/4") as fourth,
    ):
        while not rows_in_shard(folder, 2):
            assert second.process.poll() is None
            time.sleep(0.001)
        second.process.kill()
        for job in (first, third, fourth):
            assert job.end().status in (0, 8)
    assert [rows_in_shard(folder, part) for part in (1, 3, 4)] == [POINTS // 4] * 3
    assert not (folder / "sweep.csv").exists() or rows_in(folder) == POINTS
    assert go_on(path, folder) == 8
    check_clean(folder, clean)


def rows_in_shard(folder: Path, part: int) -> int:
    """Rows in the journal of a shard of four."""
    journal = folder / journal_name(part, 4)
    return journal.read_bytes().count(b"\n") - HEADER if journal.exists() else 0
