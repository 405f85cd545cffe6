"""A disk that is full or fails: the run is told, what was reported stays, and no part of a row is left."""

from __future__ import annotations

import errno
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from mbla.errors import FileError
from mbla.sweeps.journal import open_journal, read_journal
from tests.sweeps.journal.points import HEADER, point

POINTS = [point(number) for number in range(1, 13)]


def failing(call: Callable[..., Any], at: int, error: int, *, part: int = 0) -> Callable[..., Any]:
    """The call, which fails from its ``at``-th time on; one that writes may take a part of it first."""
    times = 0

    def instead(descriptor: int, *what: Any) -> Any:
        nonlocal times
        times += 1
        if times < at:
            return call(descriptor, *what)
        if part and times == at:
            return call(descriptor, what[0][:part])
        raise OSError(error, os.strerror(error))

    return instead


def add_all(path: Path, patch: dict[str, Callable[..., Any]]) -> tuple[set[str], str]:
    """Keys of the points that were reported as added, and what was said of the first that was not."""
    added: set[str] = set()
    with open_journal(path, HEADER, resume=True, force=False) as journal, pytest.MonkeyPatch.context() as context:
        for name, call in patch.items():
            context.setattr(os, name, call)
        for task, outcome in POINTS:
            if task.key in journal.finished:
                continue
            try:
                journal.add(task, outcome)
            except FileError as error:
                return added, str(error)
            added.add(task.key)
    return added, ""


@pytest.mark.parametrize("part", [0, 1, 40])
@pytest.mark.parametrize("at", range(1, 12))
def test_a_write_fails(tmp_path: Path, at: int, part: int) -> None:
    path = tmp_path / "journal.csv"
    added, said = add_all(path, {"write": failing(os.write, at, errno.ENOSPC, part=part)})
    assert said == f"{path}: No space left on device"
    assert len(added) == at - 1
    rows = read_journal(path, HEADER)
    assert (set(rows.finished), rows.torn) == (added, 0)
    assert add_all(path, {})[1] == ""
    assert len(read_journal(path, HEADER).finished) == len(POINTS)


@pytest.mark.parametrize("at", [1, 2, 7])
def test_the_disk_does_not_take_what_was_written(tmp_path: Path, at: int) -> None:
    path = tmp_path / "journal.csv"
    added, said = add_all(path, {"fsync": failing(os.fsync, at, errno.EIO)})
    assert said == f"{path}: Input/output error"
    rows = read_journal(path, HEADER)
    assert (set(rows.finished), rows.torn, len(added)) == (added, 0, at - 1)
