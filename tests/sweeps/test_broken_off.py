"""A sweep that a full disk, a loss of power or another run breaks off: what it says, and that it is gone on with."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from random import Random

import pytest

from mbla.cli import main
from tests.sweeps.commands import check_clean, rows_in, run
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
        r"(\d+) finished points in the journal, --resume continues  \[file-not-written\]$",
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
