"""What killed runs leave is cleared away; a file is there as a whole or not at all; locks keep two runs apart."""

from __future__ import annotations

import contextlib
import fcntl
import os
from pathlib import Path

import pytest

from mbla.errors import FileError, UsageError
from mbla.results.disk import (
    clear_leftovers,
    holder,
    lock_path,
    locked,
    mark_as_new,
    remove_new,
    temporary_path,
    writing_complete,
)


@pytest.fixture(autouse=True)
def everybody_is_dead(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mbla.results.disk._process_exists", lambda _: False)


def test_without_a_mark_the_new_files_are_the_valid_ones(tmp_path: Path) -> None:
    (tmp_path / "a.h5").write_text("new")
    temporary_path(tmp_path / "a.h5", "earlier").write_text("old")
    clear_leftovers(tmp_path)
    assert [(path.name, path.read_text()) for path in tmp_path.iterdir()] == [("a.h5", "new")]


def test_with_a_mark_the_earlier_ones_are(tmp_path: Path) -> None:
    marker = temporary_path(tmp_path / "a", "open")
    for name in ("a.h5", "a.pvd", "foreign.pvd"):
        (tmp_path / name).write_text("new")
    temporary_path(tmp_path / "a.h5", "earlier").write_text("old")
    mark_as_new(marker, {"a.pvd": (tmp_path / "a.pvd").stat().st_ino, "foreign.pvd": 1, "gone.pvd": 2})
    clear_leftovers(tmp_path)
    assert {path.name: path.read_text() for path in tmp_path.iterdir()} == {"a.h5": "old", "foreign.pvd": "new"}


@pytest.mark.parametrize("line", ["{} ../mine", "{} mine", "mine\n", "\n"])
def test_a_torn_or_strange_line_of_a_mark_removes_nothing(tmp_path: Path, line: str) -> None:
    folder = tmp_path / "out"
    folder.mkdir()
    for path in (tmp_path / "mine", folder / "mine"):
        path.touch()
    marker = temporary_path(folder / "a", "open")
    marker.write_text(line.format((tmp_path / "mine").stat().st_ino))  # the last line has no end: it was torn
    remove_new(folder, marker)
    assert (tmp_path / "mine").exists()
    assert (folder / "mine").exists()


@pytest.mark.parametrize(
    ("error", "exists"), [(None, True), (PermissionError, True), (OverflowError, True), (ProcessLookupError, False)]
)
def test_a_process_of_another_user_is_alive(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, error: type[BaseException] | None, exists: bool
) -> None:
    """Its files are left alone; those of one that is gone are removed."""
    monkeypatch.undo()

    def kill(process: int, number: int) -> None:
        assert number == 0
        if error is not None:
            raise error

    monkeypatch.setattr("mbla.results.disk.os.getpid", lambda: 4242)
    new = temporary_path(tmp_path / "a.h5", "new")
    new.touch()
    monkeypatch.undo()
    monkeypatch.setattr("mbla.results.disk.os.kill", kill)
    clear_leftovers(tmp_path)
    assert new.exists() is exists


def fail_half_way(path: Path, error: BaseException) -> None:
    with writing_complete(path) as temporary:
        temporary.write_text("half")
        raise error


@pytest.mark.parametrize(
    "error", [KeyboardInterrupt(), UsageError("extra-missing", ""), ValueError()], ids=lambda error: repr(error)
)
def test_a_failure_leaves_the_earlier_file(tmp_path: Path, error: BaseException) -> None:
    (tmp_path / "c.txt").write_text("earlier")
    with pytest.raises(type(error)):
        fail_half_way(tmp_path / "c.txt", error)
    assert [path.name for path in tmp_path.iterdir()] == ["c.txt"]
    assert (tmp_path / "c.txt").read_text() == "earlier"


def write_where_nothing_can_be(path: Path) -> None:
    with writing_complete(path) as temporary:
        try:
            (temporary / "no").touch()
        except OSError as error:
            raise FileError("file-not-written", f"{temporary}: {error.strerror}") from error


def test_errors_name_the_file_and_not_the_temporary_one(tmp_path: Path) -> None:
    path = tmp_path / "c.txt"
    with pytest.raises(FileError) as raised:
        write_where_nothing_can_be(path)
    assert str(raised.value) == f"{path}: No such file or directory"


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
