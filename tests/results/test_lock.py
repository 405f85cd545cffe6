"""One lock by itself: who holds it, what is left of it, and machines without locks."""

from __future__ import annotations

import contextlib
import errno
import fcntl
import os
import re
from pathlib import Path

import pytest

from mbla.errors import FileError
from mbla.results.disk import holder, lock_path, locked


def test_nobody_holds_a_lock_that_was_left_behind(tmp_path: Path) -> None:
    """By a run that was killed: its file says who that was, and is in nobody's way."""
    path = tmp_path / "deck.h5"
    lock_path(path).write_text("process 1 on somewhere", encoding="utf-8")
    assert holder(path) is None
    with locked(path):
        assert holder(path) == f"process {os.getpid()} on {os.uname().nodename}"
    assert not lock_path(path).exists()


def test_the_last_of_several_shared_holders_removes_the_file(tmp_path: Path) -> None:
    path = tmp_path / "deck.h5"
    with locked(path, shared=True):
        with locked(path, shared=True):
            assert holder(path) is None, "nobody holds it alone"
        assert lock_path(path).exists()
    assert not lock_path(path).exists()


@pytest.mark.parametrize("replaced", [True, False])
def test_a_lock_on_a_file_that_is_gone_is_taken_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, replaced: bool
) -> None:
    """The one before removed it, or another took its place, between the opening and the lock."""
    path = tmp_path / "deck.h5"
    taken: list[int] = []
    flock = fcntl.flock

    def late(descriptor: int, kind: int) -> None:
        if not taken:
            lock_path(path).unlink()
            if replaced:
                lock_path(path).touch()
        taken.append(descriptor)
        flock(descriptor, kind)

    monkeypatch.setattr(fcntl, "flock", late)
    with locked(path):
        monkeypatch.undo()
        assert len(taken) == 2
        assert lock_path(path).exists()
        assert (holder(path) or "").startswith(f"process {os.getpid()} ")


def test_a_file_that_another_put_in_its_place_is_left_alone(tmp_path: Path) -> None:
    path = tmp_path / "deck.h5"
    with locked(path):
        lock_path(path).unlink()
        lock_path(path).write_text("another's", encoding="utf-8")
    assert lock_path(path).read_text(encoding="utf-8") == "another's"


@pytest.mark.parametrize("required", [True, False])
def test_a_system_without_locks_refuses_what_needs_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, required: bool
) -> None:
    """The rest goes on, without a file beside it."""
    monkeypatch.setattr("sys.platform", "win32")
    refused = pytest.raises(FileError, match="has no locks") if required else contextlib.nullcontext()
    entered = False
    with refused, locked(tmp_path / "deck.h5", required=required):
        entered = True
    assert entered is not required
    assert not list(tmp_path.iterdir())


def test_what_the_system_refuses_is_said_in_its_words(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object) -> None:
        raise OSError(errno.EIO, os.strerror(errno.EIO))

    monkeypatch.setattr(fcntl, "flock", broken)
    path = tmp_path / "deck.h5"
    words = re.escape(f"{lock_path(path)}: {os.strerror(errno.EIO)}")
    with pytest.raises(FileError, match=words), locked(path, required=False):
        pytest.fail("held")
