"""``mbla sweep`` in processes of its own, what it says, and what is left of it."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import tempfile
import uuid
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import pytest

from mbla.sweeps.engine.supervised import PACKAGES
from mbla.sweeps.journal import journals_in
from tests.sweeps.engine.test_supervised import wait_for
from tests.sweeps.killed_sweeps import keys_in_journals, table_of

MARK = "MBLA_TEST_MARK"
"""variable of the environment by which the processes of a test are known, whoever began them"""
DASK_LOCKS = ("global.lock", "purge.lock")
"""empty files by which workers of Dask agree on who removes folders of others that were killed"""
DASK_KILLED = (*DASK_LOCKS, "*.dirlock")
"""what workers of Dask that are killed leave as well, for the next one to remove"""
IN_TIME = 30.0
"""seconds in which a command must have ended that was told to; it takes some tenths on an idle machine"""


@dataclass(frozen=True)
class Ended:
    """How a command ended."""

    status: int
    said: str


class Command:
    """Context manager: the command, begun; it is gone when the block is left."""

    def __init__(self, path: Path, folder: Path, *options: str, file_size: int | None = None) -> None:
        """
        file_size : largest file that the system lets it write, in bytes, as a full disk would; None for no limit
        """
        limit = () if file_size is None else ("prlimit", f"--fsize={file_size}")
        mbla = (sys.executable, "-P", "-m", "mbla", "sweep", str(path), "-o", str(folder), *options)
        self.folder = folder
        self.process = subprocess.Popen(
            (*limit, *mbla),
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
            env=os.environ | {"PYTHONPATH": str(PACKAGES)},
        )

    def __enter__(self) -> Command:
        return self

    def __exit__(self, *what: object) -> None:
        self.process.kill()
        self.process.wait()
        assert self.process.stderr is not None
        self.process.stderr.close()

    def await_rows(self, count: int) -> None:
        """Until so many rows are in the journals of the folder."""
        wait_for(lambda: self.process.poll() is not None or rows_in(self.folder) >= count)
        assert self.process.poll() is None, self.process.communicate()[1]

    def end(self, number: int | None = None) -> Ended:
        """Its end, after that signal."""
        if number is not None:
            self.process.send_signal(number)
        _, said = self.process.communicate(timeout=None if number is None else IN_TIME)
        return Ended(self.process.returncode, said)


def run(path: Path, folder: Path, *options: str, file_size: int | None = None) -> Ended:
    """From begin to end, undisturbed."""
    with Command(path, folder, *options, file_size=file_size) as command:
        return command.end()


def rows_in(folder: Path) -> int:
    """Whole rows in the journals of a folder."""
    return sum(max(path.read_bytes().count(b"\n") - 2, 0) for path in journals_in(folder))


def check_clean(folder: Path, clean: Path) -> None:
    """The files of a clean run and no others, each point once in the journals, and the same table."""
    keys = keys_in_journals(folder)
    assert sorted(keys) == sorted(keys_in_journals(clean))
    assert table_of(folder) == table_of(clean)
    left = {path.name for path in folder.iterdir()} - {path.name for path in journals_in(folder)}
    assert left == {"sweep.csv", "sweep.json"}


@contextlib.contextmanager
def nothing_left(folder: Path, but: Sequence[str] = ()) -> Iterator[None]:
    """After the block no process that it began is there, nor any temporary file.

    folder : for temporary files
    but    : patterns of names of those that may be left
    """
    mark = uuid.uuid4().hex
    folder.mkdir()
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(MARK, mark)
        patch.setenv("TMPDIR", str(folder))
        patch.setattr(tempfile, "tempdir", None)
        try:
            yield
            wait_for(lambda: not _processes_with(mark))
        finally:
            for pid in _processes_with(mark):  # where the block or the test failed
                with contextlib.suppress(ProcessLookupError):
                    os.kill(pid, signal.SIGKILL)
    left = [path for path in folder.rglob("*") if path.is_file() and not any(map(path.match, but))]
    assert left == []


def _processes_with(mark: str) -> list[int]:
    """Processes with that mark in their environment; one that has ended has none."""
    found = []
    for path in Path("/proc").iterdir():
        with contextlib.suppress(OSError):
            if path.name.isdigit() and mark.encode() in (path / "environ").read_bytes():
                found.append(int(path.name))
    return found
