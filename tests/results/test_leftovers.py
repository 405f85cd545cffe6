from __future__ import annotations

from pathlib import Path

import pytest

from mbla.results.disk import clear_leftovers, mark_as_new, remove_new, temporary_path


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
